// Solids with a flaw: what does no harm is mended, what does is told, and nothing inside of either
// is free; sheets stay sheets.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/ground/strings.h"
#include "../src/body/trust.h"
#include "../src/body/shapes.h"
#include "../src/query/question.h"
#include "../src/certificate/certify.h"

#include "body_of.h"
#include "check.h"

void test_solids(void);

static const nsvcd_body *solids_encode(shapes_mesh *mesh, int open) {
  const nsvcd_encode_options options = {.open = open};
  return body_of(mesh, &options);
}

// A small body, at rest or on its way, asked of another in both roles: the same is said of both.
static nsvcd_answer solids_ask(const nsvcd_body *small, const double *from, const double *to,
                               const nsvcd_body *large) {
  static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(512, 512, 64));
  nsvcd_pose poses[2] = {{{0, 0, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
  nsvcd_answer answers[2];
  memset(answers, 0, sizeof answers);
  for (int k = 0; k < 3; k++) {
    poses[0].position[k] = (float)from[k];
    poses[1].position[k] = (float)to[k];
  }
  for (int swapped = 0; swapped < 2; swapped++) {
    nsvcd_question q;
    memset(&q, 0, sizeof q);
    nsvcd_mover *moves = swapped ? &q.b : &q.a;
    moves->body = small;
    moves->poses = poses;
    moves->count = 2;
    (swapped ? &q.a : &q.b)->body = large;
    CHECK_EQ(nsvcd_sweep(&q, workspace, sizeof workspace, &answers[swapped]), NSVCD_OK);
  }
  CHECK_EQ(answers[0].verdict, answers[1].verdict);
  CHECK_EQ(answers[0].why, answers[1].why);
  return answers[0];
}

// ------------------------------------------------------------------------------------------ flaws

enum {
  NO_FLAW,
  FACE_TWICE,
  FACE_BOTH_WAYS,
  HALF_TWICE,
  FIN,
  TWO_FINS,
  FLAP,
  STRAY,
  SLIVER,
  SEGMENT,
  FACE_TURNED,
  HALF_TURNED,
  ALL_TURNED,
  SOUP,
  APART,
  ONE_APART,
  GAP_FILLED,
  SPARE_VERTICES,
  TOUCHES,
  SHELL_TWICE,
  WALL,
  MENDED,
  FACE_MISSING = MENDED,
  T_JUNCTION,
  FLAWS
};

enum { CUBE, CUT_CUBE, BALL, CYLINDER, CONE, TORUS, BRACKET, SOLIDS };

// Extents of about 1 and a point well inside.
static void solids_shape(int kind, shapes_mesh *mesh, double *inside) {
  memset(mesh, 0, sizeof *mesh);
  inside[0] = inside[1] = inside[2] = 0;
  if (kind == CUBE) shapes_box(mesh, 1, 0.8, 0.9, 1);
  if (kind == CUT_CUBE) shapes_box(mesh, 1, 1, 1, 4);
  if (kind == BALL) shapes_ellipsoid(mesh, 0.5, 0.45, 0.4, 12);
  if (kind == CYLINDER) shapes_cylinder(mesh, 0.4, 0.9, 10);
  if (kind == CONE) shapes_cone(mesh, 0.5, 0.3, 0.8, 7);
  if (kind == TORUS) shapes_torus(mesh, 0.5, 0.2, 16, 10);
  if (kind == BRACKET) shapes_l_bracket(mesh, 1, 1, 0.4, 0.5);
  if (kind == TORUS) inside[0] = 0.5;
  double low[3], high[3];
  shapes_bounds(mesh, low, high);
  // near the corner of the two legs
  for (int k = 0; k < 3 && kind == BRACKET; k++)
    inside[k] = k < 2 ? low[k] + 0.2 : 0.5 * (low[k] + high[k]);
  for (int k = 0; k < 3 && kind != TORUS && kind != BRACKET; k++)
    inside[k] = 0.5 * (low[k] + high[k]);
}

static void solids_turn(shapes_mesh *mesh, size_t t) {
  const uint32_t swap = mesh->indices[3 * t];
  mesh->indices[3 * t] = mesh->indices[3 * t + 1];
  mesh->indices[3 * t + 1] = swap;
}

static const double *solids_corner(const shapes_mesh *mesh, size_t t, size_t k) {
  return mesh->positions + 3 * (size_t)mesh->indices[3 * t + k];
}

// A new vertex: a corner of a triangle, off by this much in each direction, or so much of the way to
// the next.
static uint32_t solids_copy(shapes_mesh *mesh, shapes_rng *rng, size_t t, size_t k, double off) {
  double x[3];
  for (int i = 0; i < 3; i++) x[i] = solids_corner(mesh, t, k)[i] + shapes_uniform(rng, -off, off);
  return shapes_vertex(mesh, x[0], x[1], x[2]);
}
static uint32_t solids_between(shapes_mesh *mesh, size_t t, size_t k, double fraction) {
  double x[3];
  for (int i = 0; i < 3; i++)
    x[i] = solids_corner(mesh, t, k)[i] * (1 - fraction) +
           solids_corner(mesh, t, (k + 1) % 3)[i] * fraction;
  return shapes_vertex(mesh, x[0], x[1], x[2]);
}

static void solids_spoil(shapes_mesh *mesh, const double *inside, shapes_rng *rng, int flaw) {
  const size_t count = mesh->triangles;
  const size_t t = (size_t)shapes_pick(rng, (int)count);
  const size_t k = (size_t)shapes_pick(rng, 3);
  const uint32_t a = mesh->indices[3 * t + k];
  const uint32_t b = mesh->indices[3 * t + (k + 1) % 3];
  const uint32_t c = mesh->indices[3 * t + (k + 2) % 3];
  const double off = shapes_pick(rng, 2) ? 1e-7 : 1e-5;
  if (flaw == FACE_TWICE) shapes_triangle(mesh, b, c, a);
  if (flaw == FACE_BOTH_WAYS) shapes_triangle(mesh, b, a, c);
  for (size_t n = 0; n < count; n++) {
    const uint32_t *face = mesh->indices + 3 * n;
    const int is_half = shapes_pick(rng, 2);
    if (flaw == HALF_TWICE && is_half) shapes_triangle(mesh, face[0], face[1], face[2]);
    if (flaw == ALL_TURNED || (flaw == HALF_TURNED && is_half)) solids_turn(mesh, n);
    for (size_t i = 0; i < 3 && (flaw == SOUP || flaw == APART || (flaw == ONE_APART && n == t));
         i++)
      mesh->indices[3 * n + i] = solids_copy(mesh, rng, n, i, flaw == SOUP ? 0 : off);
  }
  for (int n = 0; n < (flaw == FIN) + 2 * (flaw == TWO_FINS); n++)
    shapes_triangle(mesh, a, b, solids_copy(mesh, rng, t, k, 0.3));
  if (flaw == FLAP) {
    const uint32_t d = solids_copy(mesh, rng, t, k, 0.3);
    shapes_quad(mesh, a, b, d, solids_copy(mesh, rng, t, k, 0.3));
  }
  if (flaw == STRAY) {
    const uint32_t d = solids_copy(mesh, rng, t, k, 0.3);
    shapes_triangle(mesh, a, d, solids_copy(mesh, rng, t, k, 0.3));
  }
  if (flaw == SLIVER) shapes_triangle(mesh, a, b, solids_between(mesh, t, k, 0.4));
  if (flaw == SEGMENT) shapes_triangle(mesh, a, c, a);
  if (flaw == FACE_TURNED) solids_turn(mesh, t);
  if (flaw == GAP_FILLED || flaw == T_JUNCTION) {
    // triangle t is cut at its edge a b, whose neighbour is not
    const uint32_t d = solids_between(mesh, t, k, shapes_uniform(rng, 0.3, 0.7));
    mesh->indices[3 * t + (k + 1) % 3] = d;
    shapes_triangle(mesh, d, b, c);
    if (flaw == GAP_FILLED) shapes_triangle(mesh, a, b, d);
  }
  if (flaw == SPARE_VERTICES) shapes_vertex(mesh, 7, 8, 9);
  if (flaw == TOUCHES) {  // a tetrahedron on the other side of an edge, whose one face is turned
    double x[3], most[3], low[3], high[3];
    shapes_bounds(mesh, low, high);
    for (int i = 0; i < 3; i++) {
      x[i] = solids_corner(mesh, t, k)[i];
      most[i] = x[i] > 0.5 * (low[i] + high[i]) ? x[i] + 0.3 : x[i] - 0.3;
    }
    const uint32_t d = shapes_vertex(mesh, most[0], most[1], most[2]);
    const uint32_t e = shapes_vertex(mesh, most[0], most[1], x[2]);
    const uint32_t f = shapes_vertex(mesh, most[0], x[1], most[2]);
    shapes_triangle(mesh, a, d, e);
    shapes_triangle(mesh, a, e, f);
    shapes_triangle(mesh, a, f, d);
    shapes_triangle(mesh, d, e, f);
  }
  if (flaw == SHELL_TWICE)
    for (size_t n = 0; n < count; n++)
      shapes_triangle(mesh, mesh->indices[3 * n], mesh->indices[3 * n + 1],
                      mesh->indices[3 * n + 2]);
  if (flaw == WALL) {  // within, a tent over a face
    double x[3];
    for (size_t i = 0; i < 3; i++) {
      x[i] = 0.2 * inside[i];
      for (size_t n = 0; n < 3; n++) x[i] += 0.8 / 3 * solids_corner(mesh, t, n)[i];
    }
    const uint32_t d = shapes_vertex(mesh, x[0], x[1], x[2]);
    shapes_triangle(mesh, a, b, d);
    shapes_triangle(mesh, b, c, d);
    shapes_triangle(mesh, c, a, d);
  }
  if (flaw == FACE_MISSING) {
    memmove(mesh->indices + 3 * t, mesh->indices + 3 * (count - 1), 3 * sizeof *mesh->indices);
    mesh->triangles--;
  }
}

static void solids_with_a_flaw(void) {
  shapes_rng rng = {46};
  for (int n = 0; n < 3 * FLAWS; n++) {
    const int flaw = n % FLAWS;
    const int kind = (n + 3 * (n / FLAWS)) % SOLIDS;
    const double scale = pow(10, shapes_uniform(&rng, -3, 3));
    shapes_mesh mesh, ball;
    double inside[3], q[4], outside[3], back[3];
    solids_shape(kind, &mesh, inside);
    solids_spoil(&mesh, inside, &rng, flaw);
    const uint32_t centre = shapes_vertex(&mesh, inside[0], inside[1], inside[2]);
    shapes_quaternion(&rng, q);
    shapes_place(&mesh, 0, q, shapes_uniform(&rng, -1, 1), 0.3, 0.2);
    for (size_t i = 0; i < 3 * mesh.vertices; i++) mesh.positions[i] *= scale;
    for (int i = 0; i < 3; i++) {
      inside[i] = mesh.positions[3 * centre + (size_t)i];
      outside[i] = inside[i] + scale * (i == n % 3 ? 3 : 0.1);
      back[i] = inside[i] - scale * (i == n % 3 ? 3 : 0.1);
    }
    memset(&ball, 0, sizeof ball);
    shapes_ellipsoid(&ball, 0.02 * scale, 0.03 * scale, 0.02 * scale, 6);
    const nsvcd_body *small = solids_encode(&ball, 0);
    for (int open = 0; open < 2; open++) {
      const nsvcd_body *body = solids_encode(&mesh, open);
      const nsvcd_body_facts facts = nsvcd_body_describe(body);
      const nsvcd_answer in = solids_ask(small, inside, inside, body);
      const int told = flaw >= MENDED;
      const nsvcd_verdict want = open ? NSVCD_FREE : told ? NSVCD_UNDECIDED : NSVCD_HIT;
      CHECK_EQ(in.verdict, want);
      CHECK_EQ(in.why, told && !open ? NSVCD_WHY_OPEN : NSVCD_WHY_NOTHING);
      CHECK_EQ(in.inside, !told && !open);
      CHECK_EQ(solids_ask(small, outside, outside, body).verdict, NSVCD_FREE);
      if ((n + open) % 2) {
        const nsvcd_answer through = solids_ask(small, outside, back, body);
        CHECK_EQ(through.verdict, NSVCD_HIT);
        CHECK_EQ(through.inside, 0);
      }
      // a triangle that hangs on a corner alone is a sheet of its own
      const size_t strays = flaw == STRAY;
      CHECK_EQ(facts.open_components, told || strays ? 1 : 0);
      CHECK_EQ(facts.open_edges, told || strays ? 3 : 0);
      CHECK_LE(1, facts.components);
      nsvcd_body_free(body, NULL);
    }
    nsvcd_body_free(small, NULL);
    shapes_free(&mesh);
    shapes_free(&ball);
  }
}

// ------------------------------------------------------------------------------------------ sheets

enum {
  FLOOR,
  TERRAIN,
  TERRAIN_WITH_HOLES,
  BIN,
  CUT_BIN,
  CUP,
  TALL_CUP,
  FUNNEL,
  BOWL,
  FLAT_BOWL,
  TUBE,
  LONG_TUBE,
  SQUARE_TUBE,
  THREE_SIDED_TUBE,
  HALF_PIPE,
  TENT,
  ROOM_WITH_A_DOOR,
  HOUSE_WITH_A_GATE,
  HOUSE_ON_TERRAIN,
  TENT_ON_TERRAIN,
  SHEETS
};

static void solids_drop(shapes_mesh *mesh, size_t first, size_t count) {
  memmove(mesh->indices + 3 * first, mesh->indices + 3 * (first + count),
          3 * (mesh->triangles - first - count) * sizeof *mesh->indices);
  mesh->triangles -= count;
}

// Drops the triangles whose corners are all above a height.
static void solids_open_top(shapes_mesh *mesh, double height) {
  for (size_t t = mesh->triangles; t-- > 0;) {
    int above = 1;
    for (size_t k = 0; k < 3; k++) above &= solids_corner(mesh, t, k)[2] > height;
    if (above) solids_drop(mesh, t, 1);
  }
}

// A sheet, and the middle of what lies in it or on it.
static void solids_sheet(int kind, shapes_mesh *mesh, shapes_rng *rng, double *at) {
  memset(mesh, 0, sizeof *mesh);
  at[0] = at[1] = 0;
  at[2] = -0.3;
  if (kind == FLOOR) {
    for (int k = 0; k < 4; k++) shapes_vertex(mesh, k & 1 ? 9 : -9, k & 2 ? 9 : -9, -0.34);
    shapes_quad(mesh, 0, 1, 3, 2);
  }
  if (kind == TERRAIN || kind == TERRAIN_WITH_HOLES || kind == HOUSE_ON_TERRAIN ||
      kind == TENT_ON_TERRAIN) {
    const uint32_t n = 24;
    for (uint32_t k = 0; k < n * n; k++) {
      const double x = 0.2 * (k % n - 11.5);
      const double y = 0.2 * (k / n - 11.5);
      const int flat = fabs(x) < 0.75 && fabs(y) < 0.75;
      shapes_vertex(mesh, x, y, -0.4 + (flat ? 0 : 0.2 * sin(3 * x) * cos(2 * y)));
    }
    for (uint32_t k = 0; k < n * (n - 1); k++)
      if (k % n < n - 1) shapes_quad(mesh, k, k + 1, k + n + 1, k + n);
    for (int k = 0; k < 20 && kind == TERRAIN_WITH_HOLES; k++)
      solids_drop(mesh, (size_t)shapes_pick(rng, (int)mesh->triangles), 1);
  }
  if (kind == HOUSE_ON_TERRAIN) {  // walls and a roof, on vertices of the ground
    const uint32_t ground[4] = {24 * 10 + 10, 24 * 10 + 11, 24 * 11 + 11, 24 * 11 + 10};
    uint32_t roof[4];
    for (int k = 0; k < 4; k++) {
      const double *x = mesh->positions + 3 * (size_t)ground[k];
      roof[k] = shapes_vertex(mesh, x[0], x[1], 0);
    }
    for (int k = 0; k < 4; k++)
      shapes_quad(mesh, ground[k], ground[(k + 1) % 4], roof[(k + 1) % 4], roof[k]);
    shapes_quad(mesh, roof[0], roof[1], roof[2], roof[3]);
    at[0] = at[1] = -0.2;
    at[2] = -0.2;
  }
  if (kind == TENT_ON_TERRAIN) {  // closed, on an edge of the ground
    const uint32_t from = 24 * 10 + 10;
    const double *x = mesh->positions + 3 * (size_t)from;
    const double y = x[1];
    const uint32_t left = shapes_vertex(mesh, x[0], y - 0.1, 0);
    const uint32_t right = shapes_vertex(mesh, mesh->positions[3 * (size_t)from], y + 0.1, 0);
    shapes_triangle(mesh, from, from + 1, right);
    shapes_triangle(mesh, from, left, from + 1);
    shapes_triangle(mesh, from, right, left);
    shapes_triangle(mesh, from + 1, left, right);
    at[0] = 0.3;
  }
  if (kind == BIN || kind == CUT_BIN) shapes_box(mesh, 1, 0.8, 1.2, kind == BIN ? 1 : 5);
  if (kind == CUP) shapes_cylinder(mesh, 0.4, 0.9, 16);
  if (kind == TALL_CUP) shapes_cylinder(mesh, 0.2, 3, 16);
  if (kind == FUNNEL) shapes_cone(mesh, 0.2, 0.8, 0.9, 16);
  if (kind == BOWL || kind == FLAT_BOWL) shapes_ellipsoid(mesh, 0.5, 0.5, 0.5, 24);
  if (kind == TUBE || kind == LONG_TUBE) shapes_cylinder(mesh, 0.2, kind == TUBE ? 1 : 12, 20);
  if (kind == SQUARE_TUBE) shapes_box(mesh, 0.3, 0.3, 6, 1);
  if (kind == THREE_SIDED_TUBE) shapes_cylinder(mesh, 0.2, 4, 3);
  if (kind == HALF_PIPE) shapes_cylinder(mesh, 0.3, 2, 16);
  if (kind == TENT) shapes_cylinder(mesh, 0.4, 2, 3);
  double low[3], high[3];
  shapes_bounds(mesh, low, high);
  for (int k = 0; k < 3 && kind >= BIN && kind <= TENT; k++) at[k] = 0.5 * (low[k] + high[k]);
  const double fraction = kind == FLAT_BOWL ? 0.6 : kind == BOWL ? 0.45 : 0.999;
  if (kind >= BIN && kind <= TENT) solids_open_top(mesh, low[2] + fraction * (high[2] - low[2]));
  if (kind == FLAT_BOWL || kind == BOWL) at[2] = low[2] + 0.3;
  if (kind >= TUBE && kind < HALF_PIPE) {
    for (size_t i = 0; i < mesh->vertices; i++) mesh->positions[3 * i + 2] *= -1;
    shapes_bounds(mesh, low, high);
    solids_open_top(mesh, high[2] - 1e-3);
    at[2] *= -1;
  }
  for (size_t t = mesh->triangles; t-- > 0 && kind == HALF_PIPE;) {
    int above = 1;
    for (size_t k = 0; k < 3; k++) above &= solids_corner(mesh, t, k)[0] > -1e-6;
    if (above) solids_drop(mesh, t, 1);
  }
  if (kind == HALF_PIPE) at[0] = -0.15;
  if (kind == ROOM_WITH_A_DOOR || kind == HOUSE_WITH_A_GATE) {
    const double high_door = kind == ROOM_WITH_A_DOOR ? 0.3 : 0.8;
    shapes_box(mesh, 4, 5, 2.5, 10);
    if (kind == ROOM_WITH_A_DOOR) shapes_flip(mesh, 0);
    for (size_t t = mesh->triangles; t-- > 0;) {
      int in_door = 1;
      for (size_t k = 0; k < 3; k++) {
        const double *x = solids_corner(mesh, t, k);
        in_door &= x[0] > 1.99 && fabs(x[1]) < 0.51 && x[2] < high_door;
      }
      if (in_door) solids_drop(mesh, t, 1);
    }
  }
}

static void solids_of_sheets(void) {
  shapes_rng rng = {47};
  for (int n = 0; n < 2 * SHEETS; n++) {
    const int kind = n % SHEETS;
    shapes_mesh mesh, ball;
    double at[3], q[4];
    solids_sheet(kind, &mesh, &rng, at);
    if (n / SHEETS == 1 && kind != ROOM_WITH_A_DOOR && kind != HOUSE_WITH_A_GATE)
      shapes_flip(&mesh, 0);
    const uint32_t centre = shapes_vertex(&mesh, at[0], at[1], at[2]);
    shapes_quaternion(&rng, q);
    shapes_place(&mesh, 0, n < SHEETS ? NULL : q, 0, 0, 0);
    memcpy(at, mesh.positions + 3 * (size_t)centre, sizeof at);
    memset(&ball, 0, sizeof ball);
    shapes_ellipsoid(&ball, 0.03, 0.02, 0.03, 6);
    const nsvcd_body *small = solids_encode(&ball, 0);
    const nsvcd_body *body = solids_encode(&mesh, 0);
    const nsvcd_answer in = solids_ask(small, at, at, body);
    CHECK_EQ(in.verdict, NSVCD_FREE);
    CHECK_EQ(nsvcd_body_describe(body).open_components, 1);
    nsvcd_body_free(body, NULL);
    nsvcd_body_free(small, NULL);
    shapes_free(&mesh);
    shapes_free(&ball);
  }
}

// ------------------------------------------------------------------------------------------ gaps

// Two halves of a box, apart by a share of its diagonal: joined up to a ten-thousandth. Inside, close
// to the gap as well, nothing is free; and what is in front of it is.
static void solids_with_gaps(void) {
  shapes_rng rng = {48};
  for (int n = 0; n < 16; n++) {
    shapes_mesh mesh, ball;
    const int is_joined = n % 2;
    const double gap = sqrt(12) * (is_joined ? shapes_uniform(&rng, 1e-6, 9e-5) : 2e-4);
    memset(&mesh, 0, sizeof mesh);
    memset(&ball, 0, sizeof ball);
    for (int half = 0; half < 2; half++) {
      const size_t first = mesh.vertices;
      shapes_box(&mesh, 2, 2, 1, 2);
      shapes_place(&mesh, first, NULL, 0, 0, half ? 0.5 + gap : -0.5);
    }
    for (size_t t = mesh.triangles; t-- > 0;) {  // the sides where they face each other
      int is_within = 1;
      for (size_t k = 0; k < 3; k++)
        is_within &= fabs(solids_corner(&mesh, t, k)[2]) < 0.5 * gap + 1e-3;
      if (is_within) solids_drop(&mesh, t, 1);
    }
    shapes_ellipsoid(&ball, 0.01, 0.01, 0.01, 6);
    const nsvcd_body *small = solids_encode(&ball, 0);
    const nsvcd_body *body = solids_encode(&mesh, 0);
    for (int k = 0; k < 4; k++) {
      const double z = k % 2 ? shapes_uniform(&rng, -0.5, 0.5) : 0.5 * gap;
      const double at[3] = {k < 2 ? 0.9 : 1.1, shapes_uniform(&rng, -0.9, 0.9), z};
      const nsvcd_verdict said = solids_ask(small, at, at, body).verdict;
      CHECK_EQ(said, k < 2 && is_joined ? NSVCD_HIT : NSVCD_FREE);
    }
    CHECK_EQ(nsvcd_body_describe(body).open_components, is_joined ? 0 : 2);
    nsvcd_body_free(body, NULL);
    nsvcd_body_free(small, NULL);
    shapes_free(&mesh);
    shapes_free(&ball);
  }
}

// Through a gap that counts as closed a ray would leave without crossing anything: what is inside of a
// box that is split off its middle is not free, wherever it is.
static void solids_seen_through_a_gap(void) {
  shapes_rng rng = {50};
  shapes_mesh mesh, ball;
  size_t wrong = 0;
  memset(&mesh, 0, sizeof mesh);
  memset(&ball, 0, sizeof ball);
  for (int half = 0; half < 2; half++) {
    const size_t first = mesh.vertices;
    shapes_box(&mesh, 2, 2, half ? 0.5 : 1.5, 2);
    shapes_place(&mesh, first, NULL, 0, 0, half ? 0.75 + 2.5e-4 : -0.25);
  }
  for (size_t t = mesh.triangles; t-- > 0;) {
    int is_within = 1;
    for (size_t k = 0; k < 3; k++) is_within &= fabs(solids_corner(&mesh, t, k)[2] - 0.5) < 1e-3;
    if (is_within) solids_drop(&mesh, t, 1);
  }
  shapes_ellipsoid(&ball, 1e-3, 1e-3, 1e-3, 4);
  const nsvcd_body *small = solids_encode(&ball, 0);
  const nsvcd_body *body = solids_encode(&mesh, 0);
  CHECK_EQ(nsvcd_body_describe(body).open_components, 0);
  for (int n = 0; n < 4000; n++) {
    double at[3];
    for (int k = 0; k < 3; k++)
      at[k] = shapes_uniform(&rng, k == 2 ? 0.3 : 0.7, k == 2 ? 0.49 : 0.95);
    at[n % 2] *= shapes_uniform(&rng, -1, 1);
    wrong += solids_ask(small, at, at, body).verdict != NSVCD_HIT;
  }
  CHECK_EQ(wrong, 0);
  nsvcd_body_free(body, NULL);
  nsvcd_body_free(small, NULL);
  shapes_free(&mesh);
  shapes_free(&ball);
}

// Where the answer says so, no certificate says FREE of what is inside of a solid with a flaw.
static void solids_are_not_certified_free(void) {
  for (int flaw = FACE_TWICE; flaw < FLAWS; flaw += FACE_MISSING - FACE_TWICE) {
    shapes_rng rng = {49};
    shapes_mesh shapes[2];
    const nsvcd_body *bodies[2];
    const nsvcd_tree *trees[2];
    void *memory[2];
    nsvcd_mesh meshes[2];
    double inside[3];
    memset(shapes, 0, sizeof shapes);
    shapes_ellipsoid(&shapes[0], 0.02, 0.03, 0.02, 6);
    solids_shape(CUBE, &shapes[1], inside);
    solids_spoil(&shapes[1], inside, &rng, flaw);
    for (int k = 0; k < 2; k++) {
      meshes[k] = mesh_of(&shapes[k]);
      bodies[k] = solids_encode(&shapes[k], 0);
      const size_t size = nsvcd_tree_size(&meshes[k]);
      memory[k] = malloc(size);
      CHECK_EQ(nsvcd_tree_build(&meshes[k], memory[k], size, &trees[k]), NSVCD_OK);
    }
    const nsvcd_answer answer = solids_ask(bodies[0], inside, inside, bodies[1]);
    const nsvcd_certify_options options = {&answer, 0};
    nsvcd_question q;
    nsvcd_certificate made;
    memset(&made, 0, sizeof made);
    memset(&q, 0, sizeof q);
    const size_t size = nsvcd_certify_workspace_size(&q, trees[0], trees[1]);
    void *workspace = malloc(size);
    CHECK_EQ(nsvcd_certify(&q, trees[0], trees[1], &options, workspace, size, NULL, 0, &made),
             NSVCD_OK);
    CHECK_EQ(made.verdict, NSVCD_UNDECIDED);
    CHECK_EQ(made.why, NSVCD_WHY_OPEN);
    free(workspace);
    for (int k = 0; k < 2; k++) {
      nsvcd_body_free(bodies[k], NULL);
      shapes_free(&shapes[k]);
      nsvcd_mesh_free(&meshes[k], NULL);
      free(memory[k]);
    }
  }
}

// A fin that is the mesh's first triangle is set aside like any other, and leaves a solid.
static void solids_begin_with_a_fin(void) {
  shapes_mesh mesh;
  memset(&mesh, 0, sizeof mesh);
  shapes_box(&mesh, 1, 1, 1, 1);
  const uint32_t tip = shapes_vertex(&mesh, 0.5, -1, -1);
  shapes_triangle(&mesh, 0, 0, 0);
  for (size_t i = 3 * mesh.triangles; i-- > 3;) mesh.indices[i] = mesh.indices[i - 3];
  mesh.indices[0] = mesh.indices[3];
  mesh.indices[1] = mesh.indices[4];
  mesh.indices[2] = tip;
  const nsvcd_body *body = solids_encode(&mesh, 0);
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  CHECK_EQ(facts.components, 1);
  CHECK_EQ(facts.open_components, 0);
  CHECK_EQ(facts.open_edges, 0);
  nsvcd_body_free(body, NULL);
  shapes_free(&mesh);
}

void test_solids(void) {
  RUN(solids_seen_through_a_gap);
  RUN(solids_are_not_certified_free);
  RUN(solids_with_gaps);
  RUN(solids_with_a_flaw);
  RUN(solids_begin_with_a_fin);
  RUN(solids_of_sheets);
}

CHECK_ALONE(test_solids)
