// What src/interface/looks.h promises, a test each: an opinion, that errs on the side that is named.
#include "scene.h"

void promises_looks(void);

// A body along x, a place after another: from `first` in steps of `step`, not turned.
static nsvcd_places along_x(float first, float step) {
  nsvcd_places places;
  memset(&places, 0, sizeof places);
  for (int l = 0; l < NSVCD_LOOKS; l++) {
    for (int k = 0; k < 3; k++) places.rotation[4 * k][l] = 1;
    places.position[0][l] = first + step * (float)l;
  }
  return places;
}

static const nsvcd_body *with_balls(nsvcd_mesh mesh, size_t balls) {
  const nsvcd_encode_options options = {.balls = balls};
  return body_of(mesh, &options);
}

// Two cubes of 1 m, gaps of -0.35 to 0.4 m: with balls, and as a box. Each margin errs on its side.
static void a_look_misses_no_meeting_and_invents_none(void) {
  const nsvcd_body *bodies[2] = {with_balls(box_mesh(1, 1, 1), 128), box(1, 1, 1)};
  const nsvcd_places there = along_x(0.65f, 0.05f), here = along_x(0, 0);
  for (int k = 0; k < 4; k++) {
    const nsvcd_looked a = {bodies[k % 2], 0, &there}, b = {bodies[k / 2], 0, &here};
    const nsvcd_body_facts facts[2] = {nsvcd_body_describe(a.body), nsvcd_body_describe(b.body)};
    const float errors = facts[0].ball_error + facts[1].ball_error;
    const float margins[3] = {0, 0.12f, -errors};
    for (int m = 0; m < 3; m++) {
      const nsvcd_look_options options = {.margin = margins[m]};
      uint32_t met = 0;
      CHECK_EQ(nsvcd_look(&a, &b, &options, &met), NSVCD_OK);
      for (int l = 0; l < NSVCD_LOOKS; l++) {
        const double gap = 0.65 + 0.05 * l - 1;
        if (m < 2 && gap <= (double)margins[m]) CHECK(met >> l & 1);
        if (m == 2 && gap > 1e-5 && k != 3) CHECK(!(met >> l & 1));
      }
      CHECK_EQ(met >> NSVCD_LOOKS, 0);
      const nsvcd_look_options any = {.margin = margins[m], .any = 1};
      uint32_t some = 0;
      CHECK_EQ(nsvcd_look(&a, &b, &any, &some), NSVCD_OK);
      CHECK_EQ(some != 0, met != 0);
    }
  }
  for (int k = 0; k < 2; k++) nsvcd_body_free(bodies[k], NULL);
}

// A mug's balls: as many as asked at the most, and each of its vertices is in one.
static void balls_cover_their_mesh(void) {
  const nsvcd_encode_options options = {.balls = 100};
  const nsvcd_places here = along_x(0, 0);
  const nsvcd_body *mug, *point;
  nsvcd_mesh mesh = mug_mesh();
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &mug), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_sphere(1e-6f, NULL, &point), NSVCD_OK);
  const nsvcd_body_facts facts = nsvcd_body_describe(mug);
  CHECK(facts.balls > 0 && facts.balls <= 100);
  CHECK(facts.ball_error > 0 && facts.ball_error < facts.radius);
  for (size_t v = 0; v < mesh.vertex_count; v++) {
    nsvcd_places there = along_x(0, 0);
    for (int l = 0; l < NSVCD_LOOKS; l++)
      for (int k = 0; k < 3; k++) there.position[k][l] = mesh.positions[3 * v + (size_t)k];
    const nsvcd_looked a = {point, 0, &there}, b = {mug, 0, &here};
    uint32_t met = 0;
    CHECK_EQ(nsvcd_look(&a, &b, NULL, &met), NSVCD_OK);
    CHECK_EQ(met, 0xffff);
  }
  nsvcd_mesh_free(&mesh, NULL);
  nsvcd_body_free(mug, NULL);
  nsvcd_body_free(point, NULL);
}

static void a_look_is_refused_by_name(void) {
  const nsvcd_body *body = with_balls(box_mesh(1, 1, 1), 20);
  const nsvcd_places here = along_x(0, 0);
  const nsvcd_looked good = {body, 0, &here}, small = {body, -1, &here}, nowhere = {body, 0, NULL};
  const nsvcd_look_options far_off = {.margin = 2e6f};
  const nsvcd_encode_options many = {.balls = NSVCD_MAX_BALLS + 1};
  const nsvcd_encode_options none = {.balls = 1, .no_triangles = 1};
  uint32_t met = 0;
  CHECK_EQ(nsvcd_look(&good, NULL, NULL, &met), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_look(&good, &nowhere, NULL, &met), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_look(&small, &good, NULL, &met), NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_look(&good, &good, &far_off, &met), NSVCD_ERROR_CLEARANCE);
  nsvcd_mesh mesh = box_mesh(1, 1, 1);
  const nsvcd_body *refused = NULL;
  CHECK_EQ(nsvcd_encode(&mesh, &many, NULL, NULL, 0, &refused), NSVCD_ERROR_COUNT);
  CHECK_EQ(nsvcd_encode(&mesh, &none, NULL, NULL, 0, &refused), NSVCD_ERROR_TRIANGLES);
  CHECK(refused == NULL);
  nsvcd_mesh_free(&mesh, NULL);
  nsvcd_body_free(body, NULL);
}

void promises_looks(void) {
  RUN(a_look_misses_no_meeting_and_invents_none);
  RUN(balls_cover_their_mesh);
  RUN(a_look_is_refused_by_name);
}

CHECK_ALONE(promises_looks)
