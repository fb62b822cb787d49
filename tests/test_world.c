// One body against all others: is the tree's list complete, and the answer that of single questions?
// Against boxes and distances in double.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "../extras/neuralsvcd_world.h"

#include "world_scene.h"

void test_world(void);

// ---- the tree, against boxes of its own

enum { MANY = 120, SHAPES = 3 };
static const double lengths[SHAPES][3] = {{0.4, 0.3, 0.2}, {1.5, 0.1, 0.1}, {0.05, 0.05, 0.05}};

// A body of the test's own list, and its box: what it surely reaches, and at most.
typedef struct entry {
  nsvcd_world_body given;
  nsvcd_pose to;
  int shape, lives, is_driven;
  double least[2][3], most[2][3];
} entry;

static void widen(double box[2][3], const double *point) {
  for (int k = 0; k < 3; k++) {
    box[0][k] = fmin(box[0][k], point[k]);
    box[1][k] = fmax(box[1][k], point[k]);
  }
}
// Of a driven body by its corners at many times: those in between are farther out by the sagitta at most.
static void entry_boxes(entry *e) {
  enum { STEPS = 32 };
  const double scale = e->given.scale > 0 ? (double)e->given.scale : 1;
  const oracle_pose from = seen(&e->given.pose);
  const oracle_pose to = e->is_driven ? seen(&e->to) : from;
  double pivot[3], ends[2][3], reach = 0;
  for (int k = 0; k < 3; k++) {
    pivot[k] = scale * (double)e->given.pivot[k];
    reach += fabs(pivot[k]) + scale * lengths[e->shape][k];
    e->least[0][k] = HUGE_VAL;
    e->least[1][k] = -HUGE_VAL;
  }
  oracle_transform(&from, pivot, ends[0]);
  oracle_transform(&to, pivot, ends[1]);
  for (int n = 0; n <= STEPS; n++) {
    const double f = (double)n / STEPS;
    oracle_pose at = oracle_pose_between(&from, &to, f);
    for (int corner = 0; corner < 8; corner++) {
      double own[3], there[3];
      for (int k = 0; k < 3; k++)
        own[k] = scale * lengths[e->shape][k] * (corner >> k & 1 ? 0.5 : -0.5) - pivot[k];
      memset(at.position, 0, sizeof at.position);
      oracle_transform(&at, own, there);
      for (int k = 0; k < 3; k++) there[k] += ends[0][k] + f * (ends[1][k] - ends[0][k]);
      widen(e->least, there);
    }
  }
  double axis[3];
  const double turn = oracle_quat_arc(from.rotation, to.rotation, axis);
  for (int k = 0; k < 3; k++) {
    e->most[0][k] = e->least[0][k] - 0.3 * turn * turn * reach - 1e-4;
    e->most[1][k] = e->least[1][k] + 0.3 * turn * turn * reach + 1e-4;
  }
}
static int boxes_within(double a[2][3], double b[2][3], double distance) {
  int out = 1;
  for (int k = 0; k < 3; k++)
    out = out && a[0][k] <= b[1][k] + distance && b[0][k] <= a[1][k] + distance;
  return out;
}
static int entries_meet(const nsvcd_world_body *a, const nsvcd_world_body *b) {
  const uint32_t of_a = a->groups ? a->groups : 1;
  const uint32_t of_b = b->groups ? b->groups : 1;
  return !(of_a & b->passes) && !(of_b & a->passes);
}

static void pairs_are_all(const nsvcd_world *world, entry *all, double distance) {
  static nsvcd_body_pair pairs[MANY * MANY];
  static unsigned char listed[MANY + 1][MANY + 1];
  size_t count = 0;
  CHECK_EQ(nsvcd_world_pairs(world, (float)distance, pairs, MANY * MANY, &count), NSVCD_OK);
  CHECK_LE(count, MANY * MANY);
  memset(listed, 0, sizeof listed);
  for (size_t n = 0; n < count; n++) {
    const size_t a = pairs[n].a;
    const size_t b = pairs[n].b;
    CHECK(a > 0 && a < b && b <= MANY);
    CHECK_EQ(listed[a][b], 0);
    listed[a][b] = 1;
    CHECK(all[a].lives && all[b].lives);
    CHECK(entries_meet(&all[a].given, &all[b].given));
    CHECK(!all[a].given.fixed || !all[b].given.fixed);
    CHECK(boxes_within(all[a].most, all[b].most, distance));
  }
  for (size_t a = 1; a <= MANY; a++) {
    for (size_t b = a + 1; b <= MANY; b++) {
      if (!all[a].lives || !all[b].lives || (all[a].given.fixed && all[b].given.fixed)) continue;
      if (!entries_meet(&all[a].given, &all[b].given)) continue;
      if (boxes_within(all[a].least, all[b].least, distance)) CHECK_EQ(listed[a][b], 1);
    }
  }
}

static nsvcd_pose random_pose(double far_off) {
  nsvcd_pose out;
  for (int k = 0; k < 3; k++) out.position[k] = (float)uniform(-far_off, far_off);
  random_quat(out.rotation);
  return out;
}

static void pairs_are_those_of_all_boxes(void) {
  static entry all[MANY + 1];
  const nsvcd_body *bodies[SHAPES];
  const size_t size = nsvcd_world_size(MANY);
  void *memory = malloc(size);
  nsvcd_world *world = NULL;
  size_t lives = 0;
  rng_state = 5;
  memset(all, 0, sizeof all);
  memset(memory, 0x5a, size);
  for (int k = 0; k < SHAPES; k++) {
    thing t = thing_box(lengths[k][0], lengths[k][1], lengths[k][2]);
    oracle_mesh_free(&t.mesh);
    bodies[k] = t.body;
  }
  CHECK_EQ(nsvcd_world_begin(memory, size, MANY, &world), NSVCD_OK);
  const size_t trials = check_many(6000);
  for (size_t trial = 0; trial < trials; trial++) {
    size_t id = pick(1, MANY);
    const size_t what = pick(0, 9);
    entry *e = &all[id];
    if (what < (trial / 1000 % 2 ? 2 : 4)) {
      nsvcd_world_body given;
      memset(&given, 0, sizeof given);
      const int shape = (int)pick(0, SHAPES - 1);
      given.body = bodies[shape];
      given.pose = random_pose(trial % 7 ? 2 : 0.1);
      given.scale = trial % 3 ? 0 : (float)uniform(0.3, 3);
      for (int k = 0; k < 3 && trial % 2; k++) given.pivot[k] = (float)uniform(-1, 1);
      given.fixed = trial % 5 == 0;
      given.groups = trial % 11 ? 0 : 6;
      given.passes = trial % 13 ? 0 : 2;
      id = 77;
      const nsvcd_result result = nsvcd_world_add(world, &given, &id);
      CHECK_EQ(result, lives < MANY ? NSVCD_OK : NSVCD_ERROR_COUNT);
      if (result) CHECK_EQ(id, 77);
      if (result) continue;
      CHECK(id > 0 && id <= MANY && !all[id].lives);
      e = &all[id];
      e->given = given;
      e->shape = shape;
      e->lives = 1;
      e->is_driven = 0;
      lives++;
    } else if (what < 6) {
      CHECK_EQ(nsvcd_world_remove(world, id), e->lives ? NSVCD_OK : NSVCD_ERROR_INDEX);
      lives -= e->lives != 0;
      e->lives = 0;
    } else if (what < 9) {
      const nsvcd_pose pose = random_pose(2);
      e->is_driven = what == 8;
      const nsvcd_result result =
          e->is_driven ? nsvcd_world_drive(world, id, &pose) : nsvcd_world_move(world, id, &pose);
      CHECK_EQ(result, e->lives ? NSVCD_OK : NSVCD_ERROR_INDEX);
      *(e->is_driven ? &e->to : &e->given.pose) = pose;
    } else if (trial % 20 == 0) {
      CHECK_EQ(nsvcd_world_arrive(world), NSVCD_OK);
      for (id = 1; id <= MANY; id++) {
        if (all[id].is_driven) all[id].given.pose = all[id].to;
        all[id].is_driven = 0;
        entry_boxes(&all[id]);
      }
      id = 1;
      e = &all[1];
    }
    entry_boxes(e);
    if (trial % 50 == 0) pairs_are_all(world, all, trial % 100 ? 0 : 0.2);
  }
  CHECK_GE(lives, 10);
  for (size_t id = 1; id <= MANY; id++) {
    nsvcd_world_body got;
    const nsvcd_result result = nsvcd_world_get(world, id, &got);
    CHECK_EQ(result, all[id].lives ? NSVCD_OK : NSVCD_ERROR_INDEX);
    if (result) continue;
    CHECK(!memcmp(&got.pose, &all[id].given.pose, sizeof got.pose));
    CHECK_EQ(got.groups, all[id].given.groups ? all[id].given.groups : 1);
  }
  for (int k = 0; k < SHAPES; k++) nsvcd_body_free(bodies[k], NULL);
  free(memory);
}

// How deep the tree is below a node; it has no cycles if this ends.
static int tree_depth(const nsvcd__box_tree *tree, uint32_t n, uint32_t parent, int deep) {
  CHECK_EQ(tree->nodes[n].parent, parent);
  CHECK_LE(deep, 2000);
  if (!tree->nodes[n].child[0] || deep > 2000) return 1;
  const int a = tree_depth(tree, tree->nodes[n].child[0], n, deep + 1);
  const int b = tree_depth(tree, tree->nodes[n].child[1], n, deep + 1);
  return 1 + (a > b ? a : b);
}

// In order along a line, all at one place, and in order outwards, the tree stays shallow.
static void bodies_in_bad_orders(void) {
  enum { ROW = 1000 };
  thing t = thing_box(0.4, 0.4, 0.4);
  const size_t size = nsvcd_world_size(ROW);
  void *memory = malloc(size);
  for (int how = 0; how < 3; how++) {
    nsvcd_world *world = NULL;
    size_t count = 0;
    CHECK_EQ(nsvcd_world_begin(memory, size, ROW, &world), NSVCD_OK);
    CHECK_EQ(nsvcd_world_pairs(world, 1, NULL, 0, &count), NSVCD_OK);
    CHECK_EQ(count, 0);
    for (int n = 0; n < ROW; n++) {
      nsvcd_world_body body;
      size_t id = 0;
      memset(&body, 0, sizeof body);
      body.body = t.body;
      const double x = how == 0 ? n : how == 1 ? 0 : n % 2 ? -n : n;
      body.pose = pose_of(x, 0, 0);
      CHECK_EQ(nsvcd_world_add(world, &body, &id), NSVCD_OK);
      CHECK_EQ(id, n + 1);
      if (n > 0) continue;
      CHECK_EQ(nsvcd_world_pairs(world, 1, NULL, 0, &count), NSVCD_OK);
      CHECK_EQ(count, 0);
    }
    CHECK_EQ(nsvcd_world_pairs(world, 0.7f, NULL, 0, &count), NSVCD_OK);
    CHECK_EQ(count, how == 0 ? ROW - 1 : how == 1 ? ROW * (ROW - 1) / 2 : 1);
    CHECK_LE(tree_depth(&world->tree, world->tree.root, 0, 0), how == 1 ? ROW : 40);
    for (size_t id = 1; id < ROW; id++) CHECK_EQ(nsvcd_world_remove(world, id), NSVCD_OK);
    CHECK_EQ(world->tree.root, ROW);
    CHECK_EQ(nsvcd_world_remove(world, ROW), NSVCD_OK);
    CHECK_EQ(world->tree.root, 0);
  }
  free(memory);
  thing_free(&t);
}

// ---- questions, against single ones

static nsvcd_world_question question_of(size_t self, const nsvcd_pose *poses, size_t count,
                                        nsvcd_ask ask) {
  nsvcd_world_question out;
  memset(&out, 0, sizeof out);
  out.self = self;
  out.question.a.poses = poses;
  out.question.a.count = count;
  out.question.ask = ask;
  return out;
}
static nsvcd_world_answer ask(const stage *s, const nsvcd_world_question *q) {
  nsvcd_world_answer out;
  size_t size;
  void *memory = workspace(&size);
  memset(&out, 0x5a, sizeof out);
  CHECK_EQ(nsvcd_world_sweep(s->world, q, memory, size, &out), NSVCD_OK);
  return out;
}

// What single questions say of all bodies.
typedef struct combined {
  int hits, undecided;
  double low, high, safe;
  size_t met[STAGE_MOST], met_count;
  unsigned char first[STAGE_MOST + 1];  // is it hit, or undecided, at the earliest time?
} combined;

static combined ask_singly(const stage *s, const nsvcd_world_question *q, const nsvcd_pose *driven,
                           size_t driven_id) {
  combined out;
  double times[STAGE_MOST + 1];
  int verdicts[STAGE_MOST + 1];
  size_t size;
  void *memory = workspace(&size);
  memset(&out, 0, sizeof out);
  out.low = out.safe = 1;
  out.high = HUGE_VAL;
  for (size_t id = 1; id <= s->count; id++) {
    nsvcd_world_body other;
    nsvcd_answer a;
    nsvcd_question one = q->question;
    verdicts[id] = NSVCD_FREE;
    if (id == q->self || !s->things[id].body) continue;
    CHECK_EQ(nsvcd_world_get(s->world, id, &other), NSVCD_OK);
    nsvcd_pose way[2] = {other.pose, driven ? *driven : other.pose};
    one.a.body = q->self ? s->things[q->self].body : q->question.a.body;
    one.b.body = other.body;
    one.b.poses = way;
    one.b.count = id == driven_id ? 2 : 1;
    CHECK_EQ(nsvcd_sweep(&one, memory, size, &a), NSVCD_OK);
    verdicts[id] = (int)a.verdict;
    if (a.verdict == NSVCD_FREE) continue;
    out.met[out.met_count++] = id;
    out.hits += a.verdict == NSVCD_HIT;
    out.undecided += a.verdict != NSVCD_HIT;
    out.low = fmin(out.low, (double)a.time.low);
    if (a.verdict == NSVCD_HIT) out.high = fmin(out.high, (double)a.time.high);
    out.safe = fmin(out.safe, (double)a.safe.time);
    times[id] = (double)(a.verdict == NSVCD_HIT ? a.time.high : a.time.low);
  }
  if (out.met_count == 0) out.high = 1;
  for (size_t id = 1; id <= s->count; id++) {
    if (verdicts[id] == NSVCD_FREE) continue;
    if (out.hits && verdicts[id] == NSVCD_HIT) out.first[id] = times[id] <= out.high;
    if (!out.hits) out.first[id] = times[id] <= out.low;
  }
  return out;
}

// Is the way up to the safe pose, and that itself, as far from all as the clearance?
static void safe_is_safe(const stage *s, const nsvcd_world_question *q, const nsvcd_world_answer *a,
                         const nsvcd_pose *driven, size_t driven_id) {
  enum { STEPS = 12 };
  oracle_pose way[8], other[2];
  const size_t count = q->question.a.count;
  const thing *t = &s->things[q->self];
  for (size_t k = 0; k < count; k++) way[k] = seen(&q->question.a.poses[k]);
  for (size_t id = 1; id <= s->count; id++) {
    if (id == q->self || !s->things[id].body) continue;
    const nsvcd_pose there = stage_pose(s, id);
    other[0] = seen(&there);
    if (id == driven_id) other[1] = seen(driven);
    const size_t ends = id == driven_id ? 2 : 1;
    for (int n = 0; n <= STEPS && a->safe_time > 0; n++) {
      const double time = (double)a->safe_time * n / STEPS;
      const oracle_pose mine = n < STEPS ? oracle_pose_at(way, count, time) : seen(&a->safe);
      const oracle_pose its = oracle_pose_at(other, ends, time);
      const double d = apart(t, &mine, &s->things[id], &its);
      CHECK_GE(d, (double)q->question.clearance - 1e-6);
    }
  }
}

static void contacts_are_true(const stage *s, const nsvcd_world_question *q,
                              const nsvcd_world_answer *a) {
  const double to = q->question.to > 0 ? (double)q->question.to : 0.001;
  int has_first = 0;
  size_t last = 0;
  CHECK_LE(a->contact_count, NSVCD_WORLD_CONTACTS);
  for (size_t k = 0; k < a->contact_count; k++) {
    const nsvcd_world_contact *c = &a->contacts[k];
    CHECK(c->body > 0 && c->body <= s->count && c->body != q->self);
    has_first |= c->body == a->body;
    CHECK_LE(c->contact.gap, (double)q->question.clearance + 2 * to + 1e-6);
    if (!q->question.manifold) CHECK(k == 0 || c->body != last);
    last = c->body;
  }
  CHECK(has_first);
}

static void answers_are_of_all_bodies(void) {
  enum { BODIES = 20 };
  size_t hits = 0, frees = 0, contacts = 0;
  rng_state = 11;
  stage s = stage_begin();
  for (int k = 0; k < BODIES; k++) {
    const size_t kind = pick(0, SHAPES - 1);
    thing t = thing_box(lengths[kind][0], lengths[kind][1], lengths[kind][2]);
    stage_add(&s, t, random_pose(1.2), k % 2);
  }
  const size_t trials = check_many(240);
  for (size_t trial = 0; trial < trials; trial++) {
    nsvcd_pose way[4];
    const size_t self = pick(1, BODIES);
    const size_t count = pick(1, 4);
    for (size_t k = 0; k < count; k++) way[k] = random_pose(1);
    for (size_t k = 1; k < count && trial % 3; k++) memcpy(way[k].rotation, way[0].rotation, 16);
    nsvcd_world_question q =
        question_of(self, way, count, trial % 2 ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT);
    q.question.clearance = trial % 4 < 2 ? 0 : 0.02f;
    q.question.manifold = trial % 4 == 1;
    nsvcd_pose to = random_pose(1.2);
    size_t driven = trial % 5 ? 0 : self % BODIES + 1;
    if (driven) CHECK_EQ(nsvcd_world_drive(s.world, driven, &to), NSVCD_OK);
    const nsvcd_world_answer a = ask(&s, &q);
    const nsvcd_world_answer again = ask(&s, &q);
    const combined c = ask_singly(&s, &q, &to, driven);
    CHECK(!memcmp(&a, &again, sizeof a));
    CHECK_EQ(a.verdict, c.hits ? NSVCD_HIT : c.undecided ? NSVCD_UNDECIDED : NSVCD_FREE);
    CHECK_GE(a.questions, c.hits || c.undecided ? 1 : 0);
    if (a.verdict == NSVCD_FREE) {
      frees++;
      CHECK_EQ(a.body, NSVCD_NOBODY);
      CHECK(a.time.low >= 1 && a.time.high >= 1 && a.safe_time >= 1);
      CHECK(!memcmp(&a.safe, &way[count - 1], sizeof a.safe));
    } else if (q.question.ask == NSVCD_ASK_FIRST) {
      hits++;
      CHECK_EQ(a.time.low, c.low);
      if (c.hits) CHECK_EQ(a.time.high, c.high);
      CHECK(c.first[a.body]);
      CHECK_LE(a.safe_time, c.safe);
      CHECK_GE(a.safe_time, c.safe - 1e-3);
      contacts += a.contact_count;
      if (a.safe_time > 0 && c.hits) contacts_are_true(&s, &q, &a);
    } else {
      int is_met = 0;
      for (size_t k = 0; k < c.met_count; k++) is_met |= c.met[k] == a.body;
      CHECK(is_met);
    }
    if (q.question.ask == NSVCD_ASK_FIRST) safe_is_safe(&s, &q, &a, &to, driven);
    if (q.question.ask == NSVCD_ASK_HIT) {
      size_t ids[STAGE_MOST], listed = 99, size;
      void *memory = workspace(&size);
      const size_t most = trial % 8 ? STAGE_MOST : 2;
      memset(ids, 0, sizeof ids);
      CHECK_EQ(nsvcd_world_list(s.world, &q, memory, size, ids, most, &listed), NSVCD_OK);
      CHECK_EQ(listed, c.met_count);
      for (size_t k = 0; k < listed && k < most; k++) CHECK_EQ(ids[k], c.met[k]);
      if (most == 2) CHECK_EQ(ids[2], 0);
    }
    const nsvcd_pose was = stage_pose(&s, driven ? driven : 1);
    if (driven) CHECK_EQ(nsvcd_world_move(s.world, driven, &was), NSVCD_OK);
  }
  CHECK_GE(hits, trials / 10);
  CHECK_GE(frees, trials / 20);
  CHECK_GE(contacts, hits / 2);
  stage_end(&s);
}

// ---- a slop

// A box in a corner of a floor and two walls, in each of them by 0.3 mm: one push-out of all.
static void one_push_out_of_a_corner(void) {
  for (int far_off = 0; far_off < 2; far_off++) {
    const double x = far_off ? 1000 : 0;
    stage s = stage_begin();
    stage_add(&s, thing_box(4, 4, 1), pose_of(x, x, -0.5), 1);
    stage_add(&s, thing_box(1, 4, 4), pose_of(x + 1, x, 2), 1);
    stage_add(&s, thing_box(4, 1, 4), pose_of(x, x + 1, 2), 1);
    const double in = far_off ? 0.25 + 0.00031 : 0.25 + 0.0003;
    const nsvcd_pose pose = pose_of(x + in, x + in, 0.25 - 0.0003);
    const size_t id = stage_add(&s, thing_box(0.5, 0.5, 0.5), pose, 0);
    const nsvcd_pose way[2] = {pose, pose_of(x + in - 0.3, x + in, 0.25 - 0.0003)};
    nsvcd_world_question q = question_of(id, way, 2, NSVCD_ASK_FIRST);
    CHECK(stage_apart(&s, id) < 0);
    CHECK_EQ(ask(&s, &q).verdict, NSVCD_HIT);
    q.question.slop = 0.001f;
    const nsvcd_world_answer a = ask(&s, &q);
    CHECK_EQ(a.verdict, NSVCD_FREE);
    CHECK_GE(a.depth, 0.0003 * sqrt(3));
    CHECK_LE(a.depth, 0.0006 * sqrt(3));
    CHECK(a.push_out[0] < 0 && a.push_out[1] < 0 && a.push_out[2] > 0);
    CHECK(stage_apart_at(&s, id, &a.safe) > 0);
    nsvcd_pose start = pose;
    for (int k = 0; k < 3; k++) start.position[k] += a.push_out[k];
    CHECK(stage_apart_at(&s, id, &start) > 0);
    stage_end(&s);
  }
}
// Between two walls that are too close there is none.
static void no_push_out_between_walls(void) {
  stage s = stage_begin();
  stage_add(&s, thing_box(1, 4, 4), pose_of(-0.7497, 0, 0), 1);
  stage_add(&s, thing_box(1, 4, 4), pose_of(0.7497, 0, 0), 1);
  const nsvcd_pose pose = pose_of(0, 0, 0);
  const size_t id = stage_add(&s, thing_box(0.5, 0.5, 0.5), pose, 0);
  nsvcd_world_question q = question_of(id, &pose, 1, NSVCD_ASK_FIRST);
  q.question.slop = 0.001f;
  const nsvcd_world_answer a = ask(&s, &q);
  CHECK_EQ(a.verdict, NSVCD_HIT);
  CHECK_EQ(a.depth, 0);
  CHECK_EQ(a.safe_time, 0);
  CHECK_EQ(a.time.high, 0);
  stage_end(&s);
}

// ---- who meets whom

static void groups_sensors_and_outsiders(void) {
  stage s = stage_begin();
  nsvcd_world_body body;
  memset(&body, 0, sizeof body);
  body.pose = pose_of(0, 0, 0);
  body.groups = 4;
  const size_t glass = stage_add_body(&s, thing_box(1, 1, 1), body);
  body.groups = 0;
  body.passes = 8;
  const size_t net = stage_add_body(&s, thing_box(1.1, 1, 1), body);
  body.passes = 0;
  body.sensor = 1;
  const size_t sensor = stage_add_body(&s, thing_box(1.2, 1, 1), body);
  thing t = thing_box(0.2, 0.2, 0.2);
  const nsvcd_pose way[2] = {pose_of(-3, 0, 0), pose_of(3, 0, 0)};
  size_t ids[8], count, size;
  void *memory = workspace(&size);
  static const size_t all[3] = {1, 2, 3};
  for (uint32_t groups = 0; groups < 16; groups += 8) {
    for (uint32_t passes = 0; passes < 8; passes += 4) {
      nsvcd_world_question q = question_of(NSVCD_NOBODY, way, 2, NSVCD_ASK_HIT);
      q.question.a.body = t.body;
      q.groups = groups;
      q.passes = passes;
      CHECK_EQ(nsvcd_world_list(s.world, &q, memory, size, ids, 8, &count), NSVCD_OK);
      const int meets_glass = passes != 4;
      const int meets_net = groups != 8;
      CHECK_EQ(count, meets_glass + meets_net + 1);
      for (size_t k = 0; k < count; k++) CHECK(ids[k] != (meets_glass ? 0 : glass));
      if (count == 3) CHECK(!memcmp(ids, all, sizeof all));
      CHECK_EQ(ids[count - 1], sensor);
      q.question.ask = NSVCD_ASK_FIRST;
      const nsvcd_world_answer a = ask(&s, &q);
      CHECK_EQ(a.body, meets_net ? net : meets_glass ? glass : NSVCD_NOBODY);
      if (a.body) CHECK_NEAR(a.time.high, (3 - 0.1 - (meets_net ? 0.55 : 0.5)) / 6, 1e-3);
    }
  }
  // itself, where it is: a body does not meet itself, and an outsider of the same place does
  nsvcd_world_question q = question_of(glass, NULL, 0, NSVCD_ASK_HIT);
  CHECK_EQ(nsvcd_world_list(s.world, &q, memory, size, ids, 8, &count), NSVCD_OK);
  CHECK_EQ(count, 2);
  q = question_of(NSVCD_NOBODY, NULL, 0, NSVCD_ASK_HIT);
  q.question.a.body = s.things[glass].body;
  CHECK_EQ(nsvcd_world_list(s.world, &q, memory, size, ids, 8, &count), NSVCD_OK);
  CHECK_EQ(count, 3);
  thing_free(&t);
  stage_end(&s);
}

// Boxes that do not meet, of bodies within the clearance of each other.
static void what_is_within_the_clearance(void) {
  stage s = stage_begin();
  const size_t id = stage_add(&s, thing_box(1, 1, 1), pose_of(0, 0, 0), 0);
  const size_t other = stage_add(&s, thing_box(1, 1, 1), pose_of(1.5, 0, 0), 1);
  nsvcd_world_question q = question_of(id, NULL, 0, NSVCD_ASK_HIT);
  q.question.clearance = 0.49f;
  CHECK_EQ(ask(&s, &q).verdict, NSVCD_FREE);
  q.question.clearance = 0.51f;
  CHECK_EQ(ask(&s, &q).body, other);
  stage_end(&s);
}

// Two bodies of one mesh at one place, and a mover with their pose.
static void bodies_of_one_place(void) {
  stage s = stage_begin();
  thing t = thing_box(1, 1, 1);
  nsvcd_world_body body;
  memset(&body, 0, sizeof body);
  body.pose = pose_of(1, 0, 0);
  const size_t first = stage_add_body(&s, t, body);
  size_t second = 0;
  body.body = t.body;
  CHECK_EQ(nsvcd_world_add(s.world, &body, &second), NSVCD_OK);
  nsvcd_world_question q = question_of(first, NULL, 0, NSVCD_ASK_FIRST);
  nsvcd_world_answer a = ask(&s, &q);
  CHECK_EQ(a.verdict, NSVCD_HIT);
  CHECK_EQ(a.body, second);
  CHECK_EQ(a.safe_time, 0);
  q = question_of(second, &body.pose, 1, NSVCD_ASK_HIT);
  a = ask(&s, &q);
  CHECK_EQ(a.body, first);
  stage_end(&s);
}

// ---- bad input

static void bad_bodies_are_refused(void) {
  stage s = stage_begin();
  thing t = thing_box(1, 1, 1);
  nsvcd_world_body good;
  nsvcd_world *none = NULL;
  memset(&good, 0, sizeof good);
  good.body = t.body;
  good.pose = pose_of(0, 0, 0);
  const size_t first = stage_add_body(&s, t, good);
  CHECK_EQ(nsvcd_world_size(0), 0);
  CHECK_EQ(nsvcd_world_size(0x7fffffff), 0);
  CHECK_EQ(nsvcd_world_size((size_t)-1), 0);
  const size_t size = nsvcd_world_size(3);
  void *memory = malloc(size + 64);
  CHECK_EQ(nsvcd_world_begin(memory, size, 3, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_begin(memory, size, 0, &none), NSVCD_ERROR_COUNT);
  CHECK_EQ(nsvcd_world_begin(NULL, size, 3, &none), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_world_begin(memory, size - 1, 3, &none), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_world_begin((char *)memory + 1, size, 3, &none), NSVCD_ERROR_WORKSPACE);
  CHECK(none == NULL);
  const size_t bytes = nsvcd_world_size(STAGE_MOST);
  char *before = (char *)malloc(bytes);
  // Its counter of changes may have moved on, and nothing else.
#define REFUSED(call, code)                  \
  do {                                       \
    s.world->changes = 0;                    \
    memcpy(before, s.memory, bytes);         \
    CHECK_EQ(call, code);                    \
    CHECK_EQ(s.world->changes & 1, 0);       \
    s.world->changes = 0;                    \
    CHECK(!memcmp(before, s.memory, bytes)); \
  } while (0)
#define BODY_REFUSED(change, code)                    \
  do {                                                \
    nsvcd_world_body b = good;                        \
    size_t id = 77;                                   \
    change;                                           \
    REFUSED(nsvcd_world_add(s.world, &b, &id), code); \
    CHECK_EQ(id, 77);                                 \
  } while (0)
  static const uint64_t no_body[8] = {0};
  BODY_REFUSED(b.body = NULL, NSVCD_ERROR_ARGUMENT);
  BODY_REFUSED(b.body = (const nsvcd_body *)(const void *)no_body, NSVCD_ERROR_BODY);
  BODY_REFUSED(b.pose.position[1] = NAN, NSVCD_ERROR_POSE);
  BODY_REFUSED(b.pose.position[1] = 2e6f, NSVCD_ERROR_POSE);
  BODY_REFUSED(b.pose.rotation[3] = 0, NSVCD_ERROR_QUATERNION);
  BODY_REFUSED(b.pose.rotation[0] = NAN, NSVCD_ERROR_QUATERNION);
  BODY_REFUSED(b.scale = -1, NSVCD_ERROR_SCALE);
  BODY_REFUSED(b.scale = NAN, NSVCD_ERROR_SCALE);
  BODY_REFUSED(b.scale = 1e9f, NSVCD_ERROR_SCALE);
  BODY_REFUSED(b.pivot[2] = NAN, NSVCD_ERROR_PIVOT);
  BODY_REFUSED(b.pivot[2] = 2e6f, NSVCD_ERROR_PIVOT);
  BODY_REFUSED((b.pivot[2] = 9e5f, b.scale = 2), NSVCD_ERROR_PIVOT);
  size_t id = 77;
  nsvcd_pose bad = pose_of(0, NAN, 0);
  const nsvcd_pose fine = pose_of(0, 1, 0);
  nsvcd_world_body got;
  REFUSED(nsvcd_world_add(NULL, &good, &id), NSVCD_ERROR_ARGUMENT);
  REFUSED(nsvcd_world_add(s.world, NULL, &id), NSVCD_ERROR_ARGUMENT);
  REFUSED(nsvcd_world_add(s.world, &good, NULL), NSVCD_ERROR_ARGUMENT);
  for (int drives = 0; drives < 2; drives++) {
#define PLACE(world, id, pose) \
  (drives ? nsvcd_world_drive(world, id, pose) : nsvcd_world_move(world, id, pose))
    REFUSED(PLACE(NULL, first, &fine), NSVCD_ERROR_ARGUMENT);
    REFUSED(PLACE(s.world, first, NULL), NSVCD_ERROR_ARGUMENT);
    REFUSED(PLACE(s.world, 0, &fine), NSVCD_ERROR_INDEX);
    REFUSED(PLACE(s.world, first + 1, &fine), NSVCD_ERROR_INDEX);
    REFUSED(PLACE(s.world, (size_t)-1, &fine), NSVCD_ERROR_INDEX);
    REFUSED(PLACE(s.world, first, &bad), NSVCD_ERROR_POSE);
    bad = pose_of(0, 0, 0);
    bad.rotation[0] = 1;
    REFUSED(PLACE(s.world, first, &bad), NSVCD_ERROR_QUATERNION);
    bad = pose_of(0, 2e6, 0);
  }
  REFUSED(nsvcd_world_remove(NULL, first), NSVCD_ERROR_ARGUMENT);
  REFUSED(nsvcd_world_remove(s.world, 0), NSVCD_ERROR_INDEX);
  REFUSED(nsvcd_world_remove(s.world, 2), NSVCD_ERROR_INDEX);
  REFUSED(nsvcd_world_get(NULL, first, &got), NSVCD_ERROR_ARGUMENT);
  REFUSED(nsvcd_world_get(s.world, first, NULL), NSVCD_ERROR_ARGUMENT);
  REFUSED(nsvcd_world_get(s.world, 2, &got), NSVCD_ERROR_INDEX);
  REFUSED(nsvcd_world_arrive(NULL), NSVCD_ERROR_ARGUMENT);
  size_t count = 77;
  nsvcd_body_pair pair;
  REFUSED(nsvcd_world_pairs(NULL, 0, &pair, 1, &count), NSVCD_ERROR_ARGUMENT);
  REFUSED(nsvcd_world_pairs(s.world, 0, NULL, 1, &count), NSVCD_ERROR_ARGUMENT);
  REFUSED(nsvcd_world_pairs(s.world, 0, &pair, 1, NULL), NSVCD_ERROR_ARGUMENT);
  REFUSED(nsvcd_world_pairs(s.world, -1, &pair, 1, &count), NSVCD_ERROR_DISTANCE);
  REFUSED(nsvcd_world_pairs(s.world, NAN, &pair, 1, &count), NSVCD_ERROR_DISTANCE);
  CHECK_EQ(count, 77);
  for (; id == 77 || s.count < STAGE_MOST; s.count++) {
    CHECK_EQ(nsvcd_world_add(s.world, &good, &id), NSVCD_OK);
    if (id == STAGE_MOST) break;
  }
  id = 77;
  REFUSED(nsvcd_world_add(s.world, &good, &id), NSVCD_ERROR_COUNT);
  CHECK_EQ(nsvcd_world_remove(s.world, 5), NSVCD_OK);
  CHECK_EQ(nsvcd_world_add(s.world, &good, &id), NSVCD_OK);
  CHECK_EQ(id, 5);
  free(before);
  free(memory);
  s.count = 1;
  stage_end(&s);
}

// Each function that asks or changes, while the world is being changed.
static void worlds_that_change_are_refused(void) {
  stage s = stage_begin();
  const size_t id = stage_add(&s, thing_box(1, 1, 1), pose_of(0, 0, 0), 0);
  const nsvcd_pose there = pose_of(3, 0, 0);
  nsvcd_world_body body;
  nsvcd_world_answer answer;
  nsvcd_slide_answer slid;
  nsvcd_velocity velocity = {{1, 0, 0}, {0, 0, 0}};
  nsvcd_body_pair pair;
  size_t size, count = 77, ids[1];
  void *memory = workspace(&size);
  const nsvcd_world_question q = question_of(id, NULL, 0, NSVCD_ASK_HIT);
  memset(&slid, 0, sizeof slid);
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_world_get(s.world, id, &body), NSVCD_OK);
  CHECK_EQ(nsvcd_world_drive(s.world, id, &there), NSVCD_OK);
  s.world->changes |= 1;
  CHECK_EQ(nsvcd_world_add(s.world, &body, &count), NSVCD_ERROR_WORLD);
  CHECK_EQ(nsvcd_world_move(s.world, id, &there), NSVCD_ERROR_WORLD);
  CHECK_EQ(nsvcd_world_drive(s.world, id, &there), NSVCD_ERROR_WORLD);
  CHECK_EQ(nsvcd_world_arrive(s.world), NSVCD_ERROR_WORLD);
  CHECK_EQ(nsvcd_world_remove(s.world, id), NSVCD_ERROR_WORLD);
  CHECK_EQ(nsvcd_world_pairs(s.world, 0, &pair, 1, &count), NSVCD_ERROR_WORLD);
  CHECK_EQ(nsvcd_world_list(s.world, &q, memory, size, ids, 1, &count), NSVCD_ERROR_WORLD);
  CHECK_EQ(nsvcd_world_sweep(s.world, &q, memory, size, &answer), NSVCD_ERROR_WORLD);
  CHECK_EQ(nsvcd_world_slide(s.world, id, NULL, 0.1f, memory, size, &velocity, &slid),
           NSVCD_ERROR_WORLD);
  CHECK_EQ(count, 77);
  CHECK_EQ(velocity.linear[0], 1);
  CHECK_EQ(s.world->changes & 1, 1);
  s.world->changes++;
  CHECK_EQ(stage_pose(&s, id).position[0], 0);
  stage_end(&s);
}

static void bad_questions_are_refused(void) {
  stage s = stage_begin();
  const nsvcd_pose at = pose_of(0, 0, 0);
  const size_t id = stage_add(&s, thing_box(1, 1, 1), at, 0);
  const nsvcd_pose way[2] = {at, pose_of(0, 0, NAN)};
  const nsvcd_world_question good = question_of(id, &at, 1, NSVCD_ASK_HIT);
  nsvcd_world_answer answer, before;
  size_t size, count = 77, ids[4] = {7, 7, 7, 7};
  void *memory = workspace(&size);
  memset(&answer, 0x5a, sizeof answer);
  memset(&before, 0x5a, sizeof before);
#undef REFUSED
#define REFUSED(change, code)                                                    \
  do {                                                                           \
    nsvcd_world_question q = good;                                               \
    change;                                                                      \
    CHECK_EQ(nsvcd_world_sweep(s.world, &q, memory, size, &answer), code);       \
    CHECK_EQ(nsvcd_world_list(s.world, &q, memory, size, ids, 4, &count), code); \
    CHECK(!memcmp(&answer, &before, sizeof answer));                             \
    CHECK_EQ(count, 77);                                                         \
    CHECK_EQ(ids[0], 7);                                                         \
  } while (0)
  REFUSED(q.self = 2, NSVCD_ERROR_INDEX);
  REFUSED(q.self = (size_t)-1, NSVCD_ERROR_INDEX);
  REFUSED(q.self = 0, NSVCD_ERROR_ARGUMENT);
  REFUSED(q.question.b.body = s.things[id].body, NSVCD_ERROR_ARGUMENT);
  REFUSED(q.question.b.poses = &at, NSVCD_ERROR_ARGUMENT);
  REFUSED(q.question.method = NSVCD_METHOD_NETWORK, NSVCD_ERROR_METHOD);
  REFUSED(q.question.method = (nsvcd_method)9, NSVCD_ERROR_METHOD);
  REFUSED(q.question.ask = (nsvcd_ask)9, NSVCD_ERROR_ASK);
  REFUSED(q.question.ask = NSVCD_ASK_DISTANCE, NSVCD_ERROR_ASK);
  REFUSED((q.question.a.poses = way, q.question.a.count = 2), NSVCD_ERROR_POSE);
  REFUSED(q.question.a.poses = NULL, NSVCD_ERROR_POSES);
  REFUSED(q.question.a.count = 0, NSVCD_ERROR_POSES);
  REFUSED(q.question.clearance = -1, NSVCD_ERROR_CLEARANCE);
  REFUSED(q.question.slop = NAN, NSVCD_ERROR_SLOP);
  REFUSED(q.question.tolerance = -1, NSVCD_ERROR_TOLERANCE);
  REFUSED(q.question.to = 1, NSVCD_ERROR_TO);
  REFUSED(q.question.manifold = 1, NSVCD_ERROR_MANIFOLD);
  REFUSED(q.question.segments = 5, NSVCD_ERROR_SEGMENTS);
  CHECK_EQ(nsvcd_world_sweep(NULL, &good, memory, size, &answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_sweep(s.world, NULL, memory, size, &answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_sweep(s.world, &good, memory, size, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_sweep(s.world, &good, NULL, size, &answer), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_world_sweep(s.world, &good, memory, 64, &answer), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_world_list(NULL, &good, memory, size, ids, 4, &count), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_list(s.world, NULL, memory, size, ids, 4, &count), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_list(s.world, &good, memory, size, NULL, 4, &count), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_list(s.world, &good, memory, size, ids, 4, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_list(s.world, &good, NULL, size, ids, 4, &count), NSVCD_ERROR_WORKSPACE);
  CHECK(!memcmp(&answer, &before, sizeof answer));
  CHECK_EQ(count, 77);
  stage_end(&s);
}

void test_world(void) {
  RUN(pairs_are_those_of_all_boxes);
  RUN(bodies_in_bad_orders);
  RUN(answers_are_of_all_bodies);
  RUN(one_push_out_of_a_corner);
  RUN(no_push_out_between_walls);
  RUN(groups_sensors_and_outsiders);
  RUN(what_is_within_the_clearance);
  RUN(bodies_of_one_place);
  RUN(bad_bodies_are_refused);
  RUN(worlds_that_change_are_refused);
  RUN(bad_questions_are_refused);
}

CHECK_ALONE(test_world)
