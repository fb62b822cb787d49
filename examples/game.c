// game.c - a room at 60 Hz, without a screen: 50 things of 8 meshes at 4 sizes fall, fly and tumble
// among 30 that stand still, and on a floor. Every frame asks about every near pair, both moving:
// when do they touch first, if they do? Things move as far as that is proven free, bounce, slide
// and come to rest. Prints what a frame costs; draws build/game.svg.
//
//   build/game [--frames N] [--seed N] [--problems FOLDER]   the last writes the pairs asked about
//                                                            as a problem file
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define PROGRAM "game"
#include "scenery/problem_file.h"
#include "scenery/draw.h"
#include "scenery/poses.h"

#define MESHES 8
#define MOVERS 50
#define STATICS 30
#define THINGS (MOVERS + STATICS + 1)  // and the floor, the last
#define FLOOR (THINGS - 1)
#define MOST_PAIRS 4096

#define FRAME (1.0f / 60)
#define GAP 0.002f   // metres: as near as this is a contact,
#define SKIN 0.001f  // and what is nearer by this at the start does not stop a thing
#define FIRST 0.02f  // of a frame: to which contacts are timed
// of asking, moving and bouncing in a frame, at most; what is left of it then is lost
#define ROUNDS 4
#define RESTITUTION 0.3f
#define FRICTION 0.5f

typedef struct vec {
  float x, y, z;
} vec;

static vec vec_of(float x, float y, float z) {
  const vec out = {x, y, z};
  return out;
}
static vec vec_from(const float *p) {
  return vec_of(p[0], p[1], p[2]);
}
static vec vec_add(vec a, vec b) {
  return vec_of(a.x + b.x, a.y + b.y, a.z + b.z);
}
static vec vec_scale(vec a, float s) {
  return vec_of(s * a.x, s * a.y, s * a.z);
}
static vec vec_sub(vec a, vec b) {
  return vec_add(a, vec_scale(b, -1));
}
static float vec_dot(vec a, vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static vec vec_cross(vec a, vec b) {
  return vec_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static float vec_length(vec a) {
  return sqrtf(vec_dot(a, a));
}

typedef struct thing {
  size_t mesh;
  float scale, radius;  // of its bounding sphere, metres
  vec centre;           // of that, in the thing's own frame
  nsvcd_pose poses[2];  // at the beginning of a frame, and where it would be at the end
  vec velocity, spin;   // metres and radians a second
  float inverse_mass;   // 0: it stands still
  int asleep;
  float left;     // of the frame
  int supported;  // for so many frames it lies on something,
  vec support;    // whose normal this is
  vec recovery;   // metres: what it is to be moved off others by
  int pressed;    // it was nearer than the skin allows: allow it more
} thing;

typedef struct pair {
  size_t a, b;
} pair;

typedef struct world {
  shapes_mesh shapes[MESHES + 1];  // the last is the floor
  const nsvcd_body *bodies[MESHES + 1];
  thing things[THINGS];
  pair pairs[MOST_PAIRS];
  nsvcd_question questions[MOST_PAIRS];
  nsvcd_answer answers[MOST_PAIRS];
  size_t pair_count;
  void *workspace;
} world;

// ------------------------------------------------------------------------------------------ making

static int encode(shapes_mesh *shape, const nsvcd_body **body) {
  float *positions = (float *)malloc(3 * shape->vertices * sizeof(float));
  nsvcd_mesh mesh = {positions, shape->indices, shape->vertices, shape->triangles};
  if (!positions || shape->failed) return 0;
  for (size_t i = 0; i < 3 * shape->vertices; i++) positions[i] = (float)shape->positions[i];
  const nsvcd_result result = nsvcd_encode(&mesh, NULL, NULL, NULL, 0, body);
  free(positions);
  return result == NSVCD_OK;
}

static int make_meshes(world *w) {
  shapes_mug(&w->shapes[0], 0.05, 0.11, 0.006, 20);
  shapes_bowl(&w->shapes[1], 0.12, 0.07, 0.008, 24);
  shapes_torus(&w->shapes[2], 0.1, 0.035, 28, 14);
  shapes_box(&w->shapes[3], 0.2, 0.2, 0.2, 2);
  shapes_chair(&w->shapes[4], 0.2, 0.4, 0.02);
  shapes_bottle(&w->shapes[5], 0.05, 0.25, 20);
  shapes_gear(&w->shapes[6], 0.12, 0.025, 0.05, 16);
  shapes_drawer(&w->shapes[7], 0.3, 0.2, 0.12, 0.01);
  shapes_box(&w->shapes[MESHES], 8, 8, 0.2, 8);
  for (size_t k = 0; k <= MESHES; k++) {
    if (!encode(&w->shapes[k], &w->bodies[k])) return 0;
  }
  return 1;
}

static void place(world *w, size_t i, size_t mesh, float scale, float x, float y, float z,
                  const double *q) {
  thing *t = &w->things[i];
  const nsvcd_body_facts facts = nsvcd_body_describe(w->bodies[mesh]);
  memset(t, 0, sizeof *t);
  t->mesh = mesh;
  t->scale = scale;
  t->radius = scale * facts.radius;
  t->centre = vec_scale(vec_from(facts.centre), scale);
  t->poses[0].position[0] = x;
  t->poses[0].position[1] = y;
  t->poses[0].position[2] = z;
  for (size_t k = 0; k < 4; k++) t->poses[0].rotation[k] = (float)q[k];
  t->poses[1] = t->poses[0];
}

static void fill_room(world *w, size_t seed) {
  static const float scales[4] = {0.6f, 1, 1.5f, 2.2f};
  const double upright[4] = {0, 0, 0, 1};
  shapes_rng rng = {seed};
  for (size_t i = 0; i < MOVERS; i++) {  // in the air, in layers
    double q[4];
    shapes_quaternion(&rng, q);
    const float x = -1.6f + 0.8f * (float)(i % 5);
    const float y = -1.6f + 0.8f * (float)(i / 5 % 5);
    const size_t mesh = (size_t)shapes_pick(&rng, MESHES);
    const float scale = scales[shapes_pick(&rng, 4)];
    place(w, i, mesh, scale, x, y, 1.4f + 1.1f * (float)(i / 25), q);
    thing *t = &w->things[i];
    t->inverse_mass = 1 / (scale * scale * scale);
    t->velocity = vec_of((float)shapes_uniform(&rng, -2, 2), (float)shapes_uniform(&rng, -2, 2), 0);
    t->spin = vec_of((float)shapes_uniform(&rng, -4, 4), (float)shapes_uniform(&rng, -4, 4), 0);
  }
  // on the floor, and sunk into it a little: they do not ask each other
  for (size_t i = MOVERS; i < FLOOR; i++) {
    const size_t k = i - MOVERS;
    const size_t mesh = k % 2 ? 3 : 4 + 3 * (k % 4 == 0);
    const float x = -2 + 0.8f * (float)(k % 6);
    const float y = -1.6f + 0.8f * (float)(k / 6);
    place(w, i, mesh, 1 + 0.3f * (float)(k % 4), x, y, mesh == 3 ? 0.1f : 0.02f, upright);
  }
  place(w, FLOOR, MESHES, 1, 0, 0, -0.1f, upright);
}

// ------------------------------------------------------------------------------------- broad phase

static int moves(const thing *t) {
  return t->inverse_mass > 0 && !t->asleep && t->left > 0;
}

typedef struct box {
  float low[3], high[3];
  size_t thing;
} box;

static int compare_boxes(const void *a, const void *b) {
  const float x = ((const box *)a)->low[0];
  const float y = ((const box *)b)->low[0];
  return (x > y) - (x < y);
}

// The pairs whose swept spheres' boxes meet, one of which moves: boxes sorted along x, and swept.
static void find_pairs(world *w) {
  box boxes[THINGS];
  for (size_t i = 0; i < THINGS; i++) {
    const thing *t = &w->things[i];
    // the sphere, wherever it turns to
    const float reach = i == FLOOR ? 0 : t->radius + vec_length(t->centre) + GAP;
    const float *p = t->poses[0].position;
    const float *q = t->poses[1].position;
    for (int k = 0; k < 3; k++) {
      boxes[i].low[k] = fminf(p[k], q[k]) - reach;
      boxes[i].high[k] = fmaxf(p[k], q[k]) + reach;
    }
    for (int k = 0; k < 3 && i == FLOOR; k++) {
      boxes[i].low[k] = p[k] - (k < 2 ? 4 : 0.1f) - GAP;
      boxes[i].high[k] = p[k] + (k < 2 ? 4 : 0.1f) + GAP;
    }
    boxes[i].thing = i;
  }
  qsort(boxes, THINGS, sizeof *boxes, compare_boxes);
  w->pair_count = 0;
  for (size_t i = 0; i < THINGS; i++) {
    for (size_t j = i + 1; j < THINGS && boxes[j].low[0] <= boxes[i].high[0]; j++) {
      const box *a = &boxes[i];
      const box *b = &boxes[j];
      const int apart = a->low[1] > b->high[1] || b->low[1] > a->high[1] ||
                        a->low[2] > b->high[2] || b->low[2] > a->high[2];
      if (apart || (!moves(&w->things[a->thing]) && !moves(&w->things[b->thing]))) continue;
      if (w->pair_count == MOST_PAIRS) return;
      w->pairs[w->pair_count].a = a->thing;
      w->pairs[w->pair_count++].b = b->thing;
    }
  }
}

// ------------------------------------------------------------------------------------------ asking

static nsvcd_mover mover_of(const world *w, const thing *t) {
  nsvcd_mover mover;
  memset(&mover, 0, sizeof mover);
  mover.body = w->bodies[t->mesh];
  mover.poses = t->poses;
  mover.count = moves(t) ? 2 : 1;
  mover.scale = t->scale;
  return mover;
}

static nsvcd_result ask(world *w) {
  for (size_t k = 0; k < w->pair_count; k++) {
    const thing *a = &w->things[w->pairs[k].a];
    const thing *b = &w->things[w->pairs[k].b];
    nsvcd_question *q = &w->questions[k];
    memset(q, 0, sizeof *q);
    q->a = mover_of(w, a);
    q->b = mover_of(w, b);
    q->ask = NSVCD_ASK_FIRST;
    q->to_time = FIRST;
    q->clearance = GAP;
    // finer than that nobody sees: what is left undecided counts as a contact
    q->tolerance = 0.05f * GAP;
    q->skin = a->pressed || b->pressed ? 0.95f * GAP : SKIN;
  }
  return nsvcd_sweep_batch(w->questions, w->pair_count, w->workspace,
                           nsvcd_sweep_workspace_size(NULL), w->answers);
}

// ------------------------------------------------------------------------------------------ moving

static nsvcd_pose pose_after(const thing *t, float seconds) {
  nsvcd_pose out = t->poses[0];
  const float angle = vec_length(t->spin) * seconds;
  const vec axis = angle > 0 ? vec_scale(t->spin, seconds / angle) : vec_of(0, 0, 0);
  const float s = sinf(angle / 2);
  const float c = cosf(angle / 2);
  const float *q = t->poses[0].rotation;
  const vec u = vec_scale(axis, s);
  const vec v = vec_of(q[0], q[1], q[2]);
  const vec turned = vec_add(vec_cross(u, v), vec_add(vec_scale(v, c), vec_scale(u, q[3])));
  const float w = c * q[3] - vec_dot(u, v);
  const float length = sqrtf(vec_dot(turned, turned) + w * w);
  out.position[0] += seconds * t->velocity.x;
  out.position[1] += seconds * t->velocity.y;
  out.position[2] += seconds * t->velocity.z;
  out.rotation[0] = turned.x / length;
  out.rotation[1] = turned.y / length;
  out.rotation[2] = turned.z / length;
  out.rotation[3] = w / length;
  return out;
}

// A frame begins: forces.
static void begin_frame(world *w) {
  for (size_t i = 0; i < MOVERS; i++) {
    thing *t = &w->things[i];
    vec gravity = vec_of(0, 0, -9.81f);
    t->left = 1;
    if (!moves(t)) continue;
    if (t->supported > 0) {
      const float into = fminf(vec_dot(gravity, t->support), 0);
      const float speed = fminf(vec_dot(t->velocity, t->support), 0);
      gravity = vec_sub(gravity, vec_scale(t->support, into));
      t->velocity = vec_scale(vec_sub(t->velocity, vec_scale(t->support, speed)), 0.95f);
      t->spin = vec_scale(t->spin, 0.9f);
      t->supported--;
    }
    t->velocity = vec_add(t->velocity, vec_scale(gravity, FRAME));
  }
}

// Where everything would be at the end of the frame.
static size_t aim(world *w) {
  size_t count = 0;
  for (size_t i = 0; i < MOVERS; i++) {
    thing *t = &w->things[i];
    t->poses[1] = moves(t) ? pose_after(t, t->left * FRAME) : t->poses[0];
    count += moves(t) != 0;
  }
  return count;
}

// Slerp and line, as the question had it.
static nsvcd_pose pose_between(const nsvcd_pose *a, const nsvcd_pose *b, float u) {
  nsvcd_pose out;
  float dot = 0;
  float square = 0;
  float wa = 1 - u;
  float wb = u;
  for (int k = 0; k < 4; k++) dot += a->rotation[k] * b->rotation[k];
  const float sign = dot < 0 ? -1.0f : 1.0f;
  const float angle = acosf(fminf(fabsf(dot), 1));
  if (angle > 1e-3f) {
    wa = sinf((1 - u) * angle);
    wb = sinf(u * angle);
  }
  for (int k = 0; k < 4; k++) out.rotation[k] = wa * a->rotation[k] + wb * sign * b->rotation[k];
  for (int k = 0; k < 4; k++) square += out.rotation[k] * out.rotation[k];
  for (int k = 0; k < 4; k++) out.rotation[k] /= sqrtf(square);
  for (int k = 0; k < 3; k++)
    out.position[k] = a->position[k] + u * (b->position[k] - a->position[k]);
  return out;
}

static size_t root_of(size_t *parents, size_t i) {
  while (parents[i] != i) i = parents[i];
  return i;
}

// Moves everything as far as it is proven free. What is near each other moves for the same share of
// the frame, for only so is what was proven about both what they do.
static void advance(world *w) {
  size_t parents[THINGS];
  float shares[THINGS];
  for (size_t i = 0; i < THINGS; i++) {
    parents[i] = i;
    shares[i] = 1;
  }
  for (size_t k = 0; k < w->pair_count; k++) {
    const pair *p = &w->pairs[k];
    if (moves(&w->things[p->a]) && moves(&w->things[p->b]))
      parents[root_of(parents, p->a)] = root_of(parents, p->b);
  }
  for (size_t k = 0; k < w->pair_count; k++) {
    const nsvcd_answer *answer = &w->answers[k];
    const size_t mover = moves(&w->things[w->pairs[k].a]) ? w->pairs[k].a : w->pairs[k].b;
    const size_t root = root_of(parents, mover);
    // then it stays, and only its speed changes
    const int was_touching = vec_length(vec_from(answer->lift)) > 0;
    if (answer->verdict == NSVCD_FREE) continue;
    shares[root] = fminf(shares[root], was_touching ? 0 : answer->time.low);
  }
  for (size_t i = 0; i < MOVERS; i++) {
    thing *t = &w->things[i];
    const float share = shares[root_of(parents, i)];
    if (!moves(t)) continue;
    if (share > 0)
      t->poses[0] = share < 1 ? pose_between(&t->poses[0], &t->poses[1], share) : t->poses[1];
    t->left = share < 1 ? t->left * (1 - share) : 0;
  }
}

// Things sink by up to a skin into what carries them: some of the lift, less than half of the gap,
// brings them back.
static void recover(world *w) {
  for (size_t k = 0; k < w->pair_count; k++) {
    thing *a = &w->things[w->pairs[k].a];
    thing *b = &w->things[w->pairs[k].b];
    const vec lift = vec_from(w->answers[k].lift);
    a->recovery = vec_add(a->recovery, vec_scale(lift, 0.2f));
    b->recovery = vec_sub(b->recovery, vec_scale(lift, 0.2f));
  }
  for (size_t i = 0; i < MOVERS; i++) {
    thing *t = &w->things[i];
    const float length = vec_length(t->recovery);
    const float most = 0.2f * GAP;
    const vec step = vec_scale(t->recovery, length > most ? most / length : 1);
    t->recovery = vec_of(0, 0, 0);
    if (t->asleep) continue;
    t->poses[0].position[0] += step.x;
    t->poses[0].position[1] += step.y;
    t->poses[0].position[2] += step.z;
  }
}

static vec velocity_at(const thing *t, vec arm) {
  return vec_add(t->velocity, vec_cross(t->spin, arm));
}

static void push(thing *t, vec arm, vec impulse) {
  const float inertia = 0.4f * t->radius * t->radius;  // of a ball
  t->velocity = vec_add(t->velocity, vec_scale(impulse, t->inverse_mass));
  t->spin = vec_add(t->spin, vec_scale(vec_cross(arm, impulse), t->inverse_mass / inertia));
}

static void rest_on(thing *t, vec normal) {
  if (normal.z < 0.5f) return;
  t->supported = 4;
  t->support = normal;
}

// What a contact does to speeds: an impulse along its normal, and friction across.
static void respond(world *w, size_t k) {
  const nsvcd_answer *answer = &w->answers[k];
  thing *a = &w->things[w->pairs[k].a];
  thing *b = &w->things[w->pairs[k].b];
  const vec normal = vec_from(answer->nearest.normal);
  const vec point = vec_from(answer->nearest.point);
  if (answer->verdict == NSVCD_FREE || !(vec_length(normal) > 0.5f)) return;
  const vec arm_a = vec_sub(point, vec_from(a->poses[0].position));
  const vec arm_b = vec_sub(point, vec_from(b->poses[0].position));
  const vec relative = vec_sub(velocity_at(a, arm_a), velocity_at(b, arm_b));
  const float speed = vec_dot(relative, normal);
  if (speed < 0) {
    const vec turn_a = vec_cross(arm_a, normal);
    const vec turn_b = vec_cross(arm_b, normal);
    const float give_a =
        a->inverse_mass * (1 + vec_dot(turn_a, turn_a) / (0.4f * a->radius * a->radius));
    const float give_b =
        b->inverse_mass * (1 + vec_dot(turn_b, turn_b) / (0.4f * b->radius * b->radius));
    const float bounce = speed < -0.5f ? 1 + RESTITUTION : 1;
    const float impulse = -bounce * speed / (give_a + give_b);
    const vec slide = vec_sub(relative, vec_scale(normal, speed));
    const float slip = vec_length(slide);
    const float drag = slip > 0 ? fminf(FRICTION * impulse, slip / (give_a + give_b)) / slip : 0;
    const vec total = vec_sub(vec_scale(normal, impulse), vec_scale(slide, drag));
    if (a->asleep && -speed > 0.3f) a->asleep = 0;
    if (b->asleep && -speed > 0.3f) b->asleep = 0;
    push(a, arm_a, total);
    push(b, arm_b, vec_scale(total, -1));
  }
  rest_on(a, normal);
  rest_on(b, vec_scale(normal, -1));
}

static void fall_asleep(world *w) {
  for (size_t i = 0; i < MOVERS; i++) {
    thing *t = &w->things[i];
    const int slow = vec_length(t->velocity) < 0.08f && vec_length(t->spin) < 0.3f;
    if (t->supported > 0 && slow) t->asleep = 1;
    if (t->asleep) t->velocity = t->spin = vec_of(0, 0, 0);
  }
}

// --------------------------------------------------------------------------------------- reporting

typedef struct report {
  double *frame_ms, *find_ms;
  size_t frames, rounds, pairs, contacts, stuck, undecided;
  FILE *problems;  // NULL: none are written
} report;

static int compare_doubles(const void *a, const void *b) {
  const double x = *(const double *)a;
  const double y = *(const double *)b;
  return (x > y) - (x < y);
}

static void print_report(const world *w, report *r) {
  size_t asleep = 0;
  double sum = 0;
  double find = 0;
  for (size_t i = 0; i < MOVERS; i++) asleep += w->things[i].asleep != 0;
  for (size_t k = 0; k < r->frames; k++) {
    sum += r->frame_ms[k];
    find += r->find_ms[k];
  }
  qsort(r->frame_ms, r->frames, sizeof(double), compare_doubles);
  printf("%zu frames, %.1f rounds each: %.0f near pairs a frame, found in %.3f ms\n", r->frames,
         (double)r->rounds / (double)r->frames, (double)r->pairs / (double)r->frames,
         find / (double)r->frames);
  printf("asking about them: median %.2f, mean %.2f, worst %.2f ms; %.2f us a pair\n",
         r->frame_ms[r->frames / 2], sum / (double)r->frames, r->frame_ms[r->frames - 1],
         1e3 * sum / (double)r->pairs);
  printf(
      "%zu contacts, %zu of them pressed in, %zu undecided; %zu of %d things asleep at the end\n",
      r->contacts, r->stuck, r->undecided, asleep, MOVERS);
}

static int draw(const world *w) {
  static const draw_colour *const colours[4] = {&draw_blue, &draw_orange, &draw_green, &draw_cream};
  const draw_view view = {-1.0, 0.55, {0, 0, 0.3}, 150, 860, 560, 0.3};
  FILE *svg = draw_open("build/game.svg", 900, 680, "A room at 60 Hz",
                        "50 movers of 8 meshes at 4 sizes; every near pair, every frame, proven");
  if (!svg) return 0;
  draw_panel(svg, 20, 84, &view);
  draw_list list = {&view, NULL, 0, 0, 0};
  for (size_t n = 0; n < THINGS; n++) {
    const size_t i = THINGS - 1 - n;  // the floor first
    const thing *t = &w->things[i];
    const oracle_pose pose = pose_widened(&t->poses[0]);
    draw_shape(&list, &w->shapes[t->mesh], (double)t->scale, &pose,
               i == FLOOR   ? &draw_cream
               : i < MOVERS ? colours[i % 3]
                            : &draw_steel);
    if (i == FLOOR) draw_flush(svg, &list);
  }
  draw_flush(svg, &list);
  draw_panel_end(svg, &view, "where they came to rest");
  return draw_close(svg);
}

// ---------------------------------------------------------------------------------------- problems

static void write_pose(FILE *file, const nsvcd_pose *pose, const float *offset) {
  for (int k = 0; k < 3; k++) fprintf(file, "%.9g ", (double)(pose->position[k] + offset[k]));
  for (int k = 0; k < 4; k++)
    fprintf(file, "%.9g%c", (double)pose->rotation[k], k < 3 ? ' ' : '\n');
}

static FILE *open_problems(const world *w, const char *folder) {
  char path[4096];
  for (size_t k = 0; k <= MESHES; k++) {
    snprintf(path, sizeof path, "%s/mesh%zu.obj", folder, k);
    if (!shapes_write_obj(&w->shapes[k], path)) return NULL;
  }
  snprintf(path, sizeof path, "%s/game.txt", folder);
  FILE *file = fopen(path, "w");
  if (!file) return NULL;
  fprintf(file, "nsvcd-problems 1\n");
  for (size_t k = 0; k <= MESHES; k++) fprintf(file, "mesh %zu mesh%zu.obj\n", k, k);
  return file;
}

// Some of the questions, lifted as their answers say: what is left of the question is a clearance
// of GAP. One body must rest where there was a lift, as it turns with the other.
static void write_problems(FILE *file, const world *w, size_t frame) {
  const float none[3] = {0, 0, 0};
  for (size_t k = frame % 7; k < w->pair_count; k += 7) {
    const thing *a = &w->things[w->pairs[k].a];
    const thing *b = &w->things[w->pairs[k].b];
    const nsvcd_answer *answer = &w->answers[k];
    const int lifted = vec_length(vec_from(answer->lift)) > 0;
    float back[3];
    for (int i = 0; i < 3; i++) back[i] = -answer->lift[i];
    if (lifted && moves(a) && moves(b)) continue;
    const nsvcd_mover of_a = mover_of(w, a);
    const nsvcd_mover of_b = mover_of(w, b);
    fprintf(file, "problem f%zu.%zu.%d %zu %.9g %zu %.9g 0 0 0 0 0 0 1 -1 nan %zu %zu\n", frame, k,
            answer->verdict != NSVCD_FREE, a->mesh, (double)a->scale, b->mesh, (double)b->scale,
            of_a.count, of_b.count);
    for (size_t i = 0; i < of_a.count; i++)
      write_pose(file, &a->poses[i], moves(a) ? answer->lift : none);
    for (size_t i = 0; i < of_b.count; i++) write_pose(file, &b->poses[i], moves(a) ? none : back);
  }
}

// -------------------------------------------------------------------------------------------- main

// Asks about everything that is near, moves it as far as it is free, and lets what touches bounce.
static nsvcd_result play_round(world *w, report *r, size_t frame) {
  const double start = seconds();
  find_pairs(w);
  const double found = seconds();
  const nsvcd_result result = ask(w);
  r->frame_ms[frame] += 1e3 * (seconds() - found);
  r->find_ms[frame] += 1e3 * (found - start);
  if (result) return result;
  if (r->problems) write_problems(r->problems, w, frame);
  r->pairs += w->pair_count;
  advance(w);
  recover(w);
  for (size_t i = 0; i < MOVERS; i++) w->things[i].pressed = 0;
  for (size_t k = 0; k < w->pair_count; k++) {
    const nsvcd_answer *answer = &w->answers[k];
    const int was_lifted = vec_length(vec_from(answer->lift)) > 0;
    const int touches = answer->verdict != NSVCD_FREE;
    const int is_pressed = touches && !(answer->nearest.time > 0) && !was_lifted;
    w->things[w->pairs[k].a].pressed |= is_pressed;
    w->things[w->pairs[k].b].pressed |= is_pressed;
    r->contacts += touches != 0;
    r->stuck += is_pressed != 0;
    r->undecided += answer->verdict == NSVCD_UNDECIDED;
    respond(w, k);
  }
  return NSVCD_OK;
}

static int play(world *w, report *r) {
  for (size_t frame = 0; frame < r->frames; frame++) {
    begin_frame(w);
    for (size_t round = 0; round < ROUNDS && aim(w) > 0; round++) {
      const nsvcd_result result = play_round(w, r, frame);
      if (result) return complain("frame %zu: %s", frame, nsvcd_result_string(result));
      r->rounds++;
    }
    fall_asleep(w);
  }
  return 1;
}

int main(int argc, char **argv) {
  static world w;
  report r;
  memset(&r, 0, sizeof r);
  size_t seed = 2026;
  r.frames = 300;
  w.workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  if (!make_meshes(&w)) return complain("out of memory"), REFUSED;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (strcmp(argv[i], "--frames") == 0 && parse_count(argv[i + 1], 1, 100000, &r.frames))
      continue;
    if (strcmp(argv[i], "--seed") == 0 && parse_count(argv[i + 1], 1, 100000, &seed)) continue;
    if (strcmp(argv[i], "--problems") == 0 && (r.problems = open_problems(&w, argv[i + 1])) != NULL)
      continue;
    return complain("%s %s: what is that?", argv[i], argv[i + 1]), USAGE;
  }
  r.frame_ms = (double *)allocate(r.frames * sizeof(double));
  r.find_ms = (double *)allocate(r.frames * sizeof(double));
  for (size_t k = 0; k < r.frames; k++) r.frame_ms[k] = r.find_ms[k] = 0;
  fill_room(&w, seed);
  const int good = play(&w, &r);
  if (good) print_report(&w, &r);
  const int is_lost = r.problems && ferror(r.problems);
  if (r.problems && (fclose(r.problems) != 0 || is_lost))
    return complain("the problems cannot be written"), REFUSED;
  if (good && !draw(&w)) return complain("build/game.svg cannot be written"), REFUSED;
  if (good) printf("see build/game.svg\n");
  for (size_t k = 0; k <= MESHES; k++) {
    nsvcd_body_free(w.bodies[k], NULL);
    shapes_free(&w.shapes[k]);
  }
  free(w.workspace);
  free(r.frame_ms);
  free(r.find_ms);
  return good ? DONE : REFUSED;
}
