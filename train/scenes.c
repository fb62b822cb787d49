// scenes.c - the training set: procedural bodies as the library encodes them, motions that nearly
// touch, their verdicts by proof, and what the decoder sees of the pairs that the search leaves.
//
//   build/scenes FOLDER --seed S --meshes M --groups G [--threads T]
//
// One group is GROUP_BODIES bodies, drawn anew from the M meshes, and GROUP_PROBLEMS problems among
// them. A problem comes about like this:
//   1. a mesh moves along a smooth random motion; the other is put somewhere about it, or under it;
//   2. it goes on in a random direction (down, where it is to rest) until it is between FREE and
//      HIT, found by bisection, and proven free with a least distance of some tenth of a millimetre;
//   3. from there it goes on along the line between the nearest points, to a gap or a depth that is
//      drawn, in equal share. The proof says which it is. Free: the margin is the least distance, by
//      proof. Hit: the way that it went beyond contact, which undoes it: no less than the depth;
//   4. the network's own search finds the pairs, of which the PAIRS deepest are kept. Where there
//      are none, planes decide, and the problem teaches nothing.
// What is undecided, or nearer to contact than LEAST_MARGIN, is drawn again.
//
// The folder gets arrays of little-endian numbers; B bodies are all meshes at all SIZES:
//   bodies.i32    (B + 1)          first patch of each body
//   points.i16    (patches, POINTS, 3)  samples about the centre over the radius, in 1/32767
//   normals.i8    (patches, POINTS, 3)  in 1/127
//   groups.i32    (G, GROUP_BODIES)     bodies
//   slots.i32     (P, PAIRS, 2)    patches counted through the bodies of the group, the larger one
//                                  first; -1: no pair
//   turns.f16     (P, PAIRS, 2, 9) matrices, from the bodies' frames to the pair's; rows
//   facts.f16     (P, PAIRS, FACTS)
//   reach.f32     (P, PAIRS)       sum of the radii, metres
//   nearest.i8    (P)              the pair that owns the nearest points, or -1
//   margin.f32    (P)              metres; hits are negative
//   kind.i8       (P)
#define NEURALSVCD_IMPLEMENTATION
#define NSVCD_STATIC
#define NSVCD_NO_DISPATCH
#define NSVCD_NO_GRADIENT
#include "../neuralsvcd.h"

#include <pthread.h>

#include "../tests/bench/set_shapes.h"

#define GROUP_BODIES 40
#define GROUP_PROBLEMS 1024
#define PAIRS 24
#define POINTS 32
#define POSES 33
#define LEAST_MARGIN 3e-5  // metres
static const size_t sizes[] = {32, 64, 128, 256, 512};
#define SIZES (sizeof sizes / sizeof *sizes)

// ---- bodies

typedef enum family { SOLID, HOLLOW, RESTING, FLOOR, SHELL, FAMILIES } family;
static const size_t shares[FAMILIES] = {50, 16, 14, 14, 6};  // per cent
// of a group: bodies of each family, and of what size the k-th of a family is
static const size_t in_group[FAMILIES] = {22, 6, 5, 4, 3};
static const size_t size_of[] = {4, 3, 2, 3, 4, 1, 3, 0, 4, 2};

typedef struct model {
  family family;
  shapes_mesh shape;
  set_floor floor;
  const nsvcd_body *proof, *network[SIZES];
  int16_t *points[SIZES];
  int8_t *normals[SIZES];
} model;

// Stretches and shears a mesh, or twists and bends it, where it has vertices enough for that.
static void deform(shapes_mesh *mesh, shapes_rng *rng) {
  double m[9];
  double wave[2][4];
  const double strong = shapes_uniform(rng, 0, 0.35);
  for (int i = 0; i < 9; i++) m[i] = (i % 4 == 0) + strong * shapes_normal(rng);
  for (int n = 0; n < 2; n++) {
    shapes_direction(rng, wave[n]);
    wave[n][3] = shapes_uniform(rng, 0, 6);
  }
  const double bend = mesh->vertices > 60 && shapes_pick(rng, 2) ? shapes_uniform(rng, 0, 0.05) : 0;
  const double det = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
                     m[2] * (m[3] * m[7] - m[4] * m[6]);
  if (!(det > 0.1)) return;  // neither flat nor inside out
  for (size_t i = 0; i < mesh->vertices; i++) {
    double *p = mesh->positions + 3 * i;
    double q[3];
    for (int k = 0; k < 3; k++) q[k] = m[3 * k] * p[0] + m[3 * k + 1] * p[1] + m[3 * k + 2] * p[2];
    const double *u = wave[0];
    const double phase = 12 * (u[0] * q[0] + u[1] * q[1] + u[2] * q[2]) + u[3];
    for (int k = 0; k < 3; k++) p[k] = q[k] + bend * sin(phase) * wave[1][k];
  }
}

static void shape_of(model *out, shapes_rng *rng, family family) {
  shapes_mesh *mesh = &out->shape;
  out->family = family;
  if (family == SOLID) {
    shapes_random_solid(mesh, rng, SET_EXTENT);
    if (shapes_pick(rng, 2)) deform(mesh, rng);
  } else if (family == HOLLOW) {
    shapes_random_hollow(mesh, rng, shapes_pick(rng, SHAPES_HOLLOWS), SET_EXTENT);
    if (shapes_pick(rng, 3) == 0) deform(mesh, rng);
  } else if (family == RESTING) {
    set_resting(mesh, rng, shapes_pick(rng, SET_RESTING));
  } else if (family == FLOOR) {
    out->floor = set_make_floor(mesh, rng, shapes_pick(rng, SET_FLOORS));
    return;
  } else {
    const int round = shapes_pick(rng, 3);
    const double wall = shapes_uniform(rng, 0.04, 0.12);
    const double y = shapes_uniform(rng, 0.7, 1);
    const double z = shapes_uniform(rng, 0.7, 1);
    shapes_shell(mesh, 1, y, z, wall, round > 0, 24 + 4 * shapes_pick(rng, 4));
  }
  shapes_fit(mesh, SET_EXTENT);
}

// What the encoder sees of a body: POINTS samples of each of its patches.
static int show_patches(const nsvcd_mesh *mesh, const nsvcd_body *body, size_t wanted,
                        int16_t *points, int8_t *normals) {
  nsvcd__arena arena = nsvcd__arena_of(NULL);
  nsvcd__patches patches;
  if (nsvcd__patches_build(mesh, wanted, 1, &arena, &patches)) return 0;
  size_t found = 0;
  for (size_t i = 0; i < body->patches; i++) {
    const nsvcd__sphere ball = nsvcd__sphere_of(nsvcd__body_patches(body), i);
    size_t n = 0;
    for (; n < patches.count; n++) {
      const nsvcd__f3 c = patches.centres[n];
      if (!(c.x < ball.centre.x || c.x > ball.centre.x || c.y < ball.centre.y ||
            c.y > ball.centre.y || c.z < ball.centre.z || c.z > ball.centre.z))
        break;
    }
    if (n == patches.count) break;
    const size_t first = patches.offsets[n];
    const size_t count = patches.offsets[n + 1] - first;
    for (size_t k = 0; k < POINTS; k++) {
      const size_t s = first + k * (count > POINTS ? count : POINTS) / POINTS % count;
      const nsvcd__f3 at = nsvcd__f3_sub(patches.samples[s], ball.centre);
      const float u[3] = {at.x, at.y, at.z};
      float normal[3];
      nsvcd__f3_store(patches.normals[s], normal);
      for (size_t c = 0; c < 3; c++) {
        const float over = u[c] / fmaxf(ball.radius, 1e-9f);
        points[3 * (POINTS * i + k) + c] = (int16_t)lrintf(32767 * fminf(fmaxf(over, -1), 1));
        normals[3 * (POINTS * i + k) + c] = (int8_t)lrintf(127 * normal[c]);
      }
    }
    found++;
  }
  const int all = found == body->patches;
  nsvcd__arena_free(&arena);
  return all;
}

static int model_make(model *out, shapes_rng *rng, family family) {
  memset(out, 0, sizeof *out);
  shape_of(out, rng, family);
  const shapes_mesh *shape = &out->shape;
  nsvcd_mesh mesh;
  mesh.positions = (float *)malloc(3 * shape->vertices * sizeof(float));
  mesh.indices = shape->indices;
  mesh.vertex_count = shape->vertices;
  mesh.triangle_count = shape->triangles;
  for (size_t i = 0; i < 3 * shape->vertices; i++) mesh.positions[i] = (float)shape->positions[i];
  int ok = !nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &out->proof);
  for (size_t n = 0; ok && n < SIZES; n++) {
    nsvcd_encode_options options;
    memset(&options, 0, sizeof options);
    options.patches = sizes[n];
    options.no_triangles = 1;
    ok = !nsvcd_encode(&mesh, &options, NULL, NULL, 0, &out->network[n]);
    if (!ok) break;
    const size_t patches = out->network[n]->patches;
    out->points[n] = (int16_t *)calloc(3 * POINTS * patches, sizeof(int16_t));
    out->normals[n] = (int8_t *)calloc(3 * POINTS * patches, 1);
    ok = show_patches(&mesh, out->network[n], sizes[n], out->points[n], out->normals[n]);
  }
  free(mesh.positions);
  return ok;
}

// ---- problems

typedef enum kind { OPEN, INTO, ANY, ON_FLOOR, ON_FACE, CAVITY, KINDS } kind;
static const int kind_shares[KINDS] = {38, 20, 14, 12, 10, 6};  // per cent

typedef struct problem {
  const model *models[2];  // the first one moves
  size_t body[2];          // of the group
  size_t size[2];
  double scale[2];
  nsvcd_pose poses[POSES];  // the other rests at the origin
  size_t count;
  double swell;
  kind kind;
  double margin;
} problem;

typedef struct worker {
  shapes_rng rng;
  void *workspace;
  size_t workspace_size;
  double *path;  // (POSES, 7), before it is moved
} worker;

static double log_uniform(shapes_rng *rng, double low, double high) {
  return low * exp(shapes_uniform(rng, 0, log(high / low)));
}

static void multiply(const double *a, const double *b, double *out) {  // quaternions x y z w
  const double q[4] = {a[3] * b[0] + b[3] * a[0] + a[1] * b[2] - a[2] * b[1],
                       a[3] * b[1] + b[3] * a[1] + a[2] * b[0] - a[0] * b[2],
                       a[3] * b[2] + b[3] * a[2] + a[0] * b[1] - a[1] * b[0],
                       a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
  memcpy(out, q, sizeof q);
}
static void about(const double *axis, double angle, double *out) {
  for (int k = 0; k < 3; k++) out[k] = sin(angle / 2) * axis[k];
  out[3] = cos(angle / 2);
}
// The rotation that takes unit vector a to b.
static void from_to(const double *a, const double *b, double *out) {
  const double w = 1 + a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  if (w < 1e-6) {
    const double x[3] = {fabs(a[0]) < 0.9, fabs(a[0]) >= 0.9, 0};
    double axis[3];
    for (int k = 0; k < 3; k++)
      axis[k] = a[(k + 1) % 3] * x[(k + 2) % 3] - a[(k + 2) % 3] * x[(k + 1) % 3];
    const double n = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    for (int k = 0; k < 3; k++) axis[k] /= n;
    about(axis, SHAPES_PI, out);
    return;
  }
  for (int k = 0; k < 3; k++)
    out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  out[3] = w;
  const double n = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2] + w * w);
  for (int k = 0; k < 4; k++) out[k] /= n;
}

// A smooth path of a length, its middle at the origin, while it turns by an angle about an axis
// that turns itself: (POSES, 7).
static void random_path(shapes_rng *rng, double length, double angle, double *path) {
  double control[4][3], axis[3], drift[3], start[4];
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    const double common = shapes_normal(rng);
    double at = 0;
    for (int n = 0; n < 4; n++) control[n][k] = at += common + 0.8 * shapes_normal(rng);
  }
  shapes_direction(rng, axis);
  for (int k = 0; k < 3; k++) drift[k] = 0.4 * shapes_normal(rng);
  shapes_quaternion(rng, start);
  for (int n = 0; n < POSES; n++) {
    const double t = n / (POSES - 1.0);
    const double s = 1 - t;
    const double b[4] = {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
    double *p = path + 7 * n;
    double now[3], turn[4];
    double norm = 0;
    for (int k = 0; k < 3; k++) {
      p[k] =
          b[0] * control[0][k] + b[1] * control[1][k] + b[2] * control[2][k] + b[3] * control[3][k];
      now[k] = axis[k] + t * drift[k];
      norm += now[k] * now[k];
    }
    for (int k = 0; k < 3; k++) now[k] /= sqrt(norm);
    about(now, angle * t, turn);
    multiply(turn, start, p + 3);
    if (n > 0) sum += sqrt(pow(p[0] - p[-7], 2) + pow(p[1] - p[-6], 2) + pow(p[2] - p[-5], 2));
  }
  const double scale = length / fmax(sum, 1e-9);
  double middle[3];
  memcpy(middle, path + 7 * (POSES / 2), sizeof middle);
  for (int n = 0; n < POSES; n++)
    for (int k = 0; k < 3; k++) path[7 * n + k] = scale * (path[7 * n + k] - middle[k]);
}

// The poses of a problem: its path, moved by `offset`.
static void put(problem *p, const double *path, const double *offset) {
  for (size_t n = 0; n < p->count; n++) {
    for (int k = 0; k < 3; k++)
      p->poses[n].position[k] = (float)(path[7 * n + (size_t)k] + offset[k]);
    for (int k = 0; k < 4; k++) p->poses[n].rotation[k] = (float)path[7 * n + 3 + (size_t)k];
  }
}

static nsvcd_question question_of(const problem *p, int network) {
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  q.a.body = network ? p->models[0]->network[p->size[0]] : p->models[0]->proof;
  q.b.body = network ? p->models[1]->network[p->size[1]] : p->models[1]->proof;
  q.a.poses = p->poses;
  q.a.count = p->count;
  q.a.scale = (float)p->scale[0];
  q.b.scale = (float)p->scale[1];
  return q;
}

static nsvcd_verdict ask(const problem *p, worker *w, nsvcd_ask what, nsvcd_answer *answer) {
  nsvcd_question q = question_of(p, 0);
  q.ask = what;
  q.work = 20000;
  if (what == NSVCD_ASK_DISTANCE) q.to = 1e-5f;
  if (nsvcd_sweep(&q, w->workspace, w->workspace_size, answer)) return NSVCD_UNDECIDED;
  return answer->verdict;
}

static void bounds_of(const model *m, double scale, double *low, double *high) {
  shapes_bounds(&m->shape, low, high);
  for (int k = 0; k < 3; k++) {
    low[k] *= scale;
    high[k] *= scale;
  }
}

// A random face of a model by area: its unit normal.
static void random_face(const model *m, shapes_rng *rng, double *normal) {
  const shapes_mesh *s = &m->shape;
  double best = -1;
  for (int tries = 0; tries < 6; tries++) {  // the largest of six
    const uint32_t *t = s->indices + 3 * (shapes_next(rng) % s->triangles);
    const double *a = s->positions + 3 * t[0];
    const double *b = s->positions + 3 * t[1];
    const double *c = s->positions + 3 * t[2];
    double n[3];
    for (int k = 0; k < 3; k++) {
      const int i = (k + 1) % 3;
      const int j = (k + 2) % 3;
      n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
    const double area = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(area > best) || !(area > 0)) continue;
    best = area;
    for (int k = 0; k < 3; k++) normal[k] = n[k] / area;
  }
  if (best < 0) shapes_direction(rng, normal);
}

// Puts a body down: face to face, in the world's or the fixed body's direction `up`. It stands,
// slides, is set down or lifted. offset: above the fixed one.
static void path_on(problem *p, shapes_rng *rng, const double *up, double *path, double *offset) {
  double face[3], down[3], lay[4], spin[4], tilt[4], across[3];
  double low[3], high[3];
  const model *mover = p->models[0];
  const model *base = p->models[1];
  for (int k = 0; k < 3; k++) down[k] = -up[k];
  if (mover->family == RESTING && shapes_pick(rng, 4)) {
    const double z[3] = {0, 0, shapes_pick(rng, 3) ? -1 : 1};
    memcpy(face, z, sizeof face);
  } else {
    random_face(mover, rng, face);
  }
  from_to(face, down, lay);
  about(up, shapes_uniform(rng, 0, 2 * SHAPES_PI), spin);
  multiply(spin, lay, lay);
  if (shapes_pick(rng, 3) == 0) {  // not quite
    shapes_direction(rng, across);
    about(across, log_uniform(rng, 1e-4, 0.05), tilt);
    multiply(tilt, lay, lay);
  }
  double norm = 0;
  shapes_direction(rng, across);
  const double along = across[0] * up[0] + across[1] * up[1] + across[2] * up[2];
  for (int k = 0; k < 3; k++) across[k] -= along * up[k];
  for (int k = 0; k < 3; k++) norm += across[k] * across[k];
  for (int k = 0; k < 3; k++) across[k] /= sqrt(fmax(norm, 1e-12));
  const int way = shapes_pick(rng, 5);
  const double slide = way < 3 ? log_uniform(rng, 0.002, 0.2) : shapes_pick(rng, 2) * 0.03;
  const double rise = way < 2 ? 0 : log_uniform(rng, 0.002, 0.1) * (way % 2 ? 1 : 0);
  const double yaw = shapes_pick(rng, 2) ? shapes_uniform(rng, 0, 1.5) : 0;
  const int set_down = shapes_pick(rng, 2);
  p->count = way == 0 ? 1 : POSES;
  for (size_t n = 0; n < p->count; n++) {
    const double t = (double)n / (POSES - 1.0);
    double *q = path + 7 * n;
    about(up, yaw * t, spin);
    multiply(spin, lay, q + 3);
    for (int k = 0; k < 3; k++)
      q[k] = slide * (t - 0.5) * across[k] + rise * (set_down ? 1 - t : t) * up[k];
  }
  bounds_of(base, p->scale[1], low, high);
  for (int k = 0; k < 3; k++) {
    const double middle = 0.5 * (low[k] + high[k]);
    offset[k] = middle + shapes_uniform(rng, -0.55, 0.55) * (high[k] - low[k]);
  }
  const double height = offset[0] * up[0] + offset[1] * up[1] + offset[2] * up[2];
  const double above = (p->scale[0] + p->scale[1]) * SET_EXTENT * 0.9;
  for (int k = 0; k < 3; k++) offset[k] += (above - height) * up[k];
}

static size_t body_of_family(shapes_rng *rng, family family) {
  size_t first = 0;
  for (int f = 0; f < (int)family; f++) first += in_group[f];
  return first + shapes_next(rng) % in_group[family];
}

// Where the moving body's path is, and the unit vector along which it is moved.
typedef struct transform {
  double offset[3], direction[3];
} transform;

// Moves the path by the offset and so much along the direction.
static void put_at(problem *p, const double *path, const transform *place, double along) {
  double offset[3];
  for (int k = 0; k < 3; k++) offset[k] = place->offset[k] + along * place->direction[k];
  put(p, path, offset);
}

static int is_upright(const problem *p) {
  return p->kind == ON_FLOOR || p->kind == ON_FACE;
}
static double extent_of(const problem *p, size_t n) {
  return p->scale[n] * SET_EXTENT;
}

// Draws the kind, the bodies, their sizes, and of the path its length and how far it turns. 0: one
// body was drawn twice.
static int problem_draw(problem *p, shapes_rng *rng, const model *const *models,
                        const size_t *body_sizes, double *length, double *angle) {
  static const family families[KINDS][2] = {{SOLID, SOLID},   {SOLID, HOLLOW}, {SOLID, SOLID},
                                            {RESTING, FLOOR}, {SOLID, SOLID},  {SOLID, SHELL}};
  int at = shapes_pick(rng, 100);
  p->kind = OPEN;
  while (at >= kind_shares[p->kind]) at -= kind_shares[p->kind], p->kind = (kind)(p->kind + 1);
  for (size_t n = 0; n < 2; n++) {
    family f = families[p->kind][n];
    if (f == SOLID && shapes_pick(rng, 8) == 0) f = shapes_pick(rng, 2) ? RESTING : HOLLOW;
    if (f == RESTING && shapes_pick(rng, 4) == 0) f = SOLID;
    p->body[n] = body_of_family(rng, f);
    p->size[n] = body_sizes[p->body[n]];
    p->models[n] = models[p->body[n]];
  }
  if (p->body[0] == p->body[1]) return 0;
  const int is_small = p->kind == INTO || p->kind == CAVITY;
  double size = shapes_uniform(rng, 0.1, 0.4);
  if (is_small) size = shapes_uniform(rng, 0.02, 0.1);
  if (p->kind == ANY || is_upright(p)) size = log_uniform(rng, 0.02, 0.4);
  p->scale[0] = size / SET_EXTENT;
  size = p->kind == ANY ? log_uniform(rng, 0.05, 0.4)
                        : shapes_uniform(rng, p->kind == OPEN ? 0.1 : 0.15, 0.45);
  p->scale[1] = size / SET_EXTENT;
  *length = shapes_uniform(rng, 0.05, 0.6);
  if (is_small) *length = shapes_uniform(rng, 0.02, 0.3);
  if (p->kind == ANY) *length = log_uniform(rng, 0.0005, 0.4);
  *angle = shapes_uniform(rng, 0, 2.1);
  if (p->kind == ANY) *angle = shapes_pick(rng, 5) ? shapes_uniform(rng, 0, 3.1) : 0;
  p->count = p->kind == ANY && shapes_pick(rng, 6) == 0 ? 1 : POSES;
  const int swelling = shapes_pick(rng, 10);
  p->swell = swelling < 8 ? 0.25 : 1;
  if (swelling < 6) p->swell = swelling < 4 ? 0 : log_uniform(rng, 0.001, 0.05);
  return 1;
}

// A path, somewhere about the other body or above it, and a direction in which to go from there.
static void problem_place(problem *p, shapes_rng *rng, double length, double angle, double *path,
                          transform *place) {
  const model *other = p->models[1];
  double low[3], high[3];
  shapes_direction(rng, place->direction);
  if (is_upright(p)) {
    double up[3] = {0, 0, 1};
    if (p->kind == ON_FACE || other->family != FLOOR) random_face(other, rng, up);
    path_on(p, rng, up, path, place->offset);
    memcpy(place->direction, up, sizeof up);
    return;
  }
  random_path(rng, length, angle, path);
  const double *on = path + 7 * (shapes_next(rng) % POSES);
  const double wide = p->kind == CAVITY ? 0.3 : p->kind == INTO ? 0.5 : 0.7;
  bounds_of(other, p->scale[1], low, high);
  for (int k = 0; k < 3; k++) {
    const double beyond = p->kind == OPEN ? 0.3 * extent_of(p, 0) : 0;
    const double reach = 0.5 * (high[k] - low[k]) + beyond;
    const double middle = 0.5 * (low[k] + high[k]);
    place->offset[k] = middle + 2 * wide * reach * shapes_uniform(rng, -1, 1) - on[k];
  }
}

// Goes along the direction until the bodies are free of each other and nearly touch. On success
// *answer is about that, with the least distance.
static int problem_touch(problem *p, worker *w, transform *place, nsvcd_answer *answer) {
  // along the direction: free, and not free
  double out = 0;
  double in = 0;
  put_at(p, w->path, place, 0);
  nsvcd_verdict verdict = ask(p, w, NSVCD_ASK_HIT, answer);
  if (verdict == NSVCD_UNDECIDED) return 0;
  const int begins_free = verdict == NSVCD_FREE;
  const double size = fmin(extent_of(p, 0), extent_of(p, 1));
  double step = (begins_free ? 0.1 : 0.02) * shapes_uniform(&w->rng, 0.2, 1) * size;
  if (begins_free && !is_upright(p)) {
    // towards the middle of the other, from the middle of the motion
    double norm = 0;
    for (int k = 0; k < 3; k++) {
      const double from = place->offset[k] + w->path[7 * (POSES / 2) + k];
      place->direction[k] = from + 0.3 * extent_of(p, 1) * shapes_normal(&w->rng);
      norm += place->direction[k] * place->direction[k];
    }
    for (int k = 0; k < 3; k++) place->direction[k] /= sqrt(fmax(norm, 1e-12));
  }
  const nsvcd_verdict wanted = begins_free ? NSVCD_HIT : NSVCD_FREE;
  double *end = begins_free ? &in : &out;
  for (int tries = 0;; tries++) {
    const double before = *end;
    if (tries == 40) return 0;
    *end += begins_free ? -step : step;
    if (tries > 6) step *= 1.25;
    put_at(p, w->path, place, *end);
    verdict = ask(p, w, NSVCD_ASK_HIT, answer);
    if (verdict == NSVCD_UNDECIDED) return 0;
    if (begins_free)
      out = before;
    else
      in = before;
    if (verdict == wanted) break;
  }
  while (out - in > 2e-4) {
    const double middle = 0.5 * (in + out);
    put_at(p, w->path, place, middle);
    if (ask(p, w, NSVCD_ASK_HIT, answer) == NSVCD_FREE)
      out = middle;
    else
      in = middle;
  }
  put_at(p, w->path, place, out);
  for (int k = 0; k < 3; k++) place->offset[k] += out * place->direction[k];
  return ask(p, w, NSVCD_ASK_DISTANCE, answer) == NSVCD_FREE &&
         answer->distance.high - answer->distance.low <= 4e-5f &&
         answer->nearest.triangle_a != NSVCD_NO_TRIANGLE;
}

// The gap, or, negative, the depth that a problem is to have.
static double problem_margin(const problem *p, shapes_rng *rng, int hit) {
  static const double sigmas[2][4] = {{0.008, 0.003, 0.001, 0.0004}, {0.016, 0.005, 0.002, 0.0005}};
  const double size = fmin(extent_of(p, 0), extent_of(p, 1));
  double margin = fabs(shapes_normal(rng)) * sigmas[hit][shapes_pick(rng, 4)] * fmin(1, size / 0.1);
  if (is_upright(p) && shapes_pick(rng, 2)) margin = log_uniform(rng, 1e-4, hit ? 0.005 : 0.02);
  if (p->swell > 0.2) {
    // any distance at which the swollen patches may meet
    double radii = 0;
    for (size_t n = 0; n < 2; n++) {
      const nsvcd_body *body = p->models[n]->network[p->size[n]];
      radii += (double)nsvcd__body_r(body)[shapes_next(rng) % body->patches] * p->scale[n];
    }
    margin = shapes_uniform(rng, 0, 0.7 * fmin(p->swell, 0.9)) * radii;
  }
  margin = fmin(margin, 0.3 * size);
  return hit ? -margin : margin;
}

// Of a hit that went beyond contact by `depth`: the shortest way back after which it is free. That
// is less where there is room on the way, as in what is hollow.
static double way_out(problem *p, worker *w, const transform *place, double depth, double gap) {
  const double pressed = -depth - gap;
  double in = 0;
  double out = depth;
  nsvcd_answer answer;
  for (int n = 1; n < 8 && depth > 1e-3 && out >= depth; n++) {
    const double back = depth * n / 8;
    put_at(p, w->path, place, pressed + back);
    *(ask(p, w, NSVCD_ASK_HIT, &answer) == NSVCD_FREE ? &out : &in) = back;
  }
  while (out < depth && out - in > 1e-4) {
    const double middle = 0.5 * (in + out);
    put_at(p, w->path, place, pressed + middle);
    *(ask(p, w, NSVCD_ASK_HIT, &answer) == NSVCD_FREE ? &out : &in) = middle;
  }
  put_at(p, w->path, place, pressed);
  return out;
}

// A problem near contact, or 0.
static int problem_make(problem *p, worker *w, const model *const *models, const size_t *body_sizes,
                        int hit) {
  double length, angle;
  transform place;
  nsvcd_answer answer;
  if (!problem_draw(p, &w->rng, models, body_sizes, &length, &angle)) return 0;
  problem_place(p, &w->rng, length, angle, w->path, &place);
  if (!problem_touch(p, w, &place, &answer)) return 0;
  const double gap = 0.5 * (double)(answer.distance.low + answer.distance.high);
  p->margin = problem_margin(p, &w->rng, hit);
  for (int k = 0; k < 3; k++) place.direction[k] = (double)answer.nearest.normal[k];
  put_at(p, w->path, &place, p->margin - gap);
  const nsvcd_verdict verdict = ask(p, w, hit ? NSVCD_ASK_HIT : NSVCD_ASK_DISTANCE, &answer);
  if (verdict != (hit ? NSVCD_HIT : NSVCD_FREE)) return 0;
  if (!hit) p->margin = 0.5 * (double)(answer.distance.low + answer.distance.high);
  if (hit) p->margin = -way_out(p, w, &place, -p->margin, gap);
  return fabs(p->margin) > LEAST_MARGIN;
}

// ---- pairs

typedef struct arrays {
  int32_t *slots;
  uint16_t *turns, *facts;
  float *reach, *margin;
  int8_t *nearest, *kind;
} arrays;

static uint16_t half_of(float value) {  // IEEE half, to nearest; no infinities are written
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  const uint32_t sign = bits >> 16 & 0x8000u;
  const int exponent = (int)(bits >> 23 & 255) - 112;
  if (exponent <= 0) {
    const float scaled = fabsf(value) * 16777216.0f;  // 2^24
    return (uint16_t)(sign | (uint32_t)lrintf(scaled));
  }
  if (exponent > 30) return (uint16_t)(sign | 0x7bffu);
  return (uint16_t)(sign | (((uint32_t)exponent << 10 | (bits >> 13 & 1023u)) + (bits >> 12 & 1u)));
}

static int deeper(const void *a, const void *b) {
  const nsvcd__candidate *x = (const nsvcd__candidate *)a;
  const nsvcd__candidate *y = (const nsvcd__candidate *)b;
  return nsvcd__is_shallower(x, y) ? 1 : -1;
}

// The patch whose centre is nearest to a place, both in the body's frame.
static size_t owner_of(const nsvcd_body *body, nsvcd__f3 place) {
  size_t best = 0;
  float least = 1e30f;
  for (size_t i = 0; i < body->patches; i++) {
    const nsvcd__f3 d = nsvcd__f3_sub(nsvcd__centre_of(nsvcd__body_patches(body), i), place);
    if (nsvcd__f3_dot(d, d) < least) best = i, least = nsvcd__f3_dot(d, d);
  }
  return best;
}

// The pairs of a problem, to place n of the arrays. Returns how many.
static size_t pairs_write(problem *p, worker *w, const size_t *first_patch, const arrays *to,
                          size_t n) {
  nsvcd_question q = question_of(p, 1);
  q.method = NSVCD_METHOD_NETWORK;
  nsvcd__candidate items[PAIRS];
  nsvcd__candidates kept;
  if (nsvcd__sweep_check(&q, w->workspace, w->workspace_size)) return 0;
  nsvcd__query *query = nsvcd__query_open(NSVCD__FLAGS, &q, w->workspace);
  nsvcd__task *task = &query->task;
  if (nsvcd__motion_gap(&task->motion) > task->lengths) return 0;
  nsvcd__cut_motion(&task->motion, task->lengths, &query->broad_phase);
  nsvcd__plane_cache_begin(&query->broad_phase, (float)p->swell);
  nsvcd__candidates_start(&kept, items, PAIRS);
  int more = nsvcd__search_begin(task->moving, task->fixed, ~(uint64_t)0, &query->broad_phase);
  while (more) more = nsvcd__search_step(&query->broad_phase, &kept);
  qsort(items, kept.count, sizeof *items, deeper);
  const size_t mover = task->swapped ? 1 : 0;
  to->nearest[n] = -1;
  for (size_t first = 0; first < PAIRS; first += NSVCD__SLICE) {
    const size_t left = kept.count > first ? kept.count - first : 0;
    const size_t count = left < NSVCD__SLICE ? left : NSVCD__SLICE;
    nsvcd__candidate *slice[NSVCD__SLICE];
    nsvcd__pairs pairs;
    nsvcd__inputs inputs;
    float turns[2][9][NSVCD__SLICE];
    for (size_t l = 0; l < count; l++) slice[l] = &items[first + l];
    if (count > 0) {
      nsvcd__pairs_of(task->moving, task->fixed, &task->motion, slice, count, &pairs);
      nsvcd__inputs_of(&pairs, count, &inputs);
      for (size_t b = 0; b < 2; b++) {
        const nsvcd__vmat3 *m = &inputs.turn[b];
        nsvcd__v3_put(m->x, turns[b][0], NSVCD__SLICE);
        nsvcd__v3_put(m->y, turns[b][3], NSVCD__SLICE);
        nsvcd__v3_put(m->z, turns[b][6], NSVCD__SLICE);
      }
    }
    for (size_t l = 0; l < NSVCD__SLICE && first + l < PAIRS; l++) {
      const size_t at = PAIRS * n + first + l;
      if (l >= count) {
        to->slots[2 * at] = to->slots[2 * at + 1] = -1;
        memset(to->turns + 18 * at, 0, 36);
        memset(to->facts + NSVCD__FACTS * at, 0, 2 * NSVCD__FACTS);
        to->reach[at] = 1;
        continue;
      }
      const size_t larger = inputs.keep >> l & 1 ? 0 : 1;  // 0: the moving patch
      const size_t patch[2] = {slice[l]->moving, slice[l]->fixed};
      for (size_t b = 0; b < 2; b++) {
        const size_t from = b ^ larger;
        const size_t body = p->body[from ^ mover];
        to->slots[2 * at + b] = (int32_t)(first_patch[body] + patch[from]);
        for (size_t k = 0; k < 9; k++) to->turns[18 * at + 9 * b + k] = half_of(turns[from][k][l]);
      }
      for (size_t k = 0; k < NSVCD__FACTS; k++)
        to->facts[NSVCD__FACTS * at + k] = half_of(inputs.facts[k][l]);
      const float radius[2] = {nsvcd__body_r(task->moving)[patch[0]] * task->motion.scale,
                               nsvcd__body_r(task->fixed)[patch[1]]};
      to->reach[at] = (radius[0] + radius[1]) * task->motion.unit;
    }
  }
  if (!kept.count) return 0;

  // 4. the pair that owns the nearest points
  nsvcd_answer answer;
  (void)ask(p, w, p->margin < 0 ? NSVCD_ASK_FIRST : NSVCD_ASK_DISTANCE, &answer);
  const nsvcd_contact *c = answer.contact_count ? &answer.contacts[0] : &answer.nearest;
  if (c->triangle_a != NSVCD_NO_TRIANGLE) {
    const double x = (double)c->time * (double)(p->count - 1);
    const size_t k = p->count < 2 ? 0 : x >= (double)(p->count - 2) ? p->count - 2 : (size_t)x;
    const float u = p->count < 2 ? 0 : (float)(x - (double)k);
    const nsvcd_pose *a = &p->poses[k];
    const nsvcd_pose *b = p->count < 2 ? a : a + 1;
    const nsvcd__quat qa = nsvcd__quat_load(a->rotation);
    const nsvcd__quat turn = nsvcd__quat_slerp(qa, nsvcd__quat_load(b->rotation), u);
    const nsvcd__mat3 m = nsvcd__mat3_of(turn);
    const nsvcd__f3 place = nsvcd__f3_load(c->point);
    const nsvcd__f3 gap =
        nsvcd__f3_scale(nsvcd__f3_load(c->normal), c->gap < HUGE_VALF ? c->gap : 0);
    const nsvcd__f3 way = nsvcd__f3_sub(nsvcd__f3_load(b->position), nsvcd__f3_load(a->position));
    const nsvcd__f3 origin = nsvcd__f3_fma(u, way, nsvcd__f3_load(a->position));
    const nsvcd__f3 arm = nsvcd__f3_sub(nsvcd__f3_add(place, gap), origin);
    const nsvcd__f3 own = nsvcd__f3_scale(nsvcd__mat3_apply_transpose(&m, arm), 1 / q.a.scale);
    const nsvcd__f3 other = nsvcd__f3_scale(place, 1 / q.b.scale);
    const size_t i = first_patch[p->body[0]] + owner_of(q.a.body, own);
    const size_t j = first_patch[p->body[1]] + owner_of(q.b.body, other);
    for (size_t l = 0; l < kept.count && to->nearest[n] < 0; l++) {
      const int32_t *slot = to->slots + 2 * (PAIRS * n + l);
      const int same = slot[0] == (int32_t)i && slot[1] == (int32_t)j;
      const int opposite = slot[0] == (int32_t)j && slot[1] == (int32_t)i;
      const nsvcd__candidate *item = &items[l];
      if ((same || opposite) && c->time >= item->t_enter - 1e-4f && c->time <= item->t_exit + 1e-4f)
        to->nearest[n] = (int8_t)l;
    }
  }
  to->margin[n] = (float)p->margin;
  to->kind[n] = (int8_t)p->kind;
  return kept.count;
}

// ---- all of it, by threads

typedef struct job {
  uint64_t seed;
  size_t meshes, groups;
  model *models;
  family *family;
  int32_t *group_bodies;
  arrays to;
  size_t next, tried[2], kept[2];
  int making;  // meshes, else groups
  pthread_mutex_t lock;
} job;

static void make_group(job *j, size_t g, worker *w) {
  const model *models[GROUP_BODIES];
  size_t body_sizes[GROUP_BODIES], first_patch[GROUP_BODIES];
  size_t n = 0;
  size_t patches = 0;
  size_t tried[2] = {0, 0};
  w->rng.state = (j->seed << 32) + 0x100000000ull * 7919 + g;
  for (int f = 0; f < FAMILIES; f++) {
    for (size_t k = 0; k < in_group[f]; k++, n++) {
      size_t m = shapes_next(&w->rng) % j->meshes;
      while (j->family[m] != (family)f) m = (m + 1) % j->meshes;
      const size_t size = size_of[(k + (size_t)f) % (sizeof size_of / sizeof *size_of)];
      models[n] = &j->models[m];
      body_sizes[n] = size;
      first_patch[n] = patches;
      patches += models[n]->network[size]->patches;
      j->group_bodies[GROUP_BODIES * g + n] = (int32_t)(SIZES * m + size);
    }
  }
  for (size_t k = 0; k < GROUP_PROBLEMS;) {
    problem p;
    const int wanted = (int)(k % 2);
    tried[wanted]++;
    if (!problem_make(&p, w, models, body_sizes, wanted)) continue;
    if (pairs_write(&p, w, first_patch, &j->to, GROUP_PROBLEMS * g + k) > 0) k++;
  }
  pthread_mutex_lock(&j->lock);
  for (int c = 0; c < 2; c++) j->tried[c] += tried[c];
  pthread_mutex_unlock(&j->lock);
}

static void *work(void *data) {
  job *j = (job *)data;
  worker w;
  double path[7 * POSES];
  w.path = path;
  w.workspace_size = nsvcd_sweep_workspace_size(NULL);
  w.workspace = malloc(w.workspace_size);
  for (;;) {
    pthread_mutex_lock(&j->lock);
    const size_t n = j->next++;
    pthread_mutex_unlock(&j->lock);
    if (n >= (j->making ? j->meshes : j->groups)) break;
    if (!j->making) {
      make_group(j, n, &w);
      continue;
    }
    w.rng.state = (j->seed << 32) + n;
    size_t fraction = n * 100 / j->meshes;
    int f = 0;
    // families lie side by side, so that each has its share, however few the meshes are
    while (fraction >= shares[f]) fraction -= shares[f], f++;
    j->family[n] = (family)f;
    while (!model_make(&j->models[n], &w.rng, (family)f)) shapes_free(&j->models[n].shape);
  }
  free(w.workspace);
  return NULL;
}

static void run(job *j, size_t threads, int making) {
  pthread_t ids[512];
  j->making = making;
  j->next = 0;
  for (size_t t = 0; t < threads; t++) pthread_create(&ids[t], NULL, work, j);
  for (size_t t = 0; t < threads; t++) pthread_join(ids[t], NULL);
}

static FILE *open_in(const char *folder, const char *name) {
  char path[1024];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *file = fopen(path, "wb");
  if (!file) {
    perror(path);
    exit(1);
  }
  return file;
}
static void save(const char *folder, const char *name, const void *data, size_t bytes) {
  FILE *file = open_in(folder, name);
  if (fwrite(data, 1, bytes, file) != bytes || fclose(file) != 0) {
    perror(name);
    exit(1);
  }
}

int main(int argc, char **argv) {
  job j;
  size_t threads = 2;
  memset(&j, 0, sizeof j);
  j.seed = 1, j.meshes = 100, j.groups = 4;
  for (int i = 2; i + 1 < argc; i += 2) {
    const size_t value = (size_t)strtoul(argv[i + 1], NULL, 10);
    if (!strcmp(argv[i], "--seed")) j.seed = value;
    if (!strcmp(argv[i], "--meshes")) j.meshes = value;
    if (!strcmp(argv[i], "--groups")) j.groups = value;
    if (!strcmp(argv[i], "--threads")) threads = value < 512 ? value : 512;
  }
  if (argc < 2 || argv[1][0] == '-') {
    fprintf(stderr, "scenes FOLDER --seed S --meshes M --groups G --threads T\n");
    return 2;
  }
  const size_t problems = j.groups * GROUP_PROBLEMS;
  const size_t pairs = problems * PAIRS;
  pthread_mutex_init(&j.lock, NULL);
  j.models = (model *)calloc(j.meshes, sizeof *j.models);
  j.family = (family *)calloc(j.meshes, sizeof *j.family);
  j.group_bodies = (int32_t *)malloc(j.groups * GROUP_BODIES * sizeof(int32_t));
  j.to.slots = (int32_t *)malloc(2 * pairs * sizeof(int32_t));
  j.to.turns = (uint16_t *)malloc(18 * pairs * sizeof(uint16_t));
  j.to.facts = (uint16_t *)malloc(NSVCD__FACTS * pairs * sizeof(uint16_t));
  j.to.reach = (float *)malloc(pairs * sizeof(float));
  j.to.margin = (float *)malloc(problems * sizeof(float));
  j.to.nearest = (int8_t *)malloc(problems);
  j.to.kind = (int8_t *)malloc(problems);
  run(&j, threads, 1);
  fprintf(stderr, "%zu meshes\n", j.meshes);
  run(&j, threads, 0);
  fprintf(stderr, "%zu problems, of %zu tries for a free one and %zu for a hit\n", problems,
          j.tried[0], j.tried[1]);

  FILE *points = open_in(argv[1], "points.i16");
  FILE *normals = open_in(argv[1], "normals.i8");
  int32_t *bodies = (int32_t *)calloc(j.meshes * SIZES + 1, sizeof(int32_t));
  for (size_t b = 0; b < j.meshes * SIZES; b++) {
    const model *m = &j.models[b / SIZES];
    const size_t count = m->network[b % SIZES]->patches;
    bodies[b + 1] = bodies[b] + (int32_t)count;
    fwrite(m->points[b % SIZES], sizeof(int16_t), 3 * POINTS * count, points);
    fwrite(m->normals[b % SIZES], 1, 3 * POINTS * count, normals);
  }
  if (fclose(points) != 0 || fclose(normals) != 0) return 1;
  save(argv[1], "bodies.i32", bodies, (j.meshes * SIZES + 1) * sizeof(int32_t));
  save(argv[1], "groups.i32", j.group_bodies, j.groups * GROUP_BODIES * sizeof(int32_t));
  save(argv[1], "slots.i32", j.to.slots, 2 * pairs * sizeof(int32_t));
  save(argv[1], "turns.f16", j.to.turns, 18 * pairs * sizeof(uint16_t));
  save(argv[1], "facts.f16", j.to.facts, NSVCD__FACTS * pairs * sizeof(uint16_t));
  save(argv[1], "reach.f32", j.to.reach, pairs * sizeof(float));
  save(argv[1], "margin.f32", j.to.margin, problems * sizeof(float));
  save(argv[1], "nearest.i8", j.to.nearest, problems);
  save(argv[1], "kind.i8", j.to.kind, problems);
  return 0;
}
