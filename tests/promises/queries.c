// What src/interface/queries.h promises, a test each: what an answer about two bodies that move
// says is so. In metres; b rests at the origin unless it is said to move.
#include "scene.h"
#include <pthread.h>

void promises_queries(void);

// ---- verdicts

static void a_cart_that_drives_past_is_free_and_into_a_post_is_a_hit(void) {
  const nsvcd_body *cart = box(1, 0.6f, 0.4f), *post = box(0.1f, 0.1f, 2);
  const nsvcd_pose past[2] = {at(-3, 0.4f, 0), at(3, 0.4f, 0)};
  const nsvcd_pose into[2] = {at(-3, 0.3f, 0), at(3, 0.3f, 0)};
  nsvcd_question question = question_about(cart, past, 2, post);
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  question.a.poses = into;
  const nsvcd_answer answer = answer_to(&question);
  CHECK(answer.verdict == NSVCD_HIT && answer.by == NSVCD_BY_PROOF);
  CHECK_EQ(answer.why, NSVCD_WHY_NOTHING);
  CHECK(!strcmp(nsvcd_verdict_string(NSVCD_HIT), "hit"));
  nsvcd_body_free(cart, NULL);
  nsvcd_body_free(post, NULL);
}

// A gate is clear of the post at both of its poses, and sweeps over it in between.
static void what_happens_between_two_poses_is_seen(void) {
  const nsvcd_body *gate = box(2, 0.05f, 0.5f), *post = box(0.1f, 0.1f, 2);
  const nsvcd_pose poses[2] = {turned(-0.7f, 0, 0, 0.8f), turned(-0.7f, 0, 0, -0.8f)};
  nsvcd_question question = question_about(gate, poses, 2, post);
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  for (int k = 0; k < 2; k++) {
    question.a.poses = poses + k;
    question.a.count = 1;
    CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  }
  nsvcd_body_free(gate, NULL);
  nsvcd_body_free(post, NULL);
}

// Position linear and rotation slerp: the pose half way, put in, changes nothing.
static void between_poses_a_motion_is_a_line_and_a_slerp(void) {
  const nsvcd_body *gate = box(2, 0.05f, 0.5f), *post = box(0.1f, 0.1f, 2);
  const nsvcd_pose poses[3] = {turned(-0.9f, 0.2f, 0, 1), turned(-0.7f, 0.1f, 0, 0.1f),
                               turned(-0.5f, 0, 0, -0.8f)};
  const nsvcd_pose ends[2] = {poses[0], poses[2]};
  nsvcd_question question = question_about(gate, ends, 2, post);
  question.ask = NSVCD_ASK_FIRST;
  question.to = 1e-5f;
  const nsvcd_range time = answer_to(&question).time;
  question.a.poses = poses;
  question.a.count = 3;
  const nsvcd_range again = answer_to(&question).time;
  CHECK(time.high > 0.1f && time.high < 0.9f);
  CHECK_NEAR(again.low, time.low, 1e-5);
  CHECK_NEAR(again.high, time.high, 1e-5);
  nsvcd_body_free(gate, NULL);
  nsvcd_body_free(post, NULL);
}

// When does a body first meet another one, which stands there? To a tenth of a millimetre.
static nsvcd_question first_against(const nsvcd_body *moving, const nsvcd_pose *poses, size_t count,
                                    const nsvcd_body *other, const nsvcd_pose *stands) {
  nsvcd_question question = question_about(moving, poses, count, other);
  question.b.poses = stands;
  question.b.count = 1;
  question.ask = NSVCD_ASK_FIRST;
  question.to = 1e-4f;
  return question;
}

// A door of two poses, whose origin is in its middle, sweeps a quarter of a circle about its hinge:
// as one of 200 poses does, whose origin goes round. A post in its way is not where it would pass
// without a pivot. And a door twice as large hits it sooner.
static void a_body_turns_about_its_pivot(void) {
  enum { POSES = 200 };
  const float quarter = 1.57079633f;  // of a turn, radians
  const nsvcd_body *door = box(2, 0.05f, 0.5f), *post = box(0.1f, 0.1f, 2);
  const nsvcd_pose stands = at(1.34f, 1.34f, 0), ends[2] = {at(1, 0, 0), turned(0, 1, 0, quarter)};
  nsvcd_pose round[POSES];
  for (int k = 0; k < POSES; k++) {
    const float angle = quarter * (float)k / (POSES - 1);
    round[k] = turned(cosf(angle), sinf(angle), 0, angle);
  }
  nsvcd_question question = first_against(door, ends, 2, post, &stands);
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  question.a.pivot[0] = -1;
  const nsvcd_range time = answer_to(&question).time;
  const nsvcd_mover by_pivot = question.a;
  question.a = question.b;  // it does not matter which one it is
  question.b = by_pivot;
  CHECK_NEAR(answer_to(&question).time.high, time.high, 1e-4);
  question = first_against(door, round, POSES, post, &stands);
  CHECK_NEAR(answer_to(&question).time.high, time.high, 1e-3);
  const nsvcd_pose larger[2] = {at(2, 0, 0), turned(0, 2, 0, quarter)};
  question.a = by_pivot;
  question.a.poses = larger;
  question.a.scale = 2;  // the pivot, too
  const nsvcd_range sooner = answer_to(&question).time;
  CHECK(time.low > 0.4f && sooner.high < time.low && sooner.low > 0.4f);
  nsvcd_body_free(door, NULL);
  nsvcd_body_free(post, NULL);
}

// A screw is a turn about a pivot on its axis: two poses are as good as a helix of 200. The thread
// comes round under a pin that it would pass beside.
static void a_screw_turns_about_its_axis(void) {
  enum { POSES = 200 };
  const nsvcd_body *thread = box(0.2f, 0.2f, 0.02f), *pin = box(0.1f, 0.1f, 0.1f);
  nsvcd_pose helix[POSES];
  for (int k = 0; k < POSES; k++) {
    const float share = (float)k / (POSES - 1);
    const float angle = 3 * share;  // radians
    helix[k] = turned(cosf(angle), sinf(angle), share, angle);
  }
  const nsvcd_pose ends[2] = {helix[0], helix[POSES - 1]};
  const nsvcd_pose stands = at(cosf(1.5f), sinf(1.5f), 0.5f);
  nsvcd_question question = first_against(thread, ends, 2, pin, &stands);
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  question.a.pivot[0] = -1;
  const nsvcd_range time = answer_to(&question).time;
  question.a.pivot[2] = 7;  // any point of the axis
  CHECK_NEAR(answer_to(&question).time.high, time.high, 1e-4);
  question.a.pivot[0] = question.a.pivot[2] = 0;
  question.a.poses = helix;
  question.a.count = POSES;
  CHECK_NEAR(answer_to(&question).time.high, time.high, 1e-3);
  CHECK(time.low > 0.3f && time.high < 0.5f);
  nsvcd_body_free(thread, NULL);
  nsvcd_body_free(pin, NULL);
}

static void one_low_pose_of_a_thousand_is_found(void) {
  enum { POSES = 1000, LOW = 700 };
  const nsvcd_body *cart = box(0.4f, 0.4f, 0.4f), *table = box(20, 2, 0.1f);
  static nsvcd_pose poses[POSES];
  for (int i = 0; i < POSES; i++)
    poses[i] = at(-5 + 0.01f * (float)i, 0, i == LOW ? 0.249f : 0.251f);
  nsvcd_question question = question_about(cart, poses, POSES, table);
  question.ask = NSVCD_ASK_FIRST;
  const nsvcd_answer answer = answer_to(&question);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK(answer.time.high > (LOW - 1.0) / (POSES - 1) && answer.time.low < (float)LOW / (POSES - 1));
  poses[LOW].position[2] = 0.251f;
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  nsvcd_body_free(cart, NULL);
  nsvcd_body_free(table, NULL);
}

static void a_close_fit_is_told_from_a_hit(void) {
  const nsvcd_body *drawer = box(0.4f, 0.5f, 0.2f), *side = box(0.02f, 0.6f, 0.2f);
  nsvcd_pose poses[2] = {at(0.21001f, -1, 0), at(0.21001f, 0, 0)};
  nsvcd_question question = question_about(drawer, poses, 2, side);
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  poses[0].position[0] = poses[1].position[0] = 0.20999f;
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  question.tolerance = 1e-4f;
  poses[0].position[0] = poses[1].position[0] = 0.21001f;  // it may be left open, and is no hit
  CHECK(verdict_of(&question) != NSVCD_HIT);
  nsvcd_body_free(drawer, NULL);
  nsvcd_body_free(side, NULL);
}

// Of two triangles a face, and two kilometres wide.
static void a_floor_of_two_kilometres_is_told_to_a_hair(void) {
  const nsvcd_body *crate = box(1, 1, 1), *floor = box(2000, 2000, 1);
  for (int k = 0; k < 4; k++) {
    const float above = k & 1 ? 2e-5f : -2e-5f;
    const nsvcd_pose poses[2] = {at(k & 2 ? 900 : 0, -30, 1 + above), at(10, 30, 1 + above)};
    const nsvcd_question question = question_about(crate, poses, 2, floor);
    CHECK_EQ(verdict_of(&question), above > 0 ? NSVCD_FREE : NSVCD_HIT);
  }
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(floor, NULL);
}

// A sheet of 3,200 triangles, in 1,000 patches and more, with a tip in the middle.
static void a_body_of_any_number_of_patches_is_right(void) {
  const nsvcd_encode_options options = {.patches = 1000, .open = 1};
  const nsvcd_body *land = body_of(sheet_mesh(40, 1), &options), *cart = box(0.2f, 0.2f, 0.2f);
  CHECK(nsvcd_body_describe(land).patches > NSVCD_SMALL_PATCHES);
  for (int k = 0; k < 2; k++) {
    const float z = k ? 1.101f : 1.099f;
    const nsvcd_pose poses[2] = {at(-19, 0.05f, z), at(19, -0.05f, z)};
    const nsvcd_question question = question_about(cart, poses, 2, land);
    CHECK_EQ(verdict_of(&question), k ? NSVCD_FREE : NSVCD_HIT);
  }
  nsvcd_body_free(land, NULL);
  nsvcd_body_free(cart, NULL);
}

static void the_unit_of_length_does_not_matter(void) {
  static const float units[5] = {1e-6f, 1e-3f, 1, 1e3f, 1e5f};
  const nsvcd_body *cart = box(1, 0.6f, 0.4f), *post = box(0.1f, 0.1f, 2);
  for (int u = 0; u < 5; u++) {
    for (int k = 0; k < 2; k++) {
      const float y = units[u] * (k ? 0.351f : 0.349f);
      const nsvcd_pose poses[2] = {at(-3 * units[u], y, 0), at(3 * units[u], y, 0)};
      nsvcd_question question = question_about(cart, poses, 2, post);
      question.a.scale = question.b.scale = units[u];
      CHECK_EQ(verdict_of(&question), k ? NSVCD_FREE : NSVCD_HIT);
    }
  }
  nsvcd_body_free(cart, NULL);
  nsvcd_body_free(post, NULL);
}

static void triangles_listed_twice_change_nothing(void) {
  nsvcd_mesh once = box_mesh(1, 0.6f, 0.4f), twice = once;
  const size_t size = 3 * once.triangle_count * sizeof(uint32_t);
  twice.indices = (uint32_t *)malloc(2 * size);
  memcpy(twice.indices, once.indices, size);
  memcpy(twice.indices + 3 * once.triangle_count, once.indices, size);
  twice.triangle_count *= 2;
  const nsvcd_body *post = box(0.1f, 0.1f, 2), *cart = NULL;
  CHECK_EQ(nsvcd_encode(&twice, NULL, NULL, NULL, 0, &cart), NSVCD_OK);
  for (int k = 0; k < 2; k++) {
    const float y = k ? 0.351f : 0.349f;
    const nsvcd_pose poses[2] = {at(-3, y, 0), at(3, y, 0)};
    const nsvcd_question question = question_about(cart, poses, 2, post);
    CHECK_EQ(verdict_of(&question), k ? NSVCD_FREE : NSVCD_HIT);
  }
  free(twice.indices);
  nsvcd_mesh_free(&once, NULL);
  nsvcd_body_free(cart, NULL);
  nsvcd_body_free(post, NULL);
}

static void it_does_not_matter_which_body_is_a(void) {
  const nsvcd_body *gate = box(2, 0.05f, 0.5f), *post = box(0.1f, 0.1f, 2);
  for (int k = 0; k < 10; k++) {
    const nsvcd_pose poses[2] = {turned(-0.2f * (float)k, 0, 0, 0.8f),
                                 turned(-0.2f * (float)k, 0, 0, -0.8f)};
    nsvcd_question question = question_about(gate, poses, 2, post);
    const nsvcd_verdict verdict = verdict_of(&question);
    const nsvcd_mover moving = question.a;
    CHECK_EQ(verdict, k < 6 ? NSVCD_HIT : NSVCD_FREE);
    question.a = question.b;
    question.b = moving;
    CHECK_EQ(verdict_of(&question), verdict);
  }
  nsvcd_body_free(gate, NULL);
  nsvcd_body_free(post, NULL);
}

// Two carts, one behind the other, at one speed; then the second one is faster.
static void both_bodies_may_move(void) {
  const nsvcd_body *cart = box(1, 0.6f, 0.4f);
  const nsvcd_pose first[3] = {at(2, 0, 0), at(4, 0, 0), at(12, 0, 0)};
  nsvcd_pose second[2] = {at(0, 0, 0), at(10, 0, 0)};
  const float times[3] = {0, 0.2f, 1};
  nsvcd_question question = question_about(cart, second, 2, cart);
  question.b = (nsvcd_mover){.body = cart, .poses = first, .count = 3, .times = times};
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  second[1] = at(11.5f, 0, 0);
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  question.a.scale = question.b.scale = 0.4f;  // and half a metre long they would not meet
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  nsvcd_body_free(cart, NULL);
}

static void what_is_inside_is_a_hit_but_of_what_is_open(void) {
  const nsvcd_encode_options open = {.open = 1};
  const nsvcd_body *ball = box(0.1f, 0.1f, 0.1f), *crate = box(1, 1, 1);
  const nsvcd_body *bin = body_of(box_mesh_of(1, 1, 1, OPEN_BOX_FACES), &open);
  const nsvcd_pose pose = at(0.1f, 0.2f, 0);
  nsvcd_question question = question_about(ball, &pose, 1, crate);
  const nsvcd_answer answer = answer_to(&question);
  CHECK(answer.verdict == NSVCD_HIT && answer.inside);
  question.b.body = bin;
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  nsvcd_body_free(ball, NULL);
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(bin, NULL);
}

// One triangle of twelve is missing, a flaw and not a lid: unless it is said to be open.
static void inside_of_what_is_nearly_a_solid_is_undecided(void) {
  nsvcd_mesh mesh = box_mesh(1, 1, 1);
  mesh.triangle_count--;
  const nsvcd_body *crate = body_of(mesh, NULL), *ball = box(0.1f, 0.1f, 0.1f);
  const nsvcd_pose pose = at(0.1f, 0.2f, 0);
  const nsvcd_question question = question_about(ball, &pose, 1, crate);
  const nsvcd_answer answer = answer_to(&question);
  CHECK(answer.verdict == NSVCD_UNDECIDED && answer.why == NSVCD_WHY_OPEN);
  nsvcd_body_free(ball, NULL);
  nsvcd_body_free(crate, NULL);
}

// ---- the first contact

// A cube flies into a wall that it touches after 6 of 10 m.
static void the_first_contact_is_the_first(void) {
  const nsvcd_body *cube = box(1, 1, 1), *wall = box(1, 10, 10);
  const nsvcd_pose poses[2] = {at(-7, 0.1f, 0.2f), at(3, 0.1f, 0.2f)};
  nsvcd_question question = question_about(cube, poses, 2, wall);
  question.ask = NSVCD_ASK_FIRST;
  question.to = 1e-4f;
  const nsvcd_answer answer = answer_to(&question);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK(answer.time.low <= 0.6f && answer.time.high >= 0.6f);
  CHECK_LE(10 * (answer.time.high - answer.time.low), 1e-4 + 2e-6);  // and times are floats

  // It is from b to a, against the motion, and names the triangles and the place.
  const nsvcd_contact *contact = &answer.contacts[0];
  CHECK_EQ(answer.contact_count, 1);
  CHECK_NEAR(contact->normal[0], -1, 1e-6);
  CHECK_NEAR(contact->point[0], -0.5, 2e-4);
  CHECK(contact->triangle_a < 12 && contact->triangle_b < 12);
  CHECK_EQ(contact->time, answer.time.high);
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

static void at_the_safe_place_they_are_apart(void) {
  const nsvcd_body *cube = box(1, 1, 1), *wall = box(1, 10, 10);
  const nsvcd_pose poses[2] = {at(-7, 0, 0), turned(3, 0, 0, 1)};
  nsvcd_question question = question_about(cube, poses, 2, wall);
  question.ask = NSVCD_ASK_FIRST;
  const nsvcd_safe_pose safe = answer_to(&question).safe;
  CHECK(safe.time > 0.5f && safe.time < 0.6f);
  question = question_about(cube, &safe.a, 1, wall);
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  question.clearance = 0.01f;
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

static void a_manifold_holds_a_crate_at_four_corners(void) {
  const nsvcd_body *crate = box(1, 0.8f, 0.5f), *table = box(4, 4, 0.1f);
  nsvcd_pose poses[2] = {at(0, 0, 1), at(0, 0, 0)};
  nsvcd_question question = question_about(crate, poses, 2, table);
  question.ask = NSVCD_ASK_FIRST;
  question.manifold = 1;
  const nsvcd_answer answer = answer_to(&question);
  poses[0].position[0] = poses[1].position[0] = 0.01f;  // the next time a little beside
  const nsvcd_answer beside = answer_to(&question);
  CHECK_EQ(answer.contact_count, 4);
  for (size_t i = 0; i < answer.contact_count; i++) {
    const nsvcd_contact *contact = &answer.contacts[i];
    CHECK_NEAR(fabsf(contact->point[0]), 0.5, 1e-5);
    CHECK_NEAR(fabsf(contact->point[1]), 0.4, 1e-5);
    CHECK_NEAR(contact->normal[2], 1, 1e-6);
    CHECK(i == 0 || contact->id > contact[-1].id);
    CHECK_EQ(beside.contacts[i].id, contact->id);
  }
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(table, NULL);
}

// On a table with a wall: 1 mm off the table and 2 mm off the wall.
static void what_a_crate_stands_on_and_leans_on_is_told(void) {
  const nsvcd_body *crate = box(1, 0.8f, 0.5f);
  const nsvcd_body *room = body_of(stacked(box_mesh(4, 4, 0.1f), box_mesh(0.2f, 4, 2), 1), NULL);
  const nsvcd_pose pose = at(0.602f, 0, 0.301f);
  nsvcd_question question = question_about(crate, &pose, 1, room);
  nsvcd_contact contacts[NSVCD_MAX_SIDES * NSVCD_MAX_CONTACTS];
  const size_t most = NSVCD_MAX_SIDES * NSVCD_MAX_CONTACTS;
  question.clearance = 0.005f;
  const size_t size = nsvcd_sweep_workspace_size(&question);
  void *workspace = malloc(size);
  size_t count = 0;
  int is_partial = 1;
  CHECK_EQ(nsvcd_contacts(&question, workspace, size, contacts, most, &count, &is_partial),
           NSVCD_OK);
  CHECK_EQ(count, 8);
  CHECK(!is_partial);
  for (size_t k = 0; k < count; k++) {
    CHECK_NEAR(contacts[k].normal[k < 4 ? 2 : 0], 1, 1e-6);
    CHECK_NEAR(contacts[k].gap, k < 4 ? 0.001 : 0.002, 1e-6);
    CHECK_NEAR(contacts[k].point[k < 4 ? 2 : 0], k < 4 ? 0.05 : 0.1, 1e-6);
  }
  CHECK_EQ(nsvcd_contacts(&question, workspace, size, contacts, 2, &count, NULL), NSVCD_OK);
  CHECK_EQ(count, 2);
  question.clearance = 0.0005f;
  CHECK_EQ(nsvcd_contacts(&question, workspace, size, NULL, 0, &count, NULL), NSVCD_OK);
  CHECK_EQ(count, 0);
  question.clearance = 0;
  CHECK_EQ(nsvcd_contacts(&question, workspace, size, contacts, most, &count, NULL),
           NSVCD_ERROR_CLEARANCE);
  free(workspace);
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(room, NULL);
}

// ---- distances

static void a_clearance_is_kept(void) {
  const nsvcd_body *cart = box(1, 0.6f, 0.4f), *post = box(0.1f, 0.1f, 2);
  const nsvcd_pose poses[2] = {at(-3, 0.45f, 0), at(3, 0.45f, 0)};  // 0.1 m from it
  nsvcd_question question = question_about(cart, poses, 2, post);
  question.clearance = 0.0999f;
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  question.clearance = 0.1001f;
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  nsvcd_body_free(cart, NULL);
  nsvcd_body_free(post, NULL);
}

static void a_distance_is_bracketed_as_narrowly_as_is_said(void) {
  const nsvcd_body *cart = box(1, 0.6f, 0.4f), *post = box(0.1f, 0.1f, 2);
  const nsvcd_pose poses[2] = {at(-3, 0.45f, 0), at(3, 0.45f, 0)};
  nsvcd_question question = question_about(cart, poses, 2, post);
  question.ask = NSVCD_ASK_DISTANCE;
  question.to = 1e-3f;
  const nsvcd_answer answer = answer_to(&question);
  CHECK_EQ(answer.verdict, NSVCD_FREE);
  CHECK(answer.distance.low <= 0.1f + 1e-7f && answer.distance.high >= 0.1f - 1e-7f);
  CHECK_LE(answer.distance.high - answer.distance.low, 1.001e-3);
  CHECK_NEAR(answer.nearest.gap, 0.1, 1e-3);
  CHECK(answer.nearest.time > 0.4f && answer.nearest.time < 0.6f);
  nsvcd_body_free(cart, NULL);
  nsvcd_body_free(post, NULL);
}

// ---- what touches at the start

// A crate 0.2 mm deep in a table slides along it, with a skin of 1 mm.
static void with_a_skin_what_rests_may_slide(void) {
  const nsvcd_body *crate = box(0.5f, 0.5f, 0.5f), *table = box(4, 4, 0.1f);
  const nsvcd_pose slide[2] = {at(-1, 0, 0.2998f), at(1, 0, 0.2998f)};
  const nsvcd_pose sink[2] = {at(-1, 0, 0.2998f), at(1, 0, 0.29f)};
  nsvcd_question question = question_about(crate, slide, 2, table);
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  question.slop = 1e-3f;
  const nsvcd_answer answer = answer_to(&question);
  CHECK_EQ(answer.verdict, NSVCD_FREE);
  CHECK_NEAR(answer.depth, 2e-4, 1e-5);
  CHECK_NEAR(answer.push_out[2], 1e-3, 1e-6);
  CHECK_EQ(answer.push_out[0], 0);
  question.a.poses = sink;
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(table, NULL);
}

// Between a floor and a ceiling with 0.4 mm of room: pushed out by what is needed, not by all of 1 mm.
static void under_a_ceiling_a_skin_is_as_thick_as_there_is_room(void) {
  const nsvcd_body *crate = box(0.5f, 0.5f, 0.5f);
  const nsvcd_body *shelf =
      body_of(stacked(box_mesh(4, 4, 0.1f), box_mesh(4, 4, 0.1f), 0.6004f), NULL);
  for (int k = 0; k < 5; k++) {
    const float deep =
        k < 4 ? 1e-4f * (float)k : 1.2e-3f;  // the last one by more than there is room
    const nsvcd_pose slide[2] = {at(-1, 0, 0.3f - deep), at(1, 0, 0.3f - deep)};
    nsvcd_question question = question_about(crate, slide, 2, shelf);
    question.slop = 1e-3f;
    const nsvcd_answer answer = answer_to(&question);
    CHECK_EQ(answer.verdict, k < 4 ? NSVCD_FREE : NSVCD_HIT);
    CHECK_LE(answer.push_out[2], 4e-4f + deep);
    if (k < 4) CHECK_NEAR(answer.depth, deep, 1e-6 + 0.01 * (double)deep);
  }
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(shelf, NULL);
}

// Dropped on a table, and then pushed along it, frame by frame from the place that is safe.
static void what_was_stopped_goes_on(void) {
  const nsvcd_body *crate = box(0.5f, 0.5f, 0.5f), *table = box(4, 4, 0.1f);
  const nsvcd_pose drop[2] = {at(-0.5f, 0, 0.5f), at(-0.5f, 0, 0.2f)};
  nsvcd_question question = question_about(crate, drop, 2, table);
  question.ask = NSVCD_ASK_FIRST;
  question.to = 5e-4f;
  question.slop = 1e-3f;
  nsvcd_answer answer = answer_to(&question);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  for (int frame = 0; frame < 20; frame++) {
    nsvcd_pose push[2] = {answer.safe.a, answer.safe.a};
    push[1].position[0] += 0.05f;
    question.a.poses = push;
    answer = answer_to(&question);
    CHECK_EQ(answer.verdict, NSVCD_FREE);
  }
  CHECK_NEAR(answer.safe.a.position[0], 0.5, 1e-3);
  CHECK_NEAR(answer.safe.a.position[2], 0.3, 2e-3);
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(table, NULL);
}

static void a_lift_by_the_depth_ends_a_contact(void) {
  const nsvcd_body *crate = box(0.5f, 0.5f, 0.5f), *table = box(4, 4, 0.1f);
  nsvcd_pose pose = at(0.3f, 0, 0.29f);  // 1 cm deep
  nsvcd_question question = question_about(crate, &pose, 1, table);
  question.slop = 0.02f;
  const nsvcd_answer answer = answer_to(&question);
  CHECK_NEAR(answer.depth, 0.01, 4e-4);
  question.slop = 0;
  pose.position[2] = 0.29f + 1.001f * answer.depth;
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  pose.position[2] = 0.29f + 0.9f * answer.depth;
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(table, NULL);
}

// ---- every question

// By proof and by the network, alone and in a batch, whatever the workspace held.
static void the_same_question_has_the_same_answer(void) {
  const nsvcd_encode_options options = {.latents = 1};
  const nsvcd_body *mug = body_of(mug_mesh(), &options),
                   *post = body_of(box_mesh(0.1f, 0.1f, 2), &options);
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  unsigned char *workspace = (unsigned char *)malloc(size);
  for (int i = 0; i < 20; i++) {
    const nsvcd_pose poses[2] = {at(-0.3f, 0.01f * (float)i, 0),
                                 turned(0.3f, 0.01f * (float)i, 0, 1)};
    nsvcd_question question = question_about(mug, poses, 2, post);
    question.method = i % 2 ? NSVCD_METHOD_NETWORK : NSVCD_METHOD_PROOF;
    question.ask = i % 4 == 0 ? NSVCD_ASK_FIRST : i % 4 == 2 ? NSVCD_ASK_DISTANCE : NSVCD_ASK_HIT;
    nsvcd_answer answers[2];
    for (int k = 0; k < 2; k++) {
      memset(workspace, k ? 0xff : 0, size);
      memset(&answers[k], 0, sizeof answers[k]);
      if (k) CHECK_EQ(nsvcd_sweep_batch(&question, 1, workspace, size, &answers[k]), NSVCD_OK);
      if (!k) CHECK_EQ(nsvcd_sweep(&question, workspace, size, &answers[k]), NSVCD_OK);
    }
    CHECK(answers[0].verdict == answers[1].verdict && answers[0].work == answers[1].work);
    CHECK(!memcmp(&answers[0].time, &answers[1].time, sizeof answers[0].time));
    CHECK(!memcmp(&answers[0].safe, &answers[1].safe, sizeof answers[0].safe));
    CHECK(!memcmp(&answers[0].nearest, &answers[1].nearest, sizeof answers[0].nearest));
    CHECK(!memcmp(&answers[0].distance, &answers[1].distance, sizeof answers[0].distance));
    CHECK(!memcmp(&answers[0].opinion.logit, &answers[1].opinion.logit, sizeof(float)));
  }
  free(workspace);
  nsvcd_body_free(mug, NULL);
  nsvcd_body_free(post, NULL);
}

// And nothing of it is answered, whichever question is at fault.
static void a_batch_is_refused_as_a_whole(void) {
  const nsvcd_body *cube = box(1, 1, 1), *wall = box(1, 10, 10);
  const nsvcd_pose poses[2] = {at(-7, 0, 0), at(3, 0, 0)};
  nsvcd_question questions[3];
  nsvcd_answer answers[3], before[3];
  for (int i = 0; i < 3; i++) questions[i] = question_about(cube, poses, 2, wall);
  const size_t size = nsvcd_sweep_workspace_size(&questions[0]);
  void *workspace = malloc(size);
  memset(answers, 0x5a, sizeof answers);
  memcpy(before, answers, sizeof before);
  questions[2].clearance = -1;
  CHECK_EQ(nsvcd_sweep_batch(questions, 3, workspace, size, answers), NSVCD_ERROR_CLEARANCE);
  questions[2].clearance = 0;
  CHECK_EQ(nsvcd_sweep_batch(questions, 3, workspace, size - 1, answers), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_sweep_batch(NULL, 3, workspace, size, answers), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_sweep_batch(questions, 3, workspace, size, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_sweep_batch(questions, 0, workspace, size, answers), NSVCD_OK);
  CHECK(!memcmp(answers, before, sizeof before));
  CHECK_EQ(nsvcd_sweep_batch(questions, 3, workspace, size, answers), NSVCD_OK);
  CHECK(answers[0].verdict == NSVCD_HIT && answers[2].verdict == NSVCD_HIT);
  free(workspace);
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

static void the_workspace_that_is_asked_for_suffices(void) {
  const nsvcd_body *cube = box(1, 1, 1), *wall = box(1, 10, 10);
  const nsvcd_pose poses[2] = {at(-7, 0, 0), turned(3, 0, 0, 1)};
  const nsvcd_question question = question_about(cube, poses, 2, wall);
  const size_t size = nsvcd_sweep_workspace_size(&question);
  unsigned char *workspace = (unsigned char *)malloc(size + 64);
  nsvcd_answer answer;
  memset(workspace, 0xa5, size + 64);
  CHECK_EQ(nsvcd_sweep(&question, workspace, size, &answer), NSVCD_OK);
  for (size_t i = size; i < size + 64; i++) CHECK_EQ(workspace[i], 0xa5);
  CHECK_EQ(nsvcd_sweep(&question, workspace, size - 1, &answer), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_sweep(&question, workspace + 4, size, &answer), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_sweep(&question, NULL, size, &answer), NSVCD_ERROR_WORKSPACE);
  CHECK_LE(size, NSVCD_PROOF_WORKSPACE_BYTES(12, 12, 64));
  CHECK_LE(size, nsvcd_sweep_workspace_size(NULL));  // enough for any question of small bodies
  free(workspace);
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

static void work_that_ends_is_told_and_more_decides(void) {
  const nsvcd_body *drawer = box(0.4f, 0.5f, 0.2f), *side = box(0.02f, 0.6f, 0.2f);
  const nsvcd_pose poses[2] = {at(0.21001f, -1, 0), at(0.21001f, 0, 0)};
  nsvcd_question question = question_about(drawer, poses, 2, side);
  question.work = 1;
  const nsvcd_answer little = answer_to(&question);
  CHECK(little.verdict == NSVCD_UNDECIDED && little.why == NSVCD_WHY_WORK);
  question.work = 0;
  const nsvcd_answer enough = answer_to(&question);
  CHECK(enough.verdict == NSVCD_FREE && enough.work > little.work);
  nsvcd_body_free(drawer, NULL);
  nsvcd_body_free(side, NULL);

  // also where all that is left to tell is whether one is inside of the other
  const nsvcd_body *shelf = body_of(stacked(box_mesh(1, 1, 0.1f), box_mesh(1, 1, 0.1f), 1), NULL);
  const nsvcd_body *books =
      body_of(stacked(box_mesh(0.2f, 0.2f, 0.1f), box_mesh(0.2f, 0.2f, 0.1f), 0.3f), NULL);
  const nsvcd_pose between = at(0, 0, 0.4f);
  question = question_about(books, &between, 1, shelf);
  nsvcd_answer answer;
  for (question.work = 1; question.work < 1000; question.work++) {
    answer = answer_to(&question);
    if (answer.verdict == NSVCD_FREE) break;
    CHECK(answer.verdict == NSVCD_UNDECIDED && answer.why == NSVCD_WHY_WORK);
  }
  CHECK(question.work > 1 && answer.verdict == NSVCD_FREE);
  nsvcd_body_free(shelf, NULL);
  nsvcd_body_free(books, NULL);
}

static int stops_at_zero(void *user) {
  int *calls = (int *)user;
  return --*calls <= 0;
}

// The tip of a sheet scratches another sheet. What is known when it is told to stop is told.
static void a_proof_ends_when_it_is_told(void) {
  const nsvcd_body *sheet = body_of(sheet_mesh(40, 0.02f), NULL);
  const nsvcd_pose poses[2] = {turned(0, 0, 0.05f, 0.8f), turned(0, 0, 0.0005f, -0.8f)};
  nsvcd_question question = question_about(sheet, poses, 2, sheet);
  question.ask = NSVCD_ASK_FIRST;
  question.to = 1e-7f;
  const nsvcd_answer whole = answer_to(&question);
  int calls = 1;
  question.stop = stops_at_zero;
  question.user = &calls;
  const nsvcd_answer part = answer_to(&question);
  CHECK(whole.verdict == NSVCD_HIT && whole.why == NSVCD_WHY_NOTHING && whole.work > 1100);
  CHECK(part.why != NSVCD_WHY_NOTHING && part.work < 1100);
  CHECK(part.time.low <= whole.time.low && part.time.high >= whole.time.high);
  CHECK_EQ(calls, 0);  // and is not asked again
  calls = 1000;
  const nsvcd_answer same = answer_to(&question);
  CHECK_EQ(memcmp(&same, &whole, sizeof same), 0);
  CHECK(calls < 1000);
  nsvcd_body_free(sheet, NULL);
}

// A crate over a coarse table, nearer than its triangles are stored to: between which two it cannot
// be told, when, and how near these come.
static void what_is_too_near_to_tell_is_named(void) {
  const nsvcd_encode_options coarse = {.coarse = 1};
  const nsvcd_body *crate = box(0.2f, 0.2f, 0.2f), *land = body_of(sheet_mesh(6, 0.3f), &coarse);
  const double error = (double)nsvcd_body_describe(land).quantization_error;
  const float z = 0.4f + (float)(0.8 * error);
  const nsvcd_pose poses[2] = {at(-2, 0, z), at(2, 0, z)};
  const nsvcd_question question = question_about(crate, poses, 2, land);
  const nsvcd_answer answer = answer_to(&question);
  CHECK(error > 0);
  CHECK(answer.verdict == NSVCD_UNDECIDED && answer.why == NSVCD_WHY_TOO_NEAR);
  CHECK(answer.nearest.triangle_a < 12 && answer.nearest.triangle_b < 72);
  CHECK(answer.distance.low == 0 && (double)answer.distance.high < 4 * error);
  CHECK_NEAR(answer.nearest.time, 0.5, 0.06);
  nsvcd_body_free(crate, NULL);
  nsvcd_body_free(land, NULL);
}

// With some work more: whether bodies meet is known to whoever asks when, or how near they come.
static void whoever_asks_for_more_knows_no_less(void) {
  const nsvcd_body *gate = box(2, 0.05f, 0.5f), *post = box(0.1f, 0.1f, 2);
  for (int k = 0; k < 12; k++) {
    const float x = -0.72f - 0.07f * (float)k;  // it hits, and at the end passes
    const nsvcd_pose poses[2] = {turned(x, 0, 0, 0.8f), turned(x, 0, 0, -0.8f)};
    nsvcd_question question = question_about(gate, poses, 2, post);
    const nsvcd_answer plain = answer_to(&question);
    CHECK_EQ(plain.verdict, k < 5 ? NSVCD_HIT : NSVCD_FREE);
    question.work = 16 * (plain.work + 1);
    question.to = 1e-5f;
    question.ask = NSVCD_ASK_FIRST;
    CHECK_EQ(verdict_of(&question), plain.verdict);
    question.ask = NSVCD_ASK_DISTANCE;
    CHECK_EQ(verdict_of(&question), plain.verdict);
  }
  nsvcd_body_free(gate, NULL);
  nsvcd_body_free(post, NULL);
}

static void fewer_segments_take_less_memory_and_answer_the_same(void) {
  const nsvcd_body *gate = box(2, 0.05f, 0.5f), *post = box(0.1f, 0.1f, 2);
  const nsvcd_pose poses[2] = {turned(-0.7f, 0, 0, 0.8f), turned(-0.7f, 0, 0, -0.8f)};
  nsvcd_question question = question_about(gate, poses, 2, post);
  const size_t size = nsvcd_sweep_workspace_size(&question);
  question.segments = 16;
  CHECK(nsvcd_sweep_workspace_size(&question) < size);
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  question.clearance = 0.01f;
  question.b.scale = 0.01f;
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  nsvcd_body_free(gate, NULL);
  nsvcd_body_free(post, NULL);
}

// It takes a share of the work to find that a cart ends in a wall, whatever comes before that.
static void a_contact_at_an_end_is_found_at_once(void) {
  enum { POSES = 1000 };
  const nsvcd_body *cart = box(0.4f, 0.4f, 0.4f), *table = box(20, 2, 0.1f);
  static nsvcd_pose poses[POSES];
  for (int i = 0; i < POSES; i++) poses[i] = at(-5 + 0.01f * (float)i, 0, 0.2501f);
  nsvcd_question question = question_about(cart, poses, POSES, table);
  const nsvcd_answer all = answer_to(&question);
  CHECK_EQ(all.verdict, NSVCD_FREE);
  poses[POSES - 1].position[2] = 0.2f;
  const nsvcd_answer end = answer_to(&question);
  CHECK_EQ(end.verdict, NSVCD_HIT);
  CHECK_LE(end.work, all.work / 2);
  nsvcd_body_free(cart, NULL);
  nsvcd_body_free(table, NULL);
}

typedef struct asked_by_a_thread {
  const nsvcd_question *question;
  nsvcd_answer answers[20];
} asked_by_a_thread;
static void *ask_again_and_again(void *user) {
  asked_by_a_thread *mine = (asked_by_a_thread *)user;
  for (int i = 0; i < 20; i++) mine->answers[i] = answer_to(mine->question);
  return NULL;
}
static void threads_may_share_bodies(void) {
  const nsvcd_body *cube = box(1, 1, 1), *wall = box(1, 10, 10);
  const nsvcd_pose poses[2] = {at(-7, 0, 0), turned(3, 0, 0, 1)};
  nsvcd_question question = question_about(cube, poses, 2, wall);
  question.ask = NSVCD_ASK_FIRST;
  static asked_by_a_thread asked[4];
  pthread_t threads[4];
  const nsvcd_answer alone = answer_to(&question);
  for (int i = 0; i < 4; i++) {
    asked[i].question = &question;
    CHECK(!pthread_create(&threads[i], NULL, ask_again_and_again, &asked[i]));
  }
  for (int i = 0; i < 4; i++) {
    CHECK(!pthread_join(threads[i], NULL));
    for (int k = 0; k < 20; k++) {
      CHECK_EQ(asked[i].answers[k].verdict, NSVCD_HIT);
      CHECK(!memcmp(&asked[i].answers[k].time, &alone.time, sizeof alone.time));
    }
  }
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

// One field at fault, and the code is that field's. The answer stays as it was.
static void a_question_is_refused_by_the_field_at_fault(void) {
  const nsvcd_encode_options for_network = {.no_triangles = 1};
  const nsvcd_body *cube = box(1, 1, 1), *wall = box(1, 10, 10);
  const nsvcd_body *latent = body_of(box_mesh(1, 1, 1), &for_network);
  static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(12, 12, 64));
  static const char junk[64] = "no body";
  const nsvcd_pose poses[2] = {at(-7, 0, 0), at(3, 0, 0)};
  const nsvcd_pose wild[2] = {at(-7, 0, 0), at(3, 2e6f, 0)};
  const nsvcd_pose skewed[2] = {at(-7, 0, 0), {{3, 0, 0}, {0, 0, 0, 1.01f}}};
  const float falling[2] = {0.5f, 0.25f}, late[2] = {0, 2};
  nsvcd_answer answer, before;
  memset(&before, 0x5a, sizeof before);
#define REFUSED(code, change)                                                       \
  do {                                                                              \
    nsvcd_question q = question_about(cube, poses, 2, wall);                        \
    change;                                                                         \
    answer = before;                                                                \
    CHECK_EQ(nsvcd_sweep(&q, workspace, sizeof workspace, &answer), code);          \
    CHECK_EQ(nsvcd_sweep_batch(&q, 1, workspace, sizeof workspace, &answer), code); \
    CHECK(!memcmp(&answer, &before, sizeof answer));                                \
    CHECK_EQ(nsvcd_sweep_workspace_size(&q), 0);                                    \
  } while (0)
  REFUSED(NSVCD_ERROR_ARGUMENT, q.a.body = NULL);
  REFUSED(NSVCD_ERROR_ARGUMENT, q.b.body = NULL);
  REFUSED(NSVCD_ERROR_BODY, q.b.body = (const nsvcd_body *)(const void *)junk);
  REFUSED(NSVCD_ERROR_SAME, q.b = q.a);
  REFUSED(NSVCD_ERROR_SAME, (q.b = q.a, q.b.scale = 1));  // which 0 means, too
  REFUSED(NSVCD_ERROR_POSES, q.a.poses = NULL);
  REFUSED(NSVCD_ERROR_POSES, q.a.count = 0);
  REFUSED(NSVCD_ERROR_POSES, q.b.count = 1);
  REFUSED(NSVCD_ERROR_POSES, q.a.count = (size_t)NSVCD_MAX_POSES + 1);
  REFUSED(NSVCD_ERROR_POSE, q.a.poses = wild);
  REFUSED(NSVCD_ERROR_QUATERNION, q.a.poses = skewed);
  REFUSED(NSVCD_ERROR_TIMES, q.a.times = falling);
  REFUSED(NSVCD_ERROR_TIMES, q.a.times = late);
  REFUSED(NSVCD_ERROR_SCALE, q.b.scale = -1);
  REFUSED(NSVCD_ERROR_PIVOT, q.a.pivot[2] = NAN);
  REFUSED(NSVCD_ERROR_PIVOT, (q.b.pivot[0] = 1e4f, q.b.scale = 1000));
  REFUSED(NSVCD_ERROR_ASK, q.ask = (nsvcd_ask)3);
  REFUSED(NSVCD_ERROR_ASK, q.ask = (nsvcd_ask)-1);
  REFUSED(NSVCD_ERROR_METHOD, q.method = (nsvcd_method)3);
  REFUSED(NSVCD_ERROR_METHOD, q.method = (nsvcd_method)-1);
  REFUSED(NSVCD_ERROR_TO, q.to = 1);  // of HIT
  REFUSED(NSVCD_ERROR_TO, (q.ask = NSVCD_ASK_DISTANCE, q.to = -1));
  REFUSED(NSVCD_ERROR_TO_TIME, q.to_time = 0.5f);
  REFUSED(NSVCD_ERROR_TO_TIME, (q.ask = NSVCD_ASK_DISTANCE, q.to_time = 0.5f));
  REFUSED(NSVCD_ERROR_TO_TIME, (q.ask = NSVCD_ASK_FIRST, q.to_time = 1.01f));
  REFUSED(NSVCD_ERROR_CLEARANCE, q.clearance = -1);
  REFUSED(NSVCD_ERROR_SLOP, q.slop = HUGE_VALF);
  REFUSED(NSVCD_ERROR_TOLERANCE, q.tolerance = -1);
  REFUSED(NSVCD_ERROR_MANIFOLD, q.manifold = 1);  // of HIT
  REFUSED(NSVCD_ERROR_SEGMENTS, q.segments = 17);
  REFUSED(NSVCD_ERROR_SEGMENTS, q.segments = 80);
  REFUSED(NSVCD_ERROR_TRIANGLES, (q.a.body = latent, q.method = NSVCD_METHOD_PROOF));
  REFUSED(NSVCD_ERROR_TRIANGLES, (q.b.body = latent, q.method = NSVCD_METHOD_PROOF));
  // of the network, which knows no first contact, no slop, and no distance to a millimetre
  REFUSED(NSVCD_ERROR_LATENTS, q.method = NSVCD_METHOD_NETWORK);
  REFUSED(NSVCD_ERROR_METHOD, (q.method = NSVCD_METHOD_NETWORK, q.ask = NSVCD_ASK_FIRST));
  REFUSED(NSVCD_ERROR_METHOD, (q.method = NSVCD_METHOD_NETWORK, q.slop = 0.1f));
  REFUSED(NSVCD_ERROR_METHOD,
          (q.method = NSVCD_METHOD_NETWORK, q.ask = NSVCD_ASK_DISTANCE, q.to = 1e-3f));
  REFUSED(NSVCD_ERROR_PAIRS, q.network.pairs = NSVCD_MAX_PAIRS + 1);
  REFUSED(NSVCD_ERROR_PAIRS, q.network.pairs = (size_t)-1);
  REFUSED(NSVCD_ERROR_MODEL, q.network.model = (nsvcd_model)(NSVCD_MODEL_BASE + 1));
  REFUSED(NSVCD_ERROR_PRECISION, q.network.precision = (nsvcd_precision)(NSVCD_PRECISION_INT8 + 1));
  REFUSED(NSVCD_ERROR_RECALL, q.network.recall = 0.5f);
  REFUSED(NSVCD_ERROR_INFLATE, q.network.inflate = -1);
#undef REFUSED
  const nsvcd_question good = question_about(cube, poses, 2, wall);
  CHECK_EQ(nsvcd_sweep(NULL, workspace, sizeof workspace, &answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_sweep(&good, workspace, sizeof workspace, NULL), NSVCD_ERROR_ARGUMENT);
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
  nsvcd_body_free(latent, NULL);
}

static void this_build_computes_rightly(void) {
  CHECK_EQ(nsvcd_self_test(), NSVCD_OK);
}

// ---- the network

// Far apart the network certifies as well; near, it has an opinion; through a wall, a sure one.
static void the_network_has_opinions_and_says_so(void) {
  const nsvcd_encode_options options = {.latents = 1};
  const nsvcd_body *cube = body_of(box_mesh(1, 1, 1), &options);
  const nsvcd_body *wall = body_of(box_mesh(1, 3, 3), &options);
  const nsvcd_pose far_off[2] = {at(-7, 8, 0), at(7, 8, 0)},
                   through[2] = {at(-4, 0, 0), at(4, 0, 0)};
  nsvcd_question question = question_about(cube, far_off, 2, wall);
  question.method = NSVCD_METHOD_NETWORK;
  nsvcd_answer answer = answer_to(&question);
  CHECK(answer.verdict == NSVCD_FREE && answer.by == NSVCD_BY_PROOF);
  CHECK(answer.opinion.logit == -NSVCD_LOGIT_CERTAIN && answer.opinion.candidates == 0);
  question.a.poses = through;
  for (int model = NSVCD_MODEL_TINY; model <= NSVCD_MODEL_BASE; model++) {
    question.network.model = (nsvcd_model)model;
    answer = answer_to(&question);
    CHECK(answer.verdict == NSVCD_HIT && answer.by == NSVCD_BY_NETWORK && answer.opinion.asked);
    CHECK(answer.opinion.logit > 0);
  }
  question.ask = NSVCD_ASK_FIRST;  // which it does not know
  CHECK_EQ(nsvcd_sweep_workspace_size(&question), 0);
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

static void the_network_does_not_mind_where_things_are_nor_how_large(void) {
  const nsvcd_encode_options options = {.latents = 1};
  const nsvcd_body *cube = body_of(box_mesh(1, 0.8f, 0.6f), &options);
  const nsvcd_body *wall = body_of(box_mesh(1, 3, 3), &options);
  const nsvcd_pose poses[2] = {at(1.3f, -3, 0), at(1.3f, 2, 0.5f)};
  const nsvcd_pose shifted[2] = {at(6.3f, -1, 3), at(6.3f, 4, 3.5f)}, other = at(5, 2, 3);
  const nsvcd_pose doubled[2] = {at(2.6f, -6, 0), at(2.6f, 4, 1)};
  nsvcd_question question = question_about(cube, poses, 2, wall);
  question.method = NSVCD_METHOD_NETWORK;
  question.ask = NSVCD_ASK_DISTANCE;
  const nsvcd_opinion here = answer_to(&question).opinion;
  question.a.poses = shifted;
  question.b.poses = &other;
  question.b.count = 1;
  CHECK_NEAR(answer_to(&question).opinion.distance, here.distance, 1e-3);
  question = question_about(cube, doubled, 2, wall);
  question.method = NSVCD_METHOD_NETWORK;
  question.ask = NSVCD_ASK_DISTANCE;
  question.a.scale = question.b.scale = 2;
  CHECK_NEAR(answer_to(&question).opinion.distance, 2 * here.distance, 2e-3);
  CHECK(here.candidates > 0 && here.distance > 0 && here.distance < 1);
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

static void int8_follows_float(void) {
  const nsvcd_encode_options options = {.latents = 1};
  const nsvcd_body *cube = body_of(box_mesh(1, 1, 1), &options);
  const nsvcd_body *wall = body_of(box_mesh(1, 3, 3), &options);
  for (int k = 0; k < 10; k++) {
    const float x = 0.9f + 0.02f * (float)k;
    const nsvcd_pose poses[2] = {at(x, -1, 0), at(x, 1, 0)};
    nsvcd_question question = question_about(cube, poses, 2, wall);
    question.method = NSVCD_METHOD_NETWORK;
    question.ask = NSVCD_ASK_DISTANCE;
    const nsvcd_opinion by_float = answer_to(&question).opinion;
    question.network.precision = NSVCD_PRECISION_INT8;
    const nsvcd_opinion by_int8 = answer_to(&question).opinion;
    CHECK_NEAR(by_int8.distance, by_float.distance, 0.02);
  }
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

// Whichever way its triangles wind; but of what is said to be open there is no inside.
static void the_network_knows_what_is_inside(void) {
  const nsvcd_encode_options options = {.latents = 1}, open = {.latents = 1, .open = 1};
  nsvcd_mesh turned = box_mesh(2, 2, 2);
  for (size_t i = 0; i < 3 * turned.triangle_count; i += 3) {
    const uint32_t first = turned.indices[i];
    turned.indices[i] = turned.indices[i + 1];
    turned.indices[i + 1] = first;
  }
  const nsvcd_body *ball = body_of(box_mesh(0.1f, 0.1f, 0.1f), &options);
  const nsvcd_body *crates[3] = {body_of(box_mesh(2, 2, 2), &options), body_of(turned, &options),
                                 body_of(box_mesh(2, 2, 2), &open)};
  const nsvcd_pose within[2] = {at(0.05f, 0, 0), at(0, 0.1f, 0)};
  const nsvcd_pose beside[2] = {at(3, 0, 0), at(3, 0.1f, 0)};
  for (size_t k = 0; k < 6; k++) {
    const nsvcd_body *crate = crates[k / 2];
    nsvcd_question question = question_about(ball, within, 1 + k % 2, crate);
    question.method = NSVCD_METHOD_NETWORK;
    const nsvcd_answer answer = answer_to(&question);
    CHECK_EQ(answer.verdict, k < 4 ? NSVCD_HIT : NSVCD_FREE);
    CHECK(answer.inside == (k < 4) && (k > 3 || answer.time.high == 0));
    CHECK_EQ(answer.opinion.logit, k < 4 ? NSVCD_LOGIT_CERTAIN : -NSVCD_LOGIT_CERTAIN);
    question.a.body = crate;  // and the other way round
    question.b.body = ball;
    CHECK_EQ(answer_to(&question).inside, k < 4);
    question.a.poses = beside;
    CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  }
  nsvcd_body_free(ball, NULL);
  for (int k = 0; k < 3; k++) nsvcd_body_free(crates[k], NULL);
}

// More recall finds more, and never lowers the logit.
static void more_recall_never_lowers_the_logit(void) {
  const nsvcd_encode_options options = {.latents = 1};
  const nsvcd_body *cube = body_of(box_mesh(1, 1, 1), &options);
  const nsvcd_body *wall = body_of(box_mesh(1, 3, 3), &options);
  static const float recalls[4] = {0, 0.99f, 0.999f, 0.9999f};
  for (int k = 0; k < 5; k++) {
    const float x = 0.99f + 0.005f * (float)k;
    const nsvcd_pose poses[2] = {at(x, -1, 0), at(x, 1, 0)};
    nsvcd_question question = question_about(cube, poses, 2, wall);
    question.method = NSVCD_METHOD_NETWORK;
    question.network.pairs = NSVCD_MAX_PAIRS;
    float logit = -HUGE_VALF;
    for (int n = 0; n < 4; n++) {
      question.network.recall = recalls[n];
      const nsvcd_opinion opinion = answer_to(&question).opinion;
      CHECK_GE(fmin((double)opinion.logit, 3), fmin((double)logit, 3));  // a search ends above 3
      logit = opinion.logit;
    }
  }
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

// A step along the gradient of the distance leads out.
static void the_gradient_of_a_distance_leads_out(void) {
  const nsvcd_encode_options options = {.latents = 1};
  const nsvcd_body *cube = body_of(box_mesh(1, 1, 1), &options);
  const nsvcd_body *wall = body_of(box_mesh(1, 3, 3), &options);
  nsvcd_pose pose = at(0.95f, 0.2f, 0.1f);  // 5 cm deep
  nsvcd_question question = question_about(cube, &pose, 1, wall);
  question.method = NSVCD_METHOD_NETWORK;
  question.ask = NSVCD_ASK_DISTANCE;
  const size_t size = nsvcd_sweep_workspace_size(&question);
  void *workspace = malloc(size);
  nsvcd_answer before, after;
  float by_a[6], by_b[6];
  CHECK_EQ(nsvcd_sweep_gradient(&question, workspace, size, &before, by_a, by_b), NSVCD_OK);
  for (int k = 0; k < 3; k++) CHECK_NEAR(by_a[k], -by_b[k], 1e-3);
  for (int k = 0; k < 3; k++) pose.position[k] += 0.02f * by_a[k];
  CHECK_EQ(nsvcd_sweep_gradient(&question, workspace, size, &after, by_a, NULL), NSVCD_OK);
  CHECK(after.opinion.distance > before.opinion.distance);
  question.method = NSVCD_METHOD_PROOF;
  CHECK_EQ(nsvcd_sweep_gradient(&question, workspace, size, &after, by_a, by_b),
           NSVCD_ERROR_METHOD);
  free(workspace);
  nsvcd_body_free(cube, NULL);
  nsvcd_body_free(wall, NULL);
}

void promises_queries(void) {
  RUN(a_cart_that_drives_past_is_free_and_into_a_post_is_a_hit);
  RUN(what_happens_between_two_poses_is_seen);
  RUN(between_poses_a_motion_is_a_line_and_a_slerp);
  RUN(a_body_turns_about_its_pivot);
  RUN(a_screw_turns_about_its_axis);
  RUN(one_low_pose_of_a_thousand_is_found);
  RUN(a_close_fit_is_told_from_a_hit);
  RUN(a_floor_of_two_kilometres_is_told_to_a_hair);
  RUN(a_body_of_any_number_of_patches_is_right);
  RUN(the_unit_of_length_does_not_matter);
  RUN(triangles_listed_twice_change_nothing);
  RUN(it_does_not_matter_which_body_is_a);
  RUN(both_bodies_may_move);
  RUN(what_is_inside_is_a_hit_but_of_what_is_open);
  RUN(inside_of_what_is_nearly_a_solid_is_undecided);
  RUN(the_first_contact_is_the_first);
  RUN(at_the_safe_place_they_are_apart);
  RUN(a_manifold_holds_a_crate_at_four_corners);
  RUN(what_a_crate_stands_on_and_leans_on_is_told);
  RUN(a_clearance_is_kept);
  RUN(a_distance_is_bracketed_as_narrowly_as_is_said);
  RUN(with_a_skin_what_rests_may_slide);
  RUN(under_a_ceiling_a_skin_is_as_thick_as_there_is_room);
  RUN(what_was_stopped_goes_on);
  RUN(a_lift_by_the_depth_ends_a_contact);
  RUN(the_same_question_has_the_same_answer);
  RUN(a_batch_is_refused_as_a_whole);
  RUN(the_workspace_that_is_asked_for_suffices);
  RUN(work_that_ends_is_told_and_more_decides);
  RUN(a_proof_ends_when_it_is_told);
  RUN(what_is_too_near_to_tell_is_named);
  RUN(whoever_asks_for_more_knows_no_less);
  RUN(fewer_segments_take_less_memory_and_answer_the_same);
  RUN(a_contact_at_an_end_is_found_at_once);
  RUN(threads_may_share_bodies);
  RUN(a_question_is_refused_by_the_field_at_fault);
  RUN(this_build_computes_rightly);
  RUN(the_network_has_opinions_and_says_so);
  RUN(the_network_does_not_mind_where_things_are_nor_how_large);
  RUN(int8_follows_float);
  RUN(the_network_knows_what_is_inside);
  RUN(more_recall_never_lowers_the_logit);
  RUN(the_gradient_of_a_distance_leads_out);
}

CHECK_ALONE(promises_queries)
