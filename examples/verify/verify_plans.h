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
  uint32_t pair[2];
  float metres;
} distance;

// Two bodies that may touch: a line `allow`.
typedef struct allowed {
  uint32_t pair[2];
  double metres;
} allowed;

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
  // of a joint that mimics another: 1 + that; multiplier and offset
  uint32_t leaders[NSVCD_VERIFY_JOINTS];
  double driven[NSVCD_VERIFY_JOINTS][2];
  double low[NSVCD_VERIFY_JOINTS], high[NSVCD_VERIFY_JOINTS];
  nsvcd_verify_joint joints[NSVCD_VERIFY_JOINTS];
  size_t joint_count;
  list bodies;  // the robot's, then the scene's obstacles, which are read last
  size_t own;   // how many of them are the robot's
  size_t own_pairs;
  list pairs;  // (2): the robot's, then, of a plan, those with obstacles
  list kept;   // (pairs): metres
  list groups;
  list distances;  // those above the first scene, then the scene's
  list allows;     // so, too
  list keeps;      // so too
} robot;

// Is a pair of bodies this one, in either order?
static int is_of(const uint32_t *pair, const uint32_t *who) {
  return (pair[0] == who[0] && pair[1] == who[1]) || (pair[0] == who[1] && pair[1] == who[0]);
}

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
  const int is_endless = strcmp(words[13], "continuous") == 0;
  double *low = &r->low[r->joint_count];
  double *high = &r->high[r->joint_count];
  r->continuous[r->joint_count] = is_endless;
  *low = is_endless ? 0 : number_of(r->path, words[14]);
  *high = is_endless ? 6.28318530717960 : number_of(r->path, words[15]);
  if (*low > *high) fail(r->path, "LOW is above HIGH");
  r->names[r->joint_count++] = words[1];
}

// mimic NAME LEADER MULTIPLIER OFFSET
static void add_mimic(robot *r, char *const *words) {
  const uint32_t joint = link_named(r, words[1]);
  const uint32_t leader = link_named(r, words[2]);
  if (joint == 0 || leader == 0) fail(r->path, "the world is no joint");
  int is_plain = joint != leader && !r->leaders[joint - 1] && !r->leaders[leader - 1];
  for (size_t k = 0; k < r->joint_count; k++) is_plain &= r->leaders[k] != joint;
  if (!is_plain) fail(r->path, "a joint mimics itself, two, or one that mimics");
  r->leaders[joint - 1] = leader;
  for (int k = 0; k < 2; k++) r->driven[joint - 1][k] = number_of(r->path, words[3 + k]);
}

// Are all joints that mimic others where these drive them? A curve is if its points are.
static int mimics(const robot *r, const nsvcd_verify_motion *m) {
  for (size_t k = 0; k < (m->pieces * m->degree + 1) * m->joint_count; k++) {
    const size_t joint = k % m->joint_count;
    if (!r->leaders[joint]) continue;
    const double driven = r->driven[joint][0] * m->points[k - joint + r->leaders[joint] - 1];
    const double off = m->points[k] - (driven + r->driven[joint][1]);
    if (!(fabs(off) <= 1e-12 * (1 + fabs(driven) + fabs(r->driven[joint][1])))) return 0;
  }
  return 1;
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

// A line of a scene from its first plan on. Plans are checked where the scene ends, since goals may
// follow.
typedef struct plan_line {
  char *words[MOST_WORDS];
  size_t count;
  const group *of;       // of a plan; NULL: all joints may move
  uint32_t thing, link;  // of `attach` and `release`: a body, and what it is on from now on
  size_t keeps;          // of a plan: how many lines `keep` stand above
} plan_line;

static int is_line(const plan_line *line, const char *word) {
  return strcmp(line->words[0], word) == 0;
}

// A plan, and what the lines above it have come to.
typedef struct step {
  robot *r;  // things are where the plans above have left them
  request *asked;
  const plan_line *plan, *end;  // end: of the scene's lines
  const plan_line *changes;     // from there on `attach` and `release` lines are the plan's
  size_t change_count;
  int is_lost;    // 1: it is not known where things are
  int has_ended;  // 1: the plan above ends at these values
  double ended[NSVCD_VERIFY_JOINTS];
} step;

// Do only joints of a group move, and those that mimic them? NULL: all may.
static int keeps_to(const robot *r, const group *of, const nsvcd_verify_motion *m) {
  for (size_t k = m->joint_count; k < (m->pieces * m->degree + 1) * m->joint_count && of; k++) {
    const double off = m->points[k] - m->points[k % m->joint_count];
    if (r->leaders[k % m->joint_count]) continue;
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

// Are the joints at an end of a motion those of a line, or, without words, those of another motion?
// Turns without limits may be whole ones off; what mimics another joint is where that drives it.
static int is_at(const robot *r, const double *joints, char *const *words, const double *other) {
  const double turn = 6.283185307179586;
  for (size_t j = 0; j < r->joint_count; j++) {
    double off = joints[j] - (words ? number_of(r->path, words[j]) : other[j]);
    if (r->leaders[j]) continue;
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
static int goes(const step *s, const nsvcd_verify_motion *m) {
  const robot *r = s->r;
  const plan_line *plan = s->plan;
  const size_t joints = m->joint_count;
  const double *last = m->points + m->pieces * m->degree * joints;
  if (!is_at(r, m->points, plan->count > 3 ? plan->words + 3 : NULL, s->ended)) return 0;
  if (plan->count > 3 + joints && is_at(r, last, plan->words + 3 + joints, NULL)) return 1;
  for (const plan_line *goal = plan + 1; goal < s->end; goal++) {
    const int is_goal = is_line(goal, "goal");
    if ((!is_goal && !is_line(goal, "plan")) || strcmp(goal->words[1], plan->words[1]) != 0)
      continue;
    if (!is_goal) return 0;
    const int is_pose = strcmp(goal->words[2], "pose") == 0;
    if (is_pose ? is_placed(r, m, goal) : is_at(r, last, goal->words + 2, NULL)) return 1;
  }
  return 0;
}

// Attaches and releases what the lines above a plan say, where the motion begins. A certificate has
// the pose, in floats, of each: it is the one at which the thing stands as it stood, up to their
// rounding, by 6e-8 of each number, so by 1.2e-7 in a turn's matrix.
static const char *take_changes(const step *s, const nsvcd_verify_motion *m, const uint8_t *bytes,
                                size_t size, size_t *at) {
  robot *r = s->r;
  for (const plan_line *line = s->changes; line < s->plan; line++) {
    if (!is_line(line, "attach") && !is_line(line, "release")) continue;
    robot_body *body = (robot_body *)r->bodies.items + line->thing;
    nsvcd_verify_part part = {m, body->link, 0, {0}};
    nsvcd_verify_place was, is;
    double off = 0, turned = 0;
    memcpy(part.pose, body->pose, sizeof part.pose);
    verify__part_place(&part, 0, &was);
    body->link = line->link;
    for (int k = 0; k < 7; k++) {
      const uint32_t bits = (uint32_t)take(bytes, size, at, 4);
      memcpy(&body->pose[k], &bits, sizeof bits);
    }
    if (!verify__is_pose(body->pose)) return "what is attached is at no pose";
    part.link = body->link;
    memcpy(part.pose, body->pose, sizeof part.pose);
    verify__part_place(&part, 0, &is);
    for (int k = 0; k < 9; k++) turned = verify__max(turned, fabs(is.turn[k] - was.turn[k]));
    for (int k = 0; k < 3; k++) off += (is.at[k] - was.at[k]) * (is.at[k] - was.at[k]);
    if (!(sqrt(off) <= 1e-9 + 1e-7 * verify__offset(part.pose) && turned <= 3e-7))
      return "what is attached, or released, does not stand where it stood";
  }
  return NULL;
}

// How far two bodies may be from where they touch, metres; -1: they may not touch.
static double may_touch(const robot *r, const uint32_t *who) {
  const allowed *allows = (const allowed *)r->allows.items;
  double metres = -1;
  for (size_t k = 0; k < r->allows.count; k++)
    if (is_of(allows[k].pair, who)) metres = verify__max(metres, allows[k].metres);
  return metres;
}

// Takes from a motion's start and end the pieces in which a pair may touch, as the certificate says.
static const char *cut_allowed(const nsvcd_verify_part *parts, const double *radii, double metres,
                               const uint8_t *bytes, size_t size, size_t *at,
                               nsvcd_verify_motion *rest) {
  const size_t pieces = rest->pieces;
  const size_t until = (size_t)take(bytes, size, at, 4);
  const size_t from = (size_t)take(bytes, size, at, 4);
  if (*at > size) return "it ends early";
  if (until > from || from > pieces) return "two may touch in pieces that are none";
  for (int k = 0; k < 2; k++)
    if ((until > 0 && !nsvcd_verify_stays(&parts[k], radii[k], 0, until, 0, metres)) ||
        (from < pieces && !nsvcd_verify_stays(&parts[k], radii[k], from, pieces, pieces, metres)))
      return "two are farther from where they may touch than is allowed";
  rest->times += until;
  rest->points += until * rest->degree * rest->joint_count;
  rest->pieces = from - until;
  return rest->pieces ? nsvcd_verify_motion_check(rest) : NULL;
}

// Is it proven that two parts keep a distance?
static const char *check_free(request *asked, const robot_body *const *bodies,
                              const nsvcd_verify_part *parts, float clearance, const uint8_t *bytes,
                              size_t length, size_t *at) {
  const size_t room = NSVCD_VERIFY_WORKSPACE_BYTES(parts->motion->pieces + 3);
  nsvcd_verify_mover movers[2];
  nsvcd_verify_report report;
  memset(&report, 0, sizeof report);
  for (int k = 0; k < 2; k++) {
    const char *why = nsvcd_verify_part_init(bodies[k]->mesh, 1, &parts[k], &movers[k]);
    if (why) return why;
  }
  // what is round keeps its radius besides: a float, and no less
  const double sum = (double)clearance + (bodies[0]->radius + bodies[1]->radius);
  clearance = (float)sum;
  if ((double)clearance < sum) clearance = nextafterf(clearance, HUGE_VALF);
  void *workspace = allocate(room);
  const int accepted = nsvcd_verify(&movers[0], &movers[1], clearance, bytes + *at, length,
                                    workspace, room, &report);
  free(workspace);
  *at += accepted ? length : report.position;
  if (!accepted) return report.reason;
  note_claim(asked, &movers[0], &movers[1], clearance);
  return report.kind == NSVCD_VERIFY_FREE ? NULL : "a pair is not proven free";
}

static const char *check_pair(const step *s, const nsvcd_verify_motion *m, size_t pair,
                              const uint8_t *bytes, size_t size, size_t *at) {
  const robot *r = s->r;
  const uint32_t *who = (const uint32_t *)r->pairs.items + 2 * pair;
  const robot_body *bodies[2] = {(const robot_body *)r->bodies.items + who[0],
                                 (const robot_body *)r->bodies.items + who[1]};
  const double metres = may_touch(r, who);
  nsvcd_verify_motion rest = *m;
  nsvcd_verify_part parts[2];
  double radii[2];
  const char *why = NULL;
  for (int k = 0; k < 2; k++) {
    parts[k].motion = m;
    parts[k].link = bodies[k]->link;
    parts[k].base = nsvcd_verify_common(m, bodies[0]->link, bodies[1]->link);
    memcpy(parts[k].pose, bodies[k]->pose, sizeof parts[k].pose);
    radii[k] = metres >= 0 ? nsvcd_verify_radius(bodies[k]->mesh) + bodies[k]->radius : 0;
  }
  if (metres >= 0) why = cut_allowed(parts, radii, metres, bytes, size, at, &rest);
  if (why) return why;
  const size_t length = (size_t)take(bytes, size, at, 4);
  if (*at > size || length > size - *at) return "it ends early";
  if (rest.pieces == 0) return length ? "a pair that may touch all the time has a proof" : NULL;
  for (int k = 0; k < 2; k++) parts[k].motion = &rest;
  return check_free(s->asked, bodies, parts, ((const float *)r->kept.items)[pair], bytes, length,
                    at);
}

// Adds each body with each obstacle that is on another link; then, what each pair keeps: one with an
// obstacle what is asked for, or what the file says of all, if that is more. What it says of two
// bodies comes before both.
static void pair_up(robot *r, float asked) {
  const robot_body *bodies = (const robot_body *)r->bodies.items;
  const distance *distances = (const distance *)r->distances.items;
  float all = 0;
  r->pairs.count = r->own_pairs;
  for (uint32_t a = 0; a < r->bodies.count; a++) {
    for (uint32_t b = a < r->own ? (uint32_t)r->own : a + 1; b < r->bodies.count; b++) {
      if (bodies[a].link == bodies[b].link) continue;
      add_index(&r->pairs, a);
      add_index(&r->pairs, b);
    }
  }
  for (size_t k = 0; k < r->distances.count; k++)
    if (distances[k].pair[0] == EACH) all = distances[k].metres;
  r->kept.count = 0;
  for (size_t n = 0; n < r->pairs.count / 2; n++) {
    double metres = 2 * n < r->own_pairs ? 0 : all > asked ? (double)all : (double)asked;
    for (size_t k = 0; k < r->distances.count; k++)
      if (is_of(distances[k].pair, (const uint32_t *)r->pairs.items + 2 * n))
        metres = (double)distances[k].metres;
    add_float(&r->kept, metres);
  }
}

// NULL, or why it is refused. *at: the byte. Notes where the motion ends.
static const char *check_motion(step *s, const uint8_t *bytes, size_t size, size_t *at) {
  robot *r = s->r;
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
  const char *why = nsvcd_verify_motion_check(&m);
  if (!why) why = take_changes(s, &m, bytes, size, at);
  if (!why && !goes(s, &m)) why = "its motion has another start or goal";
  if (!why && !mimics(r, &m)) why = "a joint is not where the one that it mimics drives it";
  if (!why && !keeps_to(r, s->plan->of, &m)) why = "a joint moves that is not of the plan's group";
  if (!why && !keeps_axes(r, &m, s->plan->keeps)) why = "an axis leaves what it is to keep";
  if (!why) pair_up(r, s->asked->clearance);
  if (!why && take(bytes, size, at, 4) != r->pairs.count / 2) why = "it is about other pairs";
  for (size_t pair = 0; pair < r->pairs.count / 2 && !why; pair++)
    why = check_pair(s, &m, pair, bytes, size, at);
  if (!why && *at != size) why = "something follows its end";
  memcpy(s->ended, m.points + m.pieces * m.degree * m.joint_count,
         m.joint_count * sizeof *s->ended);
  free(motion);
  return why;
}

static int check_plan(step *s) {
  char *const *words = s->plan->words;
  char path[4096];
  size_t size;
  size_t at = 0;
  snprintf(path, sizeof path, "%s/%s.cert", s->asked->folder, words[1]);
  uint8_t *bytes = (uint8_t *)read_file(path, &size);
  const clock_t start = clock();
  const char *why = NULL;
  if (s->is_lost) why = "what was attached or released above is not known";
  if (s->plan->count == 3 && !s->has_ended) why = "it begins where no plan above is accepted";
  if (!bytes) why = "there is no certificate";
  if (!why) why = check_motion(s, bytes, size, &at);
  const double taken = 1e6 * (double)(clock() - start) / (double)CLOCKS_PER_SEC;
  print_line(s->asked, words[1], why, "free", bytes ? size : 0, at, taken);
  free(bytes);
  return !why;
}

// clearance NAME NAME METRES, or clearance obstacles METRES
static void add_distance(robot *r, char *const *words, size_t count) {
  distance d = {{EACH, EACH}, (float)number_of(r->path, words[count - 1])};
  if (d.metres < 0) fail(r->path, "a clearance is negative");
  if (count == 4) {
    const robot_body *bodies = (const robot_body *)r->bodies.items;
    const uint32_t names[2] = {body_named(r, words[1]), body_named(r, words[2])};
    const int is_first_own = names[0] < r->own;
    d.pair[0] = names[!is_first_own];
    d.pair[1] = names[is_first_own];
    int found = d.pair[0] < r->own && d.pair[1] >= r->own && bodies[d.pair[0]].link > 0;
    for (size_t k = 0; k + 1 < r->pairs.count; k += 2)
      found |= is_of(d.pair, (const uint32_t *)r->pairs.items + k);
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

// allow NAME NAME [METRES]
static void add_allowed(robot *r, char *const *words, size_t count) {
  allowed a = {{body_named(r, words[1]), body_named(r, words[2])}, 0.005};
  if (count == 4) a.metres = number_of(r->path, words[3]);
  if (!(a.metres >= 0)) fail(r->path, "a distance is negative");
  *(allowed *)add(&r->allows, sizeof a) = a;
}

// Does a line move the robot, as a task of its own? A path of a group does so in a `together` only.
static int is_own_task(const plan_line *line) {
  const int is_path = is_line(line, "path") || is_line(line, "curve");
  if (is_path) return line->count < 5 || strcmp(line->words[line->count - 2], "group") != 0;
  return is_line(line, "plan") || is_line(line, "together");
}

// Checks the plans among the lines of a scene, one after another, and forgets them. Only what a plan
// that is accepted comes to is relied on later: where it ends, and where it leaves what is attached.
// Returns 1 if all are accepted.
static int check_scene(robot *r, list *lines, request *asked) {
  const plan_line *first = (const plan_line *)lines->items;
  step s;
  int all = 1;
  memset(&s, 0, sizeof s);
  s.r = r;
  s.asked = asked;
  s.changes = first;
  s.end = first + lines->count;
  for (s.plan = first; s.plan < s.end; s.plan++) {
    const plan_line *line = s.plan;
    if (is_line(line, "allow")) add_allowed(r, line->words, line->count);
    s.change_count += is_line(line, "attach") || is_line(line, "release");
    if (!is_own_task(line)) continue;
    const int wanted = is_line(line, "plan") && !asked->pairs && is_wanted(asked, line->words[1]);
    s.has_ended = wanted && check_plan(&s);
    all &= !wanted || s.has_ended;
    s.is_lost |= s.change_count > 0 && !s.has_ended;
    s.change_count = 0;
    s.changes = line + 1;
  }
  lines->count = 0;
  return all;
}

// allow NAME NAME [METRES], attach NAME JOINT, release NAME
static int is_step(char *const *words, size_t n, const char *scene) {
  if (strcmp(words[0], "allow") == 0) return n == 3 || n == 4;
  if (!scene) return 0;
  return strcmp(words[0], "attach") == 0 ? n == 3 : strcmp(words[0], "release") == 0 && n == 2;
}

// Is a line a plan, a goal, a path, a curve or several together, where it may stand?
static int is_task(const robot *r, char *const *words, size_t n, const char *scene) {
  const size_t joints = r->joint_count;
  if (!scene) return 0;
  if (strcmp(words[0], "goal") == 0)
    return n == 2 + joints || (n >= 11 && strcmp(words[2], "pose") == 0);
  const size_t fields = n >= 5 && strcmp(words[n - 2], "group") == 0 ? n - 2 : n;
  int fits = strcmp(words[0], "path") == 0 && fields == 4;
  if (strcmp(words[0], "curve") == 0) fits = fields == 5 || fields == 6;
  if (strcmp(words[0], "together") == 0) fits = n >= 4;
  if (strcmp(words[0], "plan") == 0)
    fits = fields == 3 || fields == 3 + joints || fields == 3 + 2 * joints;
  return fits && strcmp(words[2], scene) == 0;
}

// Checks all plans of a planning file: the robot, then a scene, its obstacles, and plans, their goals
// and paths in it, and perhaps another scene. Returns 1 if all are accepted.
static int check_plans(const char *path, char *text, request *asked, robot *out) {
  robot r;
  char *words[MOST_WORDS];
  list lines = {NULL, 0, 0};
  const char *scene = NULL;
  size_t own_distances = 0, own_allows = 0, own_keeps = 0;
  int has_tasks = 0;  // 1: a plan or a path stands above
  int all = 1;
  memset(&r, 0, sizeof r);
  r.path = path;
  for (size_t n = next_words(&text, words, MOST_WORDS); n > 0;
       n = next_words(&text, words, MOST_WORDS)) {
    const char *word = words[0];
    if (strcmp(word, "joint") == 0 && n >= 17 && !scene) {
      add_joint(&r, words);
    } else if (strcmp(word, "mimic") == 0 && n == 5 && !scene) {
      add_mimic(&r, words);
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
      if (!scene) r.own_pairs = r.pairs.count;
      if (!scene) own_distances = r.distances.count;
      if (!scene) own_allows = r.allows.count;
      if (!scene) own_keeps = r.keeps.count;
      all &= check_scene(&r, &lines, asked);
      scene = words[1];
      has_tasks = 0;
      r.bodies.count = r.own;
      r.pairs.count = r.own_pairs;
      r.distances.count = own_distances;
      r.allows.count = own_allows;
      r.keeps.count = own_keeps;
    } else if (strcmp(word, "obstacle") == 0 && n >= 3 && scene) {
      add_body(&r, words, n);
    } else if (strcmp(word, "allow") == 0 && is_step(words, n, scene) && !scene) {
      add_allowed(&r, words, n);
    } else if (is_task(&r, words, n, scene) || is_step(words, n, scene)) {
      const int is_path = strcmp(word, "path") == 0;
      const int is_curve = strcmp(word, "curve") == 0;
      plan_line *line = (plan_line *)add(&lines, sizeof *line);
      memcpy(line->words, words, sizeof line->words);
      line->of = group_of(&r, words, n);
      line->count = n - (line->of ? 2 : 0);
      const int attaches = is_line(line, "attach");
      const int moves = attaches || is_line(line, "release");
      line->thing = moves ? body_named(&r, words[1]) : 0;
      line->link = attaches ? link_named(&r, words[2]) : 0;
      if (moves && line->thing < r.own) fail(path, "no obstacle is attached");
      line->keeps = r.keeps.count;
      has_tasks |= !is_step(words, n, scene);
      if (is_path || is_curve) {
        for (size_t k = strtoul(words[is_path ? 3 : 4], NULL, 10); k > 0; k--)
          if (next_words(&text, words, MOST_WORDS) == 0)
            fail(path, is_path ? "a path ends early" : "a curve ends early");
      }
    } else if (strcmp(word, "keep") == 0 && n == 7) {
      add_keep(&r, words);
    } else {
      fail(path, "a line is not one of a planning file, or not where it may stand");
    }
  }
  if (!scene) r.own_pairs = r.pairs.count;
  all &= check_scene(&r, &lines, asked);
  free(lines.items);
  *out = r;
  return all;
}
#endif  // NSVCD_VERIFY_PLANS_H
