// What src/interface/worlds.h promises, a test each: bodies at their places, one against all others.
#include "scene.h"

void promises_worlds(void);

enum { MOST = 8 };

// A world with memory of its own, and a workspace.
typedef struct room {
  nsvcd_world *world;
  void *memory, *workspace;
  size_t size;
} room;

static room room_begin(void) {
  room out;
  const size_t size = nsvcd_world_size(MOST);
  out.size = nsvcd_sweep_workspace_size(NULL);
  out.memory = malloc(size);
  out.workspace = malloc(out.size);
  out.world = NULL;
  CHECK(size > 0 && out.memory && out.workspace);
  CHECK_EQ(nsvcd_world_begin(out.memory, size, MOST, &out.world), NSVCD_OK);
  return out;
}
static void room_end(room *r) {
  free(r->memory);
  free(r->workspace);
}
static size_t put(room *r, const nsvcd_body *body, nsvcd_pose pose, int fixed) {
  const nsvcd_world_body given = {.body = body, .pose = pose, .fixed = fixed};
  size_t id = 0;
  CHECK_EQ(nsvcd_world_add(r->world, &given, &id), NSVCD_OK);
  return id;
}
static nsvcd_pose place_of(const room *r, size_t id) {
  nsvcd_world_body body;
  memset(&body, 0, sizeof body);
  CHECK_EQ(nsvcd_world_get(r->world, id, &body), NSVCD_OK);
  return body.pose;
}
static nsvcd_world_answer answer_of(const room *r, const nsvcd_world_question *question) {
  nsvcd_world_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_world_sweep(r->world, question, r->workspace, r->size, &answer), NSVCD_OK);
  return answer;
}

// Crates in a row, 1 m apart: each is near its neighbours.
static void a_world_knows_who_may_meet_whom(void) {
  const nsvcd_body *crate = box(0.4f, 0.4f, 0.4f);
  room r = room_begin();
  nsvcd_body_pair pairs[MOST];
  size_t ids[MOST], count = 0;
  for (int k = 0; k < MOST; k++) ids[k] = put(&r, crate, at((float)k, 0, 0), 0);
  CHECK_EQ(ids[0], 1);
  CHECK_EQ(nsvcd_world_pairs(r.world, 0.5f, pairs, MOST, &count), NSVCD_OK);
  CHECK_EQ(count, 0);
  CHECK_EQ(nsvcd_world_pairs(r.world, 0.7f, pairs, MOST, &count), NSVCD_OK);
  CHECK_EQ(count, MOST - 1);
  for (size_t k = 0; k < count; k++) CHECK_EQ(pairs[k].b, pairs[k].a + 1);
  const nsvcd_pose away = at(3, 5, 0);
  CHECK_EQ(nsvcd_world_move(r.world, ids[3], &away), NSVCD_OK);
  CHECK_EQ(nsvcd_world_remove(r.world, ids[7]), NSVCD_OK);
  CHECK_EQ(nsvcd_world_pairs(r.world, 0.7f, NULL, 0, &count), NSVCD_OK);
  CHECK_EQ(count, MOST - 1 - 3);
  CHECK_EQ(put(&r, crate, at(7, 0, 0), 0), ids[7]);
  // over its whole way, one that is driven comes near them all
  const nsvcd_pose to = at(-1, 0, 0);
  const nsvcd_pose from = at(9, 0, 0);
  CHECK_EQ(nsvcd_world_move(r.world, ids[3], &from), NSVCD_OK);
  CHECK_EQ(nsvcd_world_drive(r.world, ids[3], &to), NSVCD_OK);
  CHECK_EQ(nsvcd_world_pairs(r.world, 0.7f, NULL, 0, &count), NSVCD_OK);
  CHECK_EQ(count, MOST - 3 + MOST - 1);
  CHECK(place_of(&r, ids[3]).position[0] > 8.9f);
  CHECK_EQ(nsvcd_world_arrive(r.world), NSVCD_OK);
  CHECK(place_of(&r, ids[3]).position[0] < -0.9f);
  room_end(&r);
  nsvcd_body_free(crate, NULL);
}

// A ball is thrown along crates, of which the nearest is hit, and the safe pose is before it.
static void one_answer_about_all_that_is_near(void) {
  const nsvcd_body *crate = box(0.4f, 0.4f, 0.4f);
  const nsvcd_body *ball = box(0.1f, 0.1f, 0.1f);
  room r = room_begin();
  const size_t far_off = put(&r, crate, at(4, 0, 0), 1);
  const size_t near_by = put(&r, crate, at(2, 0.1f, 0), 1);
  const size_t thrown = put(&r, ball, at(0, 0, 0), 0);
  const nsvcd_pose way[2] = {at(0, 0, 0), at(10, 0, 0)};
  nsvcd_world_question q = {.self = thrown, .question = {.ask = NSVCD_ASK_FIRST}};
  q.question.a.poses = way;
  q.question.a.count = 2;
  const nsvcd_world_answer first = answer_of(&r, &q);
  CHECK_EQ(first.verdict, NSVCD_HIT);
  CHECK_EQ(first.body, near_by);
  CHECK_NEAR(first.time.high, 0.175, 1e-4);
  CHECK(first.safe.position[0] < 1.75f && first.safe.position[0] > 1.74f);
  CHECK_EQ(first.contact_count, 1);
  CHECK_EQ(first.contacts[0].body, near_by);
  CHECK(first.contacts[0].contact.normal[0] < -0.999f);
  size_t met[MOST], count = 0;
  q.question.ask = NSVCD_ASK_HIT;
  CHECK_EQ(nsvcd_world_list(r.world, &q, r.workspace, r.size, met, MOST, &count), NSVCD_OK);
  CHECK_EQ(count, 2);
  CHECK(met[0] == far_off && met[1] == near_by);
  room_end(&r);
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(ball, NULL);
}

// A crate that is in a floor and in a wall by 0.3 mm is pushed out of both at once.
static void one_push_out_of_all_that_it_is_in(void) {
  const nsvcd_body *slab = box(4, 4, 1);
  const nsvcd_body *wall = box(1, 4, 4);
  const nsvcd_body *crate = box(0.5f, 0.5f, 0.5f);
  room r = room_begin();
  (void)put(&r, slab, at(0, 0, -0.5f), 1);
  (void)put(&r, wall, at(0.75f, 0, 2), 1);
  const size_t id = put(&r, crate, at(0.0003f, 0, 0.2497f), 0);
  nsvcd_world_question q = {.self = id, .question = {.ask = NSVCD_ASK_FIRST}};
  CHECK_EQ(answer_of(&r, &q).verdict, NSVCD_HIT);
  q.question.slop = 0.001f;
  const nsvcd_world_answer answer = answer_of(&r, &q);
  CHECK_EQ(answer.verdict, NSVCD_FREE);
  CHECK(answer.push_out[0] < -0.0003f && answer.push_out[2] > 0.0003f);
  CHECK_LE(answer.depth, 0.0006f);
  room_end(&r);
  nsvcd_body_free(slab, NULL);
  nsvcd_body_free(wall, NULL);
  nsvcd_body_free(crate, NULL);
}

// Dropped beside a wall and pushed along it, a crate slides at its full speed, and overlaps nothing.
static void what_slides_keeps_its_speed_and_its_clearance(void) {
  const nsvcd_body *slab = box(10, 10, 1);
  const nsvcd_body *wall = box(0.3f, 6, 2);
  const nsvcd_body *crate = box(0.5f, 0.5f, 0.5f);
  room r = room_begin();
  (void)put(&r, slab, at(0, 0, -0.5f), 1);
  (void)put(&r, wall, at(0.402f, 0, 1.01f), 1);
  const size_t id = put(&r, crate, at(0, 0, 0.3f), 0);
  const nsvcd_slide_options options = {.clearance = 0.0005f, .margin = 0.0005f, .mass = 1};
  nsvcd_velocity v = {{0, 0, 0}, {0, 0, 0}};
  nsvcd_slide_answer answer;
  memset(&answer, 0, sizeof answer);
  for (int frame = 0; frame < 120; frame++) {
    v.linear[0] += 0.2f;
    v.linear[1] = 1;
    v.linear[2] -= 9.81f / 60;
    CHECK_EQ(nsvcd_world_slide(r.world, id, &options, 1.0f / 60, r.workspace, r.size, &v, &answer),
             NSVCD_OK);
    const nsvcd_world_question near_by = {.self = id, .question = {.clearance = 0.00049f}};
    CHECK_EQ(answer_of(&r, &near_by).verdict, NSVCD_FREE);
  }
  const nsvcd_pose there = place_of(&r, id);
  CHECK_NEAR(there.position[1], 2, 1e-3);
  CHECK(there.position[2] > 0.2505f && there.position[2] < 0.2511f);
  CHECK(answer.contact_count >= 2 && v.linear[2] <= 0);
  // left alone on the floor it rests, and then rests without a question
  for (int frame = 0; frame < 60; frame++) {
    v.linear[0] = v.linear[1] = 0;
    v.linear[2] = -9.81f / 60;
    CHECK_EQ(nsvcd_world_slide(r.world, id, &options, 1.0f / 60, r.workspace, r.size, &v, &answer),
             NSVCD_OK);
  }
  CHECK_EQ(answer.rests, 1);
  CHECK_EQ(answer.questions, 0);
  room_end(&r);
  nsvcd_body_free(slab, NULL);
  nsvcd_body_free(wall, NULL);
  nsvcd_body_free(crate, NULL);
}

// A lift carries who stands on it, up to a ceiling: then it is told who is caught.
static void who_is_driven_carries_and_catches(void) {
  const nsvcd_body *slab = box(4, 4, 1);
  const nsvcd_body *figure = box(0.5f, 0.5f, 1.5f);
  room r = room_begin();
  const size_t lift = put(&r, slab, at(0, 0, -0.5f), 1);
  (void)put(&r, slab, at(0, 0, 2.5f), 1);
  const size_t id = put(&r, figure, at(0, 0, 0.76f), 0);
  const nsvcd_slide_options options = {.clearance = 0.001f, .up = {0, 0, 1}};
  nsvcd_velocity v = {{0, 0, 0}, {0, 0, 0}};
  nsvcd_slide_answer answer;
  memset(&answer, 0, sizeof answer);
  int frame = 0;
  for (; frame < 90 && answer.caught == NSVCD_NOBODY; frame++) {
    const nsvcd_world_question here = {.self = id};
    CHECK_EQ(answer_of(&r, &here).verdict, NSVCD_FREE);
    nsvcd_pose to = place_of(&r, lift);
    to.position[2] += 1.0f / 60;
    v.linear[2] -= 9.81f / 60;
    CHECK_EQ(nsvcd_world_drive(r.world, lift, &to), NSVCD_OK);
    CHECK_EQ(nsvcd_world_slide(r.world, id, &options, 1.0f / 60, r.workspace, r.size, &v, &answer),
             NSVCD_OK);
    CHECK_EQ(nsvcd_world_arrive(r.world), NSVCD_OK);
    if (frame > 0 && frame < 25) CHECK_EQ(answer.ground, lift);
  }
  CHECK_EQ(answer.caught, lift);
  CHECK_NEAR(frame, 30, 1);
  room_end(&r);
  nsvcd_body_free(slab, NULL);
  nsvcd_body_free(figure, NULL);
}

// Two crates fall onto each other and sleep there, until the floor is gone. Their inertia is a mesh's.
static void a_step_is_a_frame_of_all(void) {
  float corners[8][3];
  uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  const nsvcd_body *slab = box(10, 10, 1);
  const nsvcd_body *crate = box(0.5f, 0.5f, 0.5f);
  const nsvcd_step_options options = {.gravity = {0, 0, -9.81f}};
  nsvcd_step_answer answer;
  nsvcd_world_mover movers[2];
  nsvcd_mass mass;
  room r = room_begin();
  for (int k = 0; k < 8; k++)
    for (int i = 0; i < 3; i++) corners[k][i] = (k >> i & 1) ? 0.25f : -0.25f;
  const nsvcd_mesh mesh = {corners[0], faces, 8, 12};
  CHECK_EQ(nsvcd_mesh_mass(&mesh, &mass), NSVCD_OK);
  CHECK_EQ(mass.is_of_box, 0);
  CHECK_NEAR(mass.volume, 0.125, 1e-6);
  CHECK_NEAR(mass.inertia[2], 1.0 / 24, 1e-6);
  const size_t floor = put(&r, slab, at(0, 0, -0.5f), 1);
  memset(movers, 0, sizeof movers);
  for (int k = 0; k < 2; k++) {
    movers[k].id = put(&r, crate, at(0.1f * (float)k, 0, 0.5f + 0.6f * (float)k), 0);
    movers[k].how.mass = 1;
    movers[k].how.friction = 0.5f;
    memcpy(movers[k].how.inertia, mass.inertia, sizeof mass.inertia);
  }
  for (int frame = 0; frame < 120; frame++)
    CHECK_EQ(
        nsvcd_world_step(r.world, movers, 2, &options, 1.0f / 60, r.workspace, r.size, &answer),
        NSVCD_OK);
  CHECK_EQ(answer.asleep, 2);
  CHECK_EQ(answer.questions, 0);
  CHECK(place_of(&r, movers[0].id).position[2] > 0.25f);
  CHECK(place_of(&r, movers[1].id).position[2] > place_of(&r, movers[0].id).position[2] + 0.5f);
  CHECK_EQ(nsvcd_world_remove(r.world, floor), NSVCD_OK);
  CHECK_EQ(nsvcd_world_step(r.world, movers, 2, &options, 1.0f / 60, r.workspace, r.size, &answer),
           NSVCD_OK);
  CHECK(answer.awake > 0 && !movers[0].asleep);
  movers[1].id = movers[0].id;
  CHECK_EQ(nsvcd_world_step(r.world, movers, 2, &options, 1.0f / 60, r.workspace, r.size, &answer),
           NSVCD_ERROR_INDEX);
  room_end(&r);
  nsvcd_body_free(slab, NULL);
  nsvcd_body_free(crate, NULL);
}

static void a_world_refuses_by_name(void) {
  const nsvcd_body *crate = box(0.5f, 0.5f, 0.5f);
  room r = room_begin();
  nsvcd_world *none = NULL;
  size_t id = 77, count = 77;
  nsvcd_world_body given = {.body = crate, .pose = at(0, 0, 0)};
  const nsvcd_pose nowhere = at(NAN, 0, 0);
  CHECK_EQ(nsvcd_world_size(0), 0);
  CHECK_EQ(nsvcd_world_begin(r.memory, 8, MOST, &none), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_world_begin(r.memory, 8, 0, &none), NSVCD_ERROR_COUNT);
  CHECK(none == NULL);
  given.scale = -1;
  CHECK_EQ(nsvcd_world_add(r.world, &given, &id), NSVCD_ERROR_SCALE);
  given.scale = 0;
  given.pose = nowhere;
  CHECK_EQ(nsvcd_world_add(r.world, &given, &id), NSVCD_ERROR_POSE);
  CHECK_EQ(id, 77);
  for (int k = 0; k < MOST; k++) (void)put(&r, crate, at((float)k, 0, 0), 0);
  given.pose = at(0, 5, 0);
  CHECK_EQ(nsvcd_world_add(r.world, &given, &id), NSVCD_ERROR_COUNT);
  CHECK_EQ(nsvcd_world_move(r.world, MOST + 1, &given.pose), NSVCD_ERROR_INDEX);
  CHECK_EQ(nsvcd_world_drive(r.world, 1, &nowhere), NSVCD_ERROR_POSE);
  CHECK_EQ(nsvcd_world_remove(r.world, NSVCD_NOBODY), NSVCD_ERROR_INDEX);
  CHECK_EQ(nsvcd_world_pairs(r.world, -1, NULL, 0, &count), NSVCD_ERROR_DISTANCE);
  nsvcd_world_question q = {.self = MOST + 1};
  nsvcd_world_answer answer;
  CHECK_EQ(nsvcd_world_sweep(r.world, &q, r.workspace, r.size, &answer), NSVCD_ERROR_INDEX);
  q.self = 1;
  q.question.ask = NSVCD_ASK_FIRST;
  CHECK_EQ(nsvcd_world_list(r.world, &q, r.workspace, r.size, NULL, 0, &count), NSVCD_ERROR_ASK);
  const nsvcd_slide_options options = {.friction = -1};
  nsvcd_velocity v = {{0, 0, 0}, {0, 0, 0}};
  nsvcd_slide_answer slid;
  memset(&slid, 0, sizeof slid);
  CHECK_EQ(nsvcd_world_slide(r.world, 1, &options, 0.1f, r.workspace, r.size, &v, &slid),
           NSVCD_ERROR_VALUE);
  CHECK_EQ(nsvcd_world_slide(r.world, 1, NULL, 0, r.workspace, r.size, &v, &slid),
           NSVCD_ERROR_TIMES);
  CHECK_EQ(count, 77);
  room_end(&r);
  nsvcd_body_free(crate, NULL);
}

void promises_worlds(void) {
  RUN(a_world_knows_who_may_meet_whom);
  RUN(one_answer_about_all_that_is_near);
  RUN(one_push_out_of_all_that_it_is_in);
  RUN(what_slides_keeps_its_speed_and_its_clearance);
  RUN(who_is_driven_carries_and_catches);
  RUN(a_step_is_a_frame_of_all);
  RUN(a_world_refuses_by_name);
}

CHECK_ALONE(promises_worlds)
