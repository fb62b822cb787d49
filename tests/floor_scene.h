// floor_scene.h - bodies over a large floor: at rest, sliding, turning, falling on it, and standing on
// it with a skin. What is right follows from the lowest of the body's vertices over the floor's
// plane, in double, from the floats that the library is given. After neuralsvcd.h, with its
// implementation.
#ifndef NSVCD_TESTS_FLOOR_SCENE_H
#define NSVCD_TESTS_FLOOR_SCENE_H

#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "mesh_of.h"

// A body, and its vertices.
typedef struct floor_prop {
  const nsvcd_body *body;
  double *vertices;  // (count, 3), as the mesh has them
  size_t count;
  double radius;  // about its origin
} floor_prop;

static floor_prop floor_prop_of(const nsvcd_mesh *mesh) {
  floor_prop out = {NULL, NULL, mesh->vertex_count, 0};
  if (nsvcd_encode(mesh, NULL, NULL, NULL, 0, &out.body)) return out;
  out.vertices = (double *)malloc(3 * out.count * sizeof(double));
  if (!out.vertices) exit(1);
  for (size_t i = 0; i < 3 * out.count; i++) out.vertices[i] = (double)mesh->positions[i];
  for (size_t i = 0; i < out.count; i++)
    out.radius = fmax(out.radius, oracle_length(out.vertices + 3 * i));
  return out;
}
static floor_prop floor_prop_of_shape(shapes_mesh *shape) {
  nsvcd_mesh mesh = mesh_of(shape);
  const floor_prop out = floor_prop_of(&mesh);
  free(mesh.positions);
  free(mesh.indices);
  shapes_free(shape);
  return out;
}
static void floor_prop_free(floor_prop *prop) {
  nsvcd_body_free(prop->body, NULL);
  free(prop->vertices);
}

// A box whose top is z = 0, its faces cut into cells; no cells: one triangle. aside: where its middle
// is, from its mesh's origin.
static floor_prop floor_of(double half, int cells, double deep, double aside) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  if (cells) {
    shapes_box(&shape, 2 * half, 2 * half, deep, cells);
  } else {
    const uint32_t a = shapes_vertex(&shape, -2 * half, -half, -deep / 2);
    const uint32_t b = shapes_vertex(&shape, 2 * half, -half, -deep / 2);
    shapes_triangle(&shape, a, b, shapes_vertex(&shape, 0, 2 * half, -deep / 2));
  }
  for (size_t i = 0; i < shape.vertices; i++) {
    shape.positions[3 * i] += aside;
    shape.positions[3 * i + 2] += cells ? -deep / 2 : deep / 2;
  }
  return floor_prop_of_shape(&shape);
}

// -------------------------------------------------------------------------------------------------
// questions

// What a body does over a floor.
typedef enum floor_act {
  FLOOR_RESTS,
  FLOOR_SLIDES,
  FLOOR_TURNS,    // flat, about the floor's normal
  FLOOR_TUMBLES,  // about any axis, above it or through it
  FLOOR_COMES,    // ends above it, or in it
  FLOOR_FALLS,    // and when does it land? A corner first, or flat
  FLOOR_FALLS_TURNING,
  FLOOR_MEASURED,  // slides; how near?
  FLOOR_STANDS,    // on it, with a skin, and slides or turns
  FLOOR_LEAVES,    // stands, and is lifted off
  FLOOR_ACTS
} floor_act;
static const char *const floor_acts[] = {"rests", "slides",        "turns",    "tumbles", "comes",
                                         "falls", "falls turning", "measured", "stands",  "leaves"};

typedef struct floor_scene {
  const floor_prop *floor, *prop;
  double half, aside;  // of the floor
  double gap;          // over the floor, or in it if negative
  double origin[3];    // of the floor, in the world
  double way;          // how far the body moves, of its size
  double skin, clearance, to, scale;
  int is_tilted;  // the floor, in the world
  floor_act act;
  // made of that
  nsvcd_pose poses[2], floor_pose;
  nsvcd_question question;
  double lengths, speed;  // all that enters; of the fastest point, at most
  double nearest;         // of the motion, in truth
  double lands;           // when, in truth; 2: never
} floor_scene;

// How high the body's lowest vertex is over the floor.
static double floor_height(const floor_scene *s, double t) {
  const oracle_pose at[2] = {pose_widened(&s->poses[0]), pose_widened(&s->poses[1])};
  const oracle_pose here = oracle_pose_at(at, s->question.a.count, t);
  const oracle_pose floor = pose_widened(&s->floor_pose);
  double m[9], from[3], up[3], turned[3];
  double least = DBL_MAX;
  oracle_matrix(floor.rotation, m);
  for (int k = 0; k < 3; k++) up[k] = m[3 * k + 2];
  oracle_sub(here.position, floor.position, from);
  oracle_matrix(here.rotation, m);
  oracle_rotate_back(m, up, turned);
  for (size_t i = 0; i < s->prop->count; i++)
    least = fmin(least, oracle_dot(turned, s->prop->vertices + 3 * i));
  return (double)(float)s->scale * least + oracle_dot(up, from);
}

// The least of that over the motion, and when it is 0 first.
static void floor_find_truth(floor_scene *s) {
  const int steps = s->act == FLOOR_TUMBLES || s->act == FLOOR_FALLS_TURNING ? 400 : 1;
  double before = floor_height(s, 0);
  double at = 0;
  s->nearest = before;
  s->lands = before <= 0 ? 0 : 2;
  for (int i = 1; i <= steps; i++) {
    const double here = floor_height(s, (double)i / steps);
    double low = (double)(i - 1) / steps;
    double high = (double)i / steps;
    for (int k = 0; k < 60 && here <= 0 && s->lands > 1; k++) {
      const double middle = 0.5 * (low + high);
      *(floor_height(s, middle) > 0 ? &low : &high) = middle;
    }
    if (here <= 0 && s->lands > 1) s->lands = high;
    if (here < s->nearest) at = (double)i / steps;
    s->nearest = fmin(s->nearest, here);
  }
  double low = fmax(at - 1.0 / steps, 0);
  double high = fmin(at + 1.0 / steps, 1);
  for (int k = 0; k < 60 && steps > 1; k++) {  // it is lowest between
    const double third = (high - low) / 3;
    const double first = floor_height(s, low + third);
    const double second = floor_height(s, high - third);
    *(first < second ? &high : &low) = first < second ? high - third : low + third;
    s->nearest = fmin(s->nearest, fmin(first, second));
  }
}

static void floor_turn(const double *axis, double angle, oracle_pose *pose) {
  double turn[4], q[4];
  oracle_axis_angle(axis, angle, turn);
  oracle_quat_mul(turn, pose->rotation, q);
  memcpy(pose->rotation, q, sizeof q);
}

// The poses, over the floor, as far off as `up` says at the start and the end.
static void floor_place(floor_scene *s, const oracle_pose *local, const double *up) {
  const oracle_pose floor = pose_widened(&s->floor_pose);
  for (int n = 0; n < 2; n++) {
    oracle_pose here = local[n];
    here.position[2] += up[n];
    const oracle_pose world = oracle_compose(&floor, &here);
    s->poses[n] = pose_rounded(&world);
  }
}

// All that follows from what is set.
static void floor_make(floor_scene *s, shapes_rng *rng) {
  const double up[3] = {0, 0, 1};
  const double size = s->prop->radius * s->scale;
  const int falls = s->act >= FLOOR_COMES && s->act <= FLOOR_FALLS_TURNING;
  const int moves = s->act != FLOOR_RESTS;
  const double none[4] = {0, 0, 0, 1};
  oracle_pose floor, local[2];
  double axis[3], rises[2] = {0, 0};
  memcpy(floor.position, s->origin, sizeof s->origin);
  memcpy(floor.rotation, none, sizeof none);
  if (s->is_tilted) shapes_quaternion(rng, floor.rotation);
  s->floor_pose = pose_rounded(&floor);
  for (int k = 0; k < 2; k++) local[0].position[k] = s->half * shapes_uniform(rng, -0.4, 0.4);
  local[0].position[0] += s->aside;
  local[0].position[2] = 0;
  memcpy(local[0].rotation, none, sizeof none);
  floor_turn(up, shapes_uniform(rng, -3, 3), &local[0]);
  shapes_direction(rng, axis);
  if (s->act == FLOOR_TUMBLES || (falls && shapes_pick(rng, 2))) floor_turn(axis, 2, &local[0]);
  local[1] = local[0];
  if (moves && s->act != FLOOR_LEAVES && !falls) {
    const double angle = shapes_uniform(rng, -3, 3);
    local[1].position[0] += s->way * size * cos(angle);
    local[1].position[1] += s->way * size * sin(angle);
  }
  if (s->act == FLOOR_TURNS || (s->act == FLOOR_STANDS && shapes_pick(rng, 2)))
    floor_turn(up, shapes_uniform(rng, -2.5, 2.5), &local[1]);
  shapes_direction(rng, axis);
  const int tumbles = s->act == FLOOR_TUMBLES || s->act == FLOOR_FALLS_TURNING;
  if (tumbles) floor_turn(axis, shapes_uniform(rng, 0.5, 2.5), &local[1]);
  memset(&s->question, 0, sizeof s->question);
  s->question.a.count = moves ? 2 : 1;
  floor_place(s, local, rises);
  if (falls)
    s->nearest = floor_height(s, 1);
  else
    floor_find_truth(s);
  rises[0] = rises[1] = s->gap - s->nearest;
  if (falls) rises[0] += s->way * size * (s->act == FLOOR_FALLS_TURNING ? 8 : 1);
  if (s->act == FLOOR_LEAVES) rises[1] += s->way * size;
  floor_place(s, local, rises);
  floor_find_truth(s);
  const double fall = fabs(rises[1] - rises[0]);
  s->speed = falls ? fall : s->way * size;
  if (tumbles) s->speed += 2.5 * size;
  s->lengths = 3 * s->half + fabs(s->aside) + 3 * size + s->speed + s->clearance;
  nsvcd_question *q = &s->question;
  q->a.body = s->prop->body;
  q->a.poses = s->poses;
  q->a.scale = (float)s->scale;
  q->b.body = s->floor->body;
  q->b.poses = &s->floor_pose;
  q->b.count = 1;
  q->clearance = (float)s->clearance;
  if (s->act == FLOOR_STANDS || s->act == FLOOR_LEAVES) q->slop = (float)s->skin;
  if (falls && s->act != FLOOR_COMES) q->ask = NSVCD_ASK_FIRST;
  if (s->act == FLOOR_MEASURED) q->ask = NSVCD_ASK_DISTANCE;
  if (q->ask) q->to = (float)s->to;
}

// A prop over a floor of this half side, whose middle is so far aside of its own origin, and that so
// far away from the world's.
static floor_scene floor_under(const floor_prop *floor, const floor_prop *prop, double half,
                               double aside, double away) {
  floor_scene s;
  memset(&s, 0, sizeof s);
  s.floor = floor;
  s.prop = prop;
  s.half = half;
  s.aside = aside;
  s.origin[0] = away;
  s.origin[1] = -away;
  return s;
}

// The i-th of many: every act, gaps of 10 um to 10 mm both ways; the floor is set.
static void floor_draw(floor_scene *s, shapes_rng *rng, size_t i) {
  s->act = (floor_act)(i % FLOOR_ACTS);
  s->gap = pow(10, -2 - (double)(i / FLOOR_ACTS % 4)) * (shapes_pick(rng, 2) ? 1 : -1);
  s->scale = shapes_pick(rng, 2) ? 1 : shapes_uniform(rng, 0.5, 2);
  s->way = shapes_uniform(rng, 0.2, 2);
  s->is_tilted = shapes_pick(rng, 3) == 0;
  s->to = 1e-6;
  s->skin = 1e-3;
  if (s->act == FLOOR_FALLS || s->act == FLOOR_FALLS_TURNING) s->gap = -0.1;
  // flush, or a little in; or more than the skin
  if (s->act == FLOOR_STANDS || s->act == FLOOR_LEAVES)
    s->gap = shapes_pick(rng, 4) ? -0.5 * fabs(s->gap) : 0;
  floor_make(s, rng);
}

// -------------------------------------------------------------------------------------------------
// answers

typedef struct floor_tally {
  size_t asked, open, wrong;
  double first;  // how far a contact that was told is from the truth, metres
} floor_tally;

// What is wrong with it, NULL if nothing is. What is left open is not wrong.
static const char *floor_fault(const floor_scene *s, const nsvcd_answer *answer, double *first) {
  const double epsilon = 1e-9 * s->lengths;
  const double rounded = 1.2e-7 * s->speed;  // a time in float
  const double depth = -s->nearest;
  const double gap = s->nearest - (double)s->question.clearance;
  const double skin = (double)s->question.slop;
  const int ask = s->question.ask;
  *first = 0;
  if (skin > 0) {
    // what comes to touch later is no contact at the start
    if (floor_height(s, 0) > 0.04 * skin) return NULL;
    const int is_free = depth < 0.95 * skin;
    if (answer->verdict == NSVCD_UNDECIDED || fabs(depth - skin) < 0.06 * skin) return NULL;
    if (is_free != (answer->verdict == NSVCD_FREE)) return is_free ? "stands" : "is pressed in";
    const double tells = (double)answer->depth;
    const double true_depth = fmax(-floor_height(s, 0), 0);
    return is_free && fabs(tells - true_depth) > 0.05 * true_depth + 1e-6 ? "its depth" : NULL;
  }
  if (fabs(gap) <= epsilon || answer->verdict == NSVCD_UNDECIDED) return NULL;
  if ((gap > 0) != (answer->verdict == NSVCD_FREE)) return "verdict";
  if (ask == NSVCD_ASK_DISTANCE && gap > 0) {
    const double low = (double)answer->distance.low;
    const double high = (double)answer->distance.high;
    if (low > s->nearest + epsilon || high < s->nearest - epsilon) return "bracket";
  }
  if (ask != NSVCD_ASK_FIRST || answer->verdict != NSVCD_HIT) return NULL;
  if ((double)answer->time.low * s->speed > s->lands * s->speed + rounded + epsilon)
    return "too late";
  const double high = floor_height(s, (double)answer->time.high);
  const double now = floor_height(s, fmax((double)answer->time.high * (1 - 1.2e-7), 0));
  if (s->lands > 0) *first = high > 0 ? high : now < 0 ? -now : 0;
  return high > s->to + epsilon ? "in contact above the floor" : NULL;
}

// Is all that was asked answered?
static int floor_is_decided(const floor_scene *s, const nsvcd_answer *answer) {
  if (answer->verdict == NSVCD_UNDECIDED || answer->why) return 0;
  const double wide = (double)answer->distance.high - (double)answer->distance.low;
  const double late = (double)(answer->time.high - answer->time.low) * s->speed;
  const double allowed = s->to * 1.01 + 1e-9 * s->lengths;
  if (s->question.ask == NSVCD_ASK_DISTANCE && answer->verdict == NSVCD_FREE)
    return wide <= allowed + 4e-6 * s->nearest;
  return s->question.ask != NSVCD_ASK_FIRST || late <= allowed + 1e-6 * s->speed;
}

static void floor_ask(floor_scene *s, void *workspace, size_t size, int tells, floor_tally *sum) {
  nsvcd_answer answer;
  double first = 0;
  const nsvcd_result result = nsvcd_sweep(&s->question, workspace, size, &answer);
  const char *fault = result ? nsvcd_result_string(result) : floor_fault(s, &answer, &first);
  const int is_open = !fault && !floor_is_decided(s, &answer);
  sum->asked++;
  sum->wrong += fault != NULL;
  sum->open += (size_t)is_open;
  sum->first = fmax(sum->first, first);
  if (!(fault || is_open) || sum->wrong + sum->open > (size_t)tells) return;
  printf("  %s: %s; half %g m, size %g m, gap %.9g m, nearest %.9g m, lands %.9g\n",
         floor_acts[s->act], fault ? fault : "left open", s->half, s->prop->radius * s->scale,
         s->gap, s->nearest, s->lands);
  if (result) return;
  printf("    %s, why %d, time %.9g to %.9g, distance %.9g to %.9g, depth %g, work %zu\n",
         nsvcd_verdict_string(answer.verdict), (int)answer.why, (double)answer.time.low,
         (double)answer.time.high, (double)answer.distance.low, (double)answer.distance.high,
         (double)answer.depth, answer.work);
}

#endif
