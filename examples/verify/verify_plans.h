// SPDX-License-Identifier: MIT
// verify_plans.h - of verify.c: planning files (examples/FORMATS.md), and the certificates of their
// plans: a motion, which keeps the axes that it is to keep, and a proof for each pair of bodies that
// must not meet. Not looked at are limits of joints, of speeds and accelerations, and pairs that the
// file does not name.
#ifndef NSVCD_VERIFY_PLANS_H
#define NSVCD_VERIFY_PLANS_H
#include "nsvcd_verify_robot.h"
#include "verify_shapes.h"

typedef struct robot_body {
  const char *name;
  const nsvcd_verify_mesh *mesh;
  double radius;  // metres, about the mesh
  uint32_t link;
  float pose[7];
} robot_body;

// A line `clearance`: of two bodies, or, if both are EACH, of each pair with an obstacle.
#define EACH 0xffffffffu
typedef struct distance {
  uint32_t a, b;
  float metres;
} distance;

typedef struct group {
  const char *name;
  uint8_t moves[NSVCD_VERIFY_JOINTS];
} group;

// A line `keep`: the axis of a body stays within an angle of a direction, while a joint moves it.
typedef struct keep {
  uint32_t body;
  double axis[3], direction[3], angle;
} keep;

typedef struct robot {
  const char *path;
  const char *names[NSVCD_VERIFY_JOINTS];
  int continuous[NSVCD_VERIFY_JOINTS];
  nsvcd_verify_joint joints[NSVCD_VERIFY_JOINTS];
  size_t joint_count;
  list bodies;  // the robot's, then the scene's obstacles, which are read last
  size_t own;   // how many of them are the robot's
  list pairs;   // (2): the robot's, then those with obstacles
  list kept;    // (pairs): metres
  list groups;
  list distances;  // those above the first scene, then the scene's
  list keeps;      // so too
} robot;

static uint32_t link_named(const robot *r, const char *name) {
  if (strcmp(name, "world") == 0) return 0;
  for (uint32_t i = 0; i < r->joint_count; i++)
    if (strcmp(r->names[i], name) == 0) return i + 1;
  fail(r->path, "a joint is named that is not above");
  return 0;
}

static uint32_t body_named(const robot *r, const char *name) {
  const robot_body *bodies = (const robot_body *)r->bodies.items;
  for (uint32_t i = 0; i < r->bodies.count; i++)
    if (strcmp(bodies[i].name, name) == 0) return i;
  fail(r->path, "a body is named that is not above");
  return 0;
}

// body NAME JOINT SHAPE, then `pose` and `scale`, each once; or obstacle NAME SHAPE, a pose, `scale`.
static void add_body(robot *r, char *const *words, size_t count) {
  const int rests = words[0][0] == 'o';
  const size_t shape = rests ? 2 : 3;
  const size_t after = shape + shape_words(words[shape]);
  size_t at = after + (rests ? 7 : 0);
  char *const *pose = rests ? words + after : NULL;
  double scale[3] = {1, 1, 1};
  int is_scaled = after > shape + 1;  // only meshes are
  if (at > count) fail(r->path, "a body lacks a number");
  while (at < count) {
    if (strcmp(words[at], "pose") == 0 && !pose && count - at >= 8) {
      pose = words + at + 1;
      at += 8;
    } else if (strcmp(words[at], "scale") == 0 && !is_scaled && count - at >= 4) {
      for (size_t k = 0; k < 3; k++) scale[k] = number_of(r->path, words[at + 1 + k]);
      for (size_t k = 0; k < 3; k++)
        if (!(fabs(scale[k]) >= 1e-6 && fabs(scale[k]) <= 1e6))
          fail(r->path, "a scale is out of range");
      is_scaled = 1;
      at += 4;
    } else {
      fail(r->path, "something follows a body");
    }
  }
  for (size_t i = 0; i < r->bodies.count; i++)
    if (strcmp(((const robot_body *)r->bodies.items)[i].name, words[1]) == 0)
      fail(r->path, "two bodies of one name");
  const uint32_t link = rests ? 0 : link_named(r, words[2]);
  robot_body *body = (robot_body *)add(&r->bodies, sizeof *body);
  memset(body, 0, sizeof *body);
  body->name = words[1];
  body->link = link;
  body->mesh = shape_of_words(r->path, words + shape, scale, &body->radius);
  body->pose[6] = 1;
  if (pose) read_pose(r->path, pose, body->pose);
}

static void add_joint(robot *r, char *const *words) {
  if (r->joint_count == NSVCD_VERIFY_JOINTS) fail(r->path, "too many joints");
  static const char *const kinds[] = {"revolute", "continuous", "prismatic"};
  int kind = 0;
  while (kind < 3 && strcmp(kinds[kind], words[13]) != 0) kind++;
  if (kind == 3) fail(r->path, "a joint is of no kind");
  for (size_t i = 0; i < r->joint_count; i++)
    if (strcmp(r->names[i], words[1]) == 0) fail(r->path, "two joints of one name");
  if (strcmp(words[1], "world") == 0) fail(r->path, "a joint of the name world");
  nsvcd_verify_joint *joint = &r->joints[r->joint_count];
  joint->parent = link_named(r, words[2]);
  joint->slides = strcmp(words[13], "prismatic") == 0;
  read_pose(r->path, words + 3, joint->origin);
  for (size_t k = 0; k < 3; k++) joint->axis[k] = (float)number_of(r->path, words[10 + k]);
  r->continuous[r->joint_count] = strcmp(words[13], "continuous") == 0;
  r->names[r->joint_count++] = words[1];
}

// ---- the certificate

static uint64_t take(const uint8_t *bytes, size_t size, size_t *at, size_t count) {
  uint64_t value = 0;
  for (size_t k = 0; k < count; k++, ++*at)
    if (*at < size) value |= (uint64_t)bytes[*at] << (8 * k);
  return value;
}
static double take_double(const uint8_t *bytes, size_t size, size_t *at) {
  const uint64_t bits = take(bytes, size, at, 8);
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

// A line that is a plan or a goal: plans are checked where their scene ends, since goals may follow.
typedef struct plan_line {
  char *words[MOST_WORDS];
  size_t count;
  const group *of;     // of a plan; NULL: all joints may move
  size_t keeps;        // of a plan: how many lines `keep` stand above
  const char *barred;  // of a plan: why it cannot be checked; NULL: it can
} plan_line;

// Do only joints of a group move? NULL: all may.
static int keeps_to(const group *of, const nsvcd_verify_motion *m) {
  for (size_t k = m->joint_count; k < (m->pieces * m->degree + 1) * m->joint_count && of; k++) {
    const double off = m->points[k] - m->points[k % m->joint_count];
    if (!of->moves[k % m->joint_count] && (off > 0 || off < 0)) return 0;
  }
  return 1;
}

// Are all axes kept in a motion? What rests has nothing to keep.
static int keeps_axes(const robot *r, const nsvcd_verify_motion *m, size_t count) {
  for (size_t k = 0; k < count; k++) {
    const keep *line = (const keep *)r->keeps.items + k;
    const robot_body *body = (const robot_body *)r->bodies.items + line->body;
    nsvcd_verify_part part = {m, body->link, 0, {0}};
    memcpy(part.pose, body->pose, sizeof part.pose);
    if (body->link && !nsvcd_verify_keeps(&part, line->axis, line->direction, line->angle))
      return 0;
  }
  return 1;
}

// Are the joints at an end of a motion those of a line? Turns without limits may be whole ones off.
static int is_at(const robot *r, const double *joints, char *const *words) {
  const double turn = 6.283185307179586;
  for (size_t j = 0; j < r->joint_count; j++) {
    double off = joints[j] - number_of(r->path, words[j]);
    if (r->continuous[j]) off -= turn * floor(off / turn + 0.5);
    if (!(fabs(off) < 1e-9)) return 0;
  }
  return 1;
}

// Is a body at its pose when a motion ends? goal ID pose x y z qx qy qz qw NAME ..., see
// examples/FORMATS.md. What svcd allows is 1e-6 m, and radians.
static int is_placed(const robot *r, const nsvcd_verify_motion *m, const plan_line *goal) {
  const double near_enough = 2e-6;
  char *const *words = goal->words;
  const robot_body *body = (const robot_body *)r->bodies.items + body_named(r, words[10]);
  nsvcd_verify_part part = {m, body->link, 0, {0}};
  nsvcd_verify_place at;
  float pose[7];
  double q[4], turn[9];
  double half[3] = {0, 0, 0};
  int free_axis = -1;
  memcpy(part.pose, body->pose, sizeof part.pose);
  verify__part_place(&part, 1, &at);
  read_pose(r->path, words + 3, pose);
  for (int i = 0; i < 4; i++) q[i] = (double)pose[3 + i];
  verify__matrix(q, turn);
  for (size_t k = 11; k < goal->count;) {
    const int is_box = strcmp(words[k], "box") == 0 && goal->count - k >= 4;
    if (!is_box && (strcmp(words[k], "free") != 0 || goal->count - k < 2))
      fail(r->path, "something follows a goal");
    for (size_t i = 0; i < 3 && is_box; i++) half[i] = number_of(r->path, words[k + 1 + i]);
    if (!is_box) free_axis = words[k + 1][0] - 'x';
    k += is_box ? 4 : 2;
  }
  for (int k = 0; k < 3; k++) {
    double off = 0;
    double turned = 0;
    for (int i = 0; i < 3; i++) {
      const double by = at.turn[3 * i + k] - turn[3 * i + k];
      off += turn[3 * i + k] * (at.at[i] - (double)pose[i]);
      turned += by * by;
    }
    if (!(fabs(off) <= half[k] + near_enough)) return 0;
    if ((free_axis < 0 || k == free_axis) && !(sqrt(turned) <= near_enough)) return 0;
  }
  return 1;
}

// Does a motion begin at the start of a plan, and end at one of its goals? Those are on its line, and
// on lines below, up to a plan of the same ID.
static int goes(const robot *r, const nsvcd_verify_motion *m, const plan_line *plan,
                const plan_line *end) {
  const size_t joints = m->joint_count;
  const double *last = m->points + m->pieces * m->degree * joints;
  if (!is_at(r, m->points, plan->words + 3)) return 0;
  if (plan->count > 3 + joints && is_at(r, last, plan->words + 3 + joints)) return 1;
  for (const plan_line *goal = plan + 1; goal < end; goal++) {
    if (strcmp(goal->words[1], plan->words[1]) != 0) continue;
    if (strcmp(goal->words[0], "plan") == 0) return 0;
    const int is_pose = strcmp(goal->words[2], "pose") == 0;
    if (is_pose ? is_placed(r, m, goal) : is_at(r, last, goal->words + 2)) return 1;
  }
  return 0;
}

static const char *check_pair(const robot *r, const nsvcd_verify_motion *m, size_t pair,
                              float clearance, const uint8_t *bytes, size_t size,
                              nsvcd_verify_report *report) {
  const uint32_t *who = (const uint32_t *)r->pairs.items + 2 * pair;
  const robot_body *bodies[2] = {(const robot_body *)r->bodies.items + who[0],
                                 (const robot_body *)r->bodies.items + who[1]};
  nsvcd_verify_part parts[2];
  nsvcd_verify_mover movers[2];
  const size_t room = NSVCD_VERIFY_WORKSPACE_BYTES(m->pieces + 3);
  const char *why = NULL;
  for (int k = 0; k < 2 && !why; k++) {
    parts[k].motion = m;
    parts[k].link = bodies[k]->link;
    parts[k].base = nsvcd_verify_common(m, bodies[0]->link, bodies[1]->link);
    memcpy(parts[k].pose, bodies[k]->pose, sizeof parts[k].pose);
    why = nsvcd_verify_part_init(bodies[k]->mesh, 1, &parts[k], &movers[k]);
  }
  if (why) return why;
  // what is round keeps its radius besides: a float, and no less
  const double sum = (double)clearance + (bodies[0]->radius + bodies[1]->radius);
  clearance = (float)sum;
  if ((double)clearance < sum) clearance = nextafterf(clearance, HUGE_VALF);
  void *workspace = allocate(room);
  const int accepted =
      nsvcd_verify(&movers[0], &movers[1], clearance, bytes, size, workspace, room, report);
  free(workspace);
  if (!accepted) return report->reason;
  return report->kind == NSVCD_VERIFY_FREE ? NULL : "a pair is not proven free";
}

// NULL, or why it is refused. *at: the byte.
static const char *check_motion(const robot *r, const plan_line *plan, const plan_line *end,
                                const uint8_t *bytes, size_t size, size_t *at) {
  nsvcd_verify_motion m;
  memset(&m, 0, sizeof m);
  *at = 4;
  if (size < 16 || memcmp(bytes, "NSVM", 4) != 0) return "it is no certificate of a motion";
  m.joints = r->joints;
  m.pieces = (size_t)take(bytes, size, at, 4);
  m.degree = (size_t)take(bytes, size, at, 4);
  m.joint_count = (size_t)take(bytes, size, at, 4);
  if (m.joint_count != r->joint_count) return "it is about another robot";
  if (m.pieces < 1 || m.degree < 1 || m.degree > 5 || m.pieces > 65536) return "it has no motion";
  const size_t numbers = (m.pieces * m.degree + 1) * m.joint_count;
  if (size / 8 < numbers + m.pieces + 1) return "it ends early";
  double *motion = (double *)allocate((numbers + m.pieces + 1) * sizeof *motion);
  for (size_t k = 0; k < numbers + m.pieces + 1; k++) motion[k] = take_double(bytes, size, at);
  m.times = motion;
  m.points = motion + m.pieces + 1;
  const size_t pairs = r->pairs.count / 2;
  const char *why = nsvcd_verify_motion_check(&m);
  if (!why && !goes(r, &m, plan, end)) why = "its motion has another start or goal";
  if (!why && !keeps_to(plan->of, &m)) why = "a joint moves that is not of the plan's group";
  if (!why && !keeps_axes(r, &m, plan->keeps)) why = "an axis leaves what it is to keep";
  if (!why && take(bytes, size, at, 4) != pairs) why = "it is about other pairs";
  for (size_t pair = 0; pair < pairs && !why; pair++) {
    const size_t length = (size_t)take(bytes, size, at, 4);
    nsvcd_verify_report report;
    memset(&report, 0, sizeof report);
    if (*at > size || length > size - *at) {
      why = "it ends early";
      break;
    }
    const float kept = ((const float *)r->kept.items)[pair];
    why = check_pair(r, &m, pair, kept, bytes + *at, length, &report);
    *at += why ? report.position : length;
  }
  if (!why && *at != size) why = "something follows its end";
  free(motion);
  return why;
}

static int check_plan(const robot *r, const plan_line *plan, const plan_line *end, request *asked) {
  char *const *words = plan->words;
  char path[4096];
  size_t size;
  size_t at = 0;
  snprintf(path, sizeof path, "%s/%s.cert", asked->folder, words[1]);
  uint8_t *bytes = (uint8_t *)read_file(path, &size);
  if (!bytes) return printf("%s\trefused\tthere is no certificate\t0\t0\n", words[1]), 0;
  const clock_t start = clock();
  const char *why = plan->barred ? plan->barred : check_motion(r, plan, end, bytes, size, &at);
  const double taken = 1e6 * (double)(clock() - start) / (double)CLOCKS_PER_SEC;
  if (!why) printf("%s\taccepted\tfree\t%zu\t%.1f\n", words[1], size, taken);
  if (why) printf("%s\trefused\t%s, at byte %zu\t%zu\t%.1f\n", words[1], why, at, size, taken);
  free(bytes);
  return !why;
}

static int is_pair(const distance *d, const uint32_t *pair) {
  return (d->a == pair[0] && d->b == pair[1]) || (d->a == pair[1] && d->b == pair[0]);
}

// clearance NAME NAME METRES, or clearance obstacles METRES
static void add_distance(robot *r, char *const *words, size_t count) {
  distance d = {EACH, EACH, (float)number_of(r->path, words[count - 1])};
  if (d.metres < 0) fail(r->path, "a clearance is negative");
  if (count == 4) {
    const robot_body *bodies = (const robot_body *)r->bodies.items;
    const uint32_t names[2] = {body_named(r, words[1]), body_named(r, words[2])};
    const int is_first_own = names[0] < r->own;
    d.a = names[!is_first_own];
    d.b = names[is_first_own];
    int found = d.a < r->own && d.b >= r->own && bodies[d.a].link > 0;
    for (size_t k = 0; k + 1 < r->pairs.count; k += 2)
      found |= is_pair(&d, (const uint32_t *)r->pairs.items + k);
    if (!found) fail(r->path, "a clearance of two bodies that are no pair");
  } else if (strcmp(words[1], "obstacles") != 0) {
    fail(r->path, "a clearance of one body");
  }
  *(distance *)add(&r->distances, sizeof d) = d;
}

// keep NAME x|y|z X Y Z DEGREES
static void add_keep(robot *r, char *const *words) {
  keep line;
  double square = 0;
  memset(&line, 0, sizeof line);
  line.body = body_named(r, words[1]);
  if (words[2][0] < 'x' || words[2][0] > 'z' || words[2][1])
    fail(r->path, "an axis is kept that is none");
  line.axis[words[2][0] - 'x'] = 1;
  for (size_t k = 0; k < 3; k++) {
    line.direction[k] = (double)(float)number_of(r->path, words[3 + k]);
    square += line.direction[k] * line.direction[k];
  }
  line.angle = number_of(r->path, words[6]) * (3.141592653589793 / 180);
  if (!(square > 1e-12 && square < 1e13))
    fail(r->path, "a direction has no length, or is too long");
  if (!(line.angle > 0 && line.angle < 3.1415926)) fail(r->path, "an axis is kept to no angle");
  for (size_t k = 0; k < 3; k++) line.direction[k] /= sqrt(square);
  *(keep *)add(&r->keeps, sizeof line) = line;
}

// Adds each body that a joint moves with each obstacle of the scene read last; then, what each pair
// keeps: one with an obstacle what is asked for, or what the file says of all, if that is more. What
// it says of two bodies comes before both.
static void finish_scene(robot *r, float asked) {
  const robot_body *bodies = (const robot_body *)r->bodies.items;
  const distance *distances = (const distance *)r->distances.items;
  const size_t own_pairs = r->pairs.count / 2;
  float all = 0;
  for (uint32_t a = 0; a < r->own; a++) {
    for (uint32_t b = (uint32_t)r->own; b < r->bodies.count && bodies[a].link > 0; b++) {
      add_index(&r->pairs, a);
      add_index(&r->pairs, b);
    }
  }
  for (size_t k = 0; k < r->distances.count; k++)
    if (distances[k].a == EACH) all = distances[k].metres;
  r->kept.count = 0;
  for (size_t n = 0; n < r->pairs.count / 2; n++) {
    double metres = n < own_pairs ? 0 : all > asked ? (double)all : (double)asked;
    for (size_t k = 0; k < r->distances.count; k++)
      if (is_pair(&distances[k], (const uint32_t *)r->pairs.items + 2 * n))
        metres = (double)distances[k].metres;
    add_float(&r->kept, metres);
  }
}

// group NAME JOINT...
static void add_group(robot *r, char *const *words, size_t count) {
  group *of = (group *)add(&r->groups, sizeof *of);
  memset(of, 0, sizeof *of);
  of->name = words[1];
  for (size_t k = 2; k < count; k++) {
    const uint32_t link = link_named(r, words[k]);
    if (link == 0) fail(r->path, "the world is no joint");
    of->moves[link - 1] = 1;
  }
}

// The group of a plan of so many words; NULL: it has none, or it is no plan.
static const group *group_of(const robot *r, char *const *words, size_t count) {
  const group *all = (const group *)r->groups.items;
  if (strcmp(words[0], "plan") != 0 || strcmp(words[count - 2], "group") != 0) return NULL;
  for (size_t k = 0; k < r->groups.count; k++)
    if (strcmp(all[k].name, words[count - 1]) == 0) return &all[k];
  fail(r->path, "a group is named that is not above");
  return NULL;
}

// Checks the plans among the lines of a scene, and forgets them. Returns 1 if all are accepted.
static int check_scene(const robot *r, list *lines, request *asked) {
  const plan_line *first = (const plan_line *)lines->items;
  int all = 1;
  for (size_t k = 0; k < lines->count; k++)
    if (strcmp(first[k].words[0], "plan") == 0 && is_wanted(asked, first[k].words[1]))
      all &= check_plan(r, first + k, first + lines->count, asked);
  lines->count = 0;
  return all;
}

// allow NAME NAME [METRES], attach NAME JOINT, release NAME: what follows in the scene is not known here.
static int is_step(char *const *words, size_t n) {
  if (strcmp(words[0], "allow") == 0) return n == 3 || n == 4;
  return strcmp(words[0], "attach") == 0 ? n == 3 : strcmp(words[0], "release") == 0 && n == 2;
}

// Is a line a plan, a goal, a path or a curve, where it may stand?
static int is_task(const robot *r, char *const *words, size_t n, const char *scene) {
  const size_t joints = r->joint_count;
  if (!scene) return 0;
  if (strcmp(words[0], "goal") == 0)
    return n == 2 + joints || (n >= 11 && strcmp(words[2], "pose") == 0);
  int fits = strcmp(words[0], "path") == 0 && n == 4;
  if (strcmp(words[0], "curve") == 0) fits = n == 5 || n == 6;
  if (strcmp(words[0], "plan") == 0) {
    const size_t numbers = n >= 5 && strcmp(words[n - 2], "group") == 0 ? n - 2 : n;
    fits = numbers == 3 || numbers == 3 + joints || numbers == 3 + 2 * joints;
  }
  return fits && strcmp(words[2], scene) == 0;
}

// Checks all plans of a planning file: the robot, then a scene, its obstacles, and plans, their goals
// and paths in it, and perhaps another scene. Returns 1 if all are accepted.
static int check_plans(const char *path, char *text, request *asked) {
  robot r;
  char *words[MOST_WORDS];
  list lines = {NULL, 0, 0};
  const char *scene = NULL;
  const char *barred = NULL;
  const char *always_barred = NULL;
  size_t own_pairs = 0, own_distances = 0, own_keeps = 0;
  int has_tasks = 0;  // 1: a plan or a path stands above
  int all = 1;
  memset(&r, 0, sizeof r);
  r.path = path;
  for (size_t n = next_words(&text, words, MOST_WORDS); n > 0;
       n = next_words(&text, words, MOST_WORDS)) {
    const char *word = words[0];
    if (strcmp(word, "joint") == 0 && n >= 17 && !scene) {
      add_joint(&r, words);
    } else if (strcmp(word, "body") == 0 && n >= 4 && !scene) {
      add_body(&r, words, n);
      r.own = r.bodies.count;
    } else if (strcmp(word, "pair") == 0 && n == 3 && !scene) {
      add_index(&r.pairs, body_named(&r, words[1]));
      add_index(&r.pairs, body_named(&r, words[2]));
    } else if (strcmp(word, "clearance") == 0 && (n == 3 || n == 4) && !has_tasks) {
      add_distance(&r, words, n);
    } else if (strcmp(word, "group") == 0 && n >= 3 && !scene) {
      add_group(&r, words, n);
    } else if (strcmp(word, "scene") == 0 && n == 2) {
      if (!scene) own_pairs = r.pairs.count;
      if (!scene) own_distances = r.distances.count;
      if (!scene) own_keeps = r.keeps.count;
      all &= check_scene(&r, &lines, asked);
      barred = always_barred;
      scene = words[1];
      has_tasks = 0;
      r.bodies.count = r.own;
      r.pairs.count = own_pairs;
      r.distances.count = own_distances;
      r.keeps.count = own_keeps;
    } else if (strcmp(word, "obstacle") == 0 && n >= 3 && scene && !has_tasks) {
      add_body(&r, words, n);
    } else if (is_task(&r, words, n, scene)) {
      const int is_path = strcmp(word, "path") == 0;
      const int is_curve = strcmp(word, "curve") == 0;
      if (!has_tasks) finish_scene(&r, asked->clearance);
      has_tasks = 1;
      if (is_path || is_curve) {
        for (size_t k = strtoul(words[is_path ? 3 : 4], NULL, 10); k > 0; k--)
          if (next_words(&text, words, MOST_WORDS) == 0)
            fail(path, is_path ? "a path ends early" : "a curve ends early");
        continue;
      }
      plan_line *line = (plan_line *)add(&lines, sizeof *line);
      memcpy(line->words, words, sizeof line->words);
      line->of = group_of(&r, words, n);
      line->count = n - (line->of ? 2 : 0);
      line->barred = barred;
      line->keeps = r.keeps.count;
      if (strcmp(word, "plan") == 0 && line->count == 3)
        line->barred = "it has no start of its own";
    } else if (strcmp(word, "keep") == 0 && n == 7) {
      add_keep(&r, words);
    } else if (is_step(words, n)) {
      barred = "what may touch, or is attached, is not known to this checker";
      if (!scene) always_barred = barred;
    } else {
      fail(path, "a line is not one of a planning file, or not where it may stand");
    }
  }
  all &= check_scene(&r, &lines, asked);
  free(lines.items);
  return all;
}
#endif  // NSVCD_VERIFY_PLANS_H
