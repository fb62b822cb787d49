// check_rest.c - what lies flat on a table: boxes, cones, wedges, and meshes of files, each on three
// of its own vertices, whichever way up. How deep it is pressed in is known by construction, from
// the vertices in double, and so is what it stands on. Held against that are verdict, depth, lift
// and safe place of questions with a skin, with and without a clearance, and manifolds of what comes
// down. Prints what is wrong, and ends with 1 if anything is.
//
//   build/check_rest COUNT [SEED [FILE.obj ...]]   COUNT scenes, four questions each
#define _POSIX_C_SOURCE 200112L
#define NSVCD_NO_NETWORK
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#define PROGRAM "check_rest"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/oracle.h"
#include "../body_of.h"

#define SKIN 1e-3
#define CLEARANCE 5e-4
#define TO 5e-4
#define TABLES 3
// what a time in float is off by, of a way of 50 mm, metres
#define HAIR 6e-9

typedef struct resting {
  const nsvcd_body *body;
  double *points;  // (count, 3), as the body's mesh has them, scaled
  size_t count;
  float scale;
  const char *name;
} resting;

static const nsvcd_body *tables[TABLES];
static void *workspace;
static size_t asked, wrong, skipped;
static double worst_depth, least_area = 1;

// A box, a cone or a wedge, or a pyramid of three sides.
static void make_primitive(shapes_rng *rng, resting *out) {
  shapes_mesh shape;
  double size[3];
  memset(&shape, 0, sizeof shape);
  for (int k = 0; k < 3; k++) size[k] = shapes_uniform(rng, 0.02, 0.2);
  const int kind = (int)shapes_pick(rng, 4);
  const int sides = kind == 3 ? 3 : 8 + (int)shapes_pick(rng, 40);
  if (kind < 2) shapes_box(&shape, size[0], size[1], size[2], 1 + (int)shapes_pick(rng, 4));
  if (kind > 1) shapes_cone(&shape, size[0], kind == 3 ? 0 : 0.5 * size[0], size[2], sides);
  for (size_t i = 0; i < shape.vertices && kind == 1; i++)  // its top is an edge: a wedge
    if (shape.positions[3 * i + 2] > 0) shape.positions[3 * i] = 0.1 * size[0];
  out->body = body_of(&shape, NULL);
  out->count = shape.vertices;
  out->points = (double *)allocate(3 * shape.vertices * sizeof(double));
  for (size_t i = 0; i < 3 * shape.vertices; i++)
    out->points[i] = (double)(float)shape.positions[i];
  out->name = kind == 0 ? "box" : kind == 1 ? "wedge" : kind == 2 ? "cone" : "pyramid";
  shapes_free(&shape);
}

static int make_file(const char *path, resting *out) {
  nsvcd_mesh mesh;
  if (nsvcd_obj_load(path, NULL, &mesh, NULL)) return 0;
  const int good = !nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &out->body);
  if (good) out->scale = 0.15f / nsvcd_body_describe(out->body).radius;
  // a vertex for each corner: some are no corner of anything
  out->count = 3 * mesh.triangle_count;
  out->points = (double *)allocate(3 * out->count * sizeof(double));
  for (size_t i = 0; i < 3 * out->count; i++)
    out->points[i] = (double)out->scale * (double)mesh.positions[3 * mesh.indices[i / 3] + i % 3];
  out->name = path;
  nsvcd_mesh_free(&mesh, NULL);
  return good;
}

// The vertex that a plane through `at` meets first as it turns about `axis` (unit), from below all:
// `up` is its normal. Returns how far it turns then, radians.
static double turns_to(const resting *r, const double *at, const double *up, const double *side,
                       double *next) {
  double least = 4;
  for (size_t i = 0; i < r->count; i++) {
    double d[3];
    oracle_sub(r->points + 3 * i, at, d);
    const double along = oracle_dot(side, d);
    if (oracle_dot(d, d) < 1e-10 || along < 1e-6) continue;
    const double angle = atan2(oracle_dot(up, d), along);
    if (angle < least) memcpy(next, r->points + 3 * i, 3 * sizeof *next);
    least = fmin(least, angle);
  }
  return least;
}

// A side of the convex hull: the normal, unit, of a plane that touches vertices and is below the
// rest. Found by turning a plane from a random direction on until it lies on three. 0: none.
static int find_side(const resting *r, shapes_rng *rng, double *up) {
  double a[3], b[3], c[3], across[3], edge[3], side[3], other[3];
  shapes_direction(rng, up);
  double lowest = HUGE_VAL;
  for (size_t i = 0; i < r->count; i++) {
    const double height = oracle_dot(up, r->points + 3 * i);
    if (height < lowest) memcpy(a, r->points + 3 * i, sizeof a);
    lowest = fmin(lowest, height);
  }
  shapes_direction(rng, across);
  oracle_cross(up, across, edge);
  double length = sqrt(oracle_dot(edge, edge));
  if (length < 1e-3) return 0;
  for (int k = 0; k < 3; k++) edge[k] /= length;
  oracle_cross(edge, up, side);  // turning about `edge`, up goes to -side
  double angle = turns_to(r, a, up, side, b);
  if (angle > 3) return 0;
  for (int k = 0; k < 3; k++) up[k] = cos(angle) * up[k] - sin(angle) * side[k];
  oracle_sub(b, a, edge);
  length = sqrt(oracle_dot(edge, edge));
  for (int k = 0; k < 3; k++) edge[k] /= length;
  const double off = oracle_dot(up, edge);
  for (int k = 0; k < 3; k++) up[k] -= off * edge[k];
  oracle_cross(edge, up, side);
  angle = turns_to(r, a, up, side, c);
  if (angle > 3) return 0;
  oracle_sub(b, a, across);
  oracle_sub(c, a, other);
  oracle_cross(across, other, up);
  length = sqrt(oracle_dot(up, up));
  if (length < 1e-7) return 0;
  double middle = 0;
  for (size_t i = 0; i < r->count; i++) {
    oracle_sub(r->points + 3 * i, a, other);
    middle += oracle_dot(up, other);
  }
  for (int k = 0; k < 3; k++) up[k] /= middle < 0 ? -length : length;
  for (size_t i = 0; i < r->count; i++) {
    oracle_sub(r->points + 3 * i, a, other);
    if (oracle_dot(up, other) < -1e-7) return 0;
  }
  return 1;
}

// A vertex as a pose has it.
static void place(const resting *r, size_t i, const nsvcd_pose *pose, double *out) {
  double u[3], c[3], d[3];
  const double *v = r->points + 3 * i;
  for (int k = 0; k < 3; k++) u[k] = (double)pose->rotation[k];
  const double w = (double)pose->rotation[3];
  const double square = oracle_dot(u, u) + w * w;
  oracle_cross(u, v, c);
  for (int k = 0; k < 3; k++) c[k] += w * v[k];
  oracle_cross(u, c, d);
  for (int k = 0; k < 3; k++) out[k] = v[k] + 2 * d[k] / square + (double)pose->position[k];
}
static double lowest_of(const resting *r, const nsvcd_pose *pose) {
  double lowest = HUGE_VAL;
  double at[3];
  for (size_t i = 0; i < r->count; i++) {
    place(r, i, pose, at);
    lowest = fmin(lowest, at[2]);
  }
  return lowest;
}

// It stands on that side, its lowest vertex at height z.
static nsvcd_pose stand(const resting *r, const double *up, double yaw, double z) {
  nsvcd_pose pose;
  memset(&pose, 0, sizeof pose);
  // from `up` to z, and then about z
  double q[4] = {up[1], -up[0], 0, 1 + up[2]};
  if (1 + up[2] < 1e-6) q[0] = 1, q[1] = q[3] = 0;
  const double length = sqrt(oracle_dot(q, q) + q[3] * q[3]);
  const double s = sin(yaw / 2) / length;
  const double c = cos(yaw / 2) / length;
  pose.rotation[0] = (float)(c * q[0] - s * q[1]);
  pose.rotation[1] = (float)(c * q[1] + s * q[0]);
  pose.rotation[2] = (float)(c * q[2] + s * q[3]);
  pose.rotation[3] = (float)(c * q[3] - s * q[2]);
  pose.position[2] = (float)(z - lowest_of(r, &pose));
  return pose;
}

static void blame(const resting *r, const char *what, double is, double should) {
  if (wrong++ < 40) printf("%s: %s: %.9g, not %.9g\n", r->name, what, is, should);
}

static nsvcd_answer ask(const nsvcd_question *question) {
  nsvcd_answer answer;
  memset(&answer, 0, sizeof answer);
  asked++;
  if (nsvcd_sweep(question, workspace, nsvcd_sweep_workspace_size(NULL), &answer))
    exit(complain("refused") + REFUSED);
  return answer;
}

static nsvcd_question question_about(const resting *r, const nsvcd_pose *path,
                                     const nsvcd_body *table, double clearance) {
  nsvcd_question question;
  memset(&question, 0, sizeof question);
  question.a.body = r->body;
  question.a.poses = path;
  question.a.count = 2;
  question.a.scale = r->scale;
  question.b.body = table;
  question.clearance = (float)clearance;
  return question;
}

// With a skin, from pressed in by up to 1.5 of it to a little above; it slides and turns.
static void check_skin(const resting *r, const double *up, shapes_rng *rng, double clearance) {
  static const double presses[8] = {0, 1e-6, 1e-5, 1e-4, 4e-4, 9e-4, 1.3e-3, -2e-4};
  const double yaw = shapes_uniform(rng, 0, 6.28);
  const double press = presses[shapes_pick(rng, 8)];
  nsvcd_pose path[2];
  path[0] = stand(r, up, yaw, clearance - press);
  path[1] = shapes_pick(rng, 2) ? stand(r, up, yaw + 0.1, clearance - press) : path[0];
  path[1].position[0] += shapes_pick(rng, 4) ? 0.05f : 0;
  path[1].position[2] = path[0].position[2];
  // the other end is as deep as its own rounding
  const double deepest = clearance - fmin(lowest_of(r, &path[0]), lowest_of(r, &path[1]));
  const double depth = fmax(clearance - lowest_of(r, &path[0]), 0);
  nsvcd_question question = question_about(r, path, tables[shapes_pick(rng, TABLES)], clearance);
  question.slop = (float)SKIN;
  const nsvcd_answer answer = ask(&question);
  const int is_free = deepest < SKIN - HAIR;
  if (!is_free && deepest < SKIN + HAIR) return;
  if ((answer.verdict == NSVCD_FREE) != is_free) blame(r, "verdict", answer.verdict, is_free);
  if (!is_free && answer.depth < HUGE_VALF) blame(r, "too deep, but", (double)answer.depth, 0);
  if (!is_free || answer.verdict != NSVCD_FREE) return;
  const double off = fmax(fabs((double)answer.depth - depth) - HAIR, 0);
  worst_depth = depth > 0 ? fmax(worst_depth, off / depth) : worst_depth;
  if (off > 0.01 * depth) blame(r, "depth", (double)answer.depth, depth);
  // of a body that stands on an edge it may be along a side's normal
  if ((double)answer.push_out[2] < 0.8 * SKIN && press > -1e-7)
    blame(r, "lift upward", (double)answer.push_out[2], SKIN);
  const double above = lowest_of(r, &answer.safe.a) - clearance;
  const double kept = fmax(0.02 * SKIN, 2 * HAIR);
  if (above < -1e-7) blame(r, "safe place below", above, 0);
  if (above > 1.1 * kept + 0.01 * SKIN + fmax(-press, 0)) blame(r, "safe place above", above, kept);
}

static int compare_places(const void *a, const void *b) {
  const double *p = (const double *)a;
  const double *q = (const double *)b;
  if (p[0] < q[0] || p[0] > q[0]) return p[0] < q[0] ? -1 : 1;
  return (p[1] > q[1]) - (p[1] < q[1]);
}

// The area that (count, 2) places span; they are sorted (Andrew 1979: both halves of the hull).
static double area_of(double *places, size_t count) {
  double area = 0;
  size_t *hull = (size_t *)allocate((count + 1) * sizeof *hull);
  qsort(places, count, 2 * sizeof *places, compare_places);
  for (int half = 0; half < 2; half++) {
    const double side = half ? -1 : 1;
    size_t size = 0;
    for (size_t i = 0; i < count; i++) {
      const double *p = places + 2 * i;
      for (; size > 1; size--) {
        const double *a = places + 2 * hull[size - 2];
        const double *b = places + 2 * hull[size - 1];
        if (side * ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) > 0) break;
      }
      hull[size++] = i;
    }
    for (size_t i = 0; i + 1 < size; i++) {
      const double *a = places + 2 * hull[i];
      const double *b = places + 2 * hull[i + 1];
      area += side * (a[0] * b[1] - b[0] * a[1]) / 2;
    }
  }
  free(hull);
  return area;
}

// It comes down flat. What it stands on, to within a hair, and the four places that are told.
static void check_manifold(const resting *r, const double *up, shapes_rng *rng) {
  const double yaw = shapes_uniform(rng, 0, 6.28);
  const nsvcd_pose path[2] = {stand(r, up, yaw, 0.03), stand(r, up, yaw, -0.02)};
  nsvcd_question question = question_about(r, path, tables[shapes_pick(rng, TABLES)], 0);
  question.ask = NSVCD_ASK_FIRST;
  question.to = (float)TO;
  question.manifold = 1;
  const nsvcd_answer answer = ask(&question);
  if (answer.verdict != NSVCD_HIT) {
    blame(r, "comes down, verdict", answer.verdict, NSVCD_HIT);
    return;
  }
  const double low = 0.03 - 0.05 * (double)answer.time.low;
  const double high = 0.03 - 0.05 * (double)answer.time.high;
  if (low < -HAIR) blame(r, "height that is called free", low, 0);
  if (high > HAIR) blame(r, "height that is called a contact", high, 0);
  if (low - high > 1.01 * TO && !answer.why) blame(r, "height between these", low - high, TO);
  if (lowest_of(r, &answer.safe.a) < 0) blame(r, "safe place", lowest_of(r, &answer.safe.a), 0);
  double told[2 * NSVCD_MAX_CONTACTS];
  for (size_t k = 0; k < answer.contact_count; k++) {
    const nsvcd_contact *c = &answer.contacts[k];
    for (int i = 0; i < 2; i++) told[2 * k + (size_t)i] = (double)c->point[i];
    if (fabs((double)c->point[2]) > 1.01 * TO + HAIR) blame(r, "point", (double)c->point[2], 0);
    if (c->normal[2] < 0.6f) blame(r, "normal", (double)c->normal[2], 1);
    if ((double)c->gap > 1.01 * TO + HAIR) blame(r, "gap", (double)c->gap, TO);
  }
  double *places = (double *)allocate(2 * (r->count + 1) * sizeof *places);
  double middle[2] = {0, 0};
  size_t count = 0;
  const double lowest = lowest_of(r, &path[0]);
  for (size_t i = 0; i < r->count; i++) {
    double at[3];
    place(r, i, &path[0], at);
    for (int k = 0; k < 2; k++) middle[k] += at[k] / (double)r->count;
    if (at[2] - lowest > 2e-6) continue;
    memcpy(places + 2 * count++, at, 2 * sizeof *places);
  }
  const double full = area_of(places, count);
  // what would topple does not rest; with its middle as well they span no more
  memcpy(places + 2 * count, middle, sizeof middle);
  const int topples = area_of(places, count + 1) > 1.0001 * full;
  free(places);
  if (!(full > 1e-6) || topples) return;
  const double fraction = area_of(told, answer.contact_count) / full;
  least_area = fmin(least_area, fraction);
  // of a round base four places span 0.64
  if (fraction < 0.6) blame(r, "area spanned, of all", fraction, 0.6);
}

int main(int argc, char **argv) {
  const size_t count = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 0;
  const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
  shapes_rng rng = {seed};
  if (count == 0) return complain("COUNT [SEED [FILE.obj ...]]"), USAGE;
  workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  for (int k = 0; k < TABLES; k++) {
    shapes_mesh shape;
    memset(&shape, 0, sizeof shape);
    shapes_box(&shape, 3, 3, 0.1, k == 0 ? 1 : k == 1 ? 16 : 48);
    for (size_t i = 0; i < shape.vertices; i++) shape.positions[3 * i + 2] -= 0.05;
    tables[k] = body_of(&shape, NULL);
    shapes_free(&shape);
  }
  for (size_t n = 0; n < count; n++) {
    resting r;
    double up[3];
    memset(&r, 0, sizeof r);
    const int is_file = argc > 3 && n % 2;
    if (!is_file) make_primitive(&rng, &r);
    if (is_file && !make_file(argv[3 + n / 2 % (size_t)(argc - 3)], &r)) continue;
    if (find_side(&r, &rng, up)) {
      check_skin(&r, up, &rng, 0);
      check_skin(&r, up, &rng, CLEARANCE);
      check_skin(&r, up, &rng, CLEARANCE);
      check_manifold(&r, up, &rng);
    } else {
      skipped++;
    }
    nsvcd_body_free(r.body, NULL);
    free(r.points);
  }
  printf(
      "%zu questions about %zu things at rest, %zu without a side; depths to %.4f of themselves "
      "and "
      "a hair, four places span %.2f of all at least; %zu wrong\n",
      asked, count, skipped, worst_depth, least_area, wrong);
  for (int k = 0; k < TABLES; k++) nsvcd_body_free(tables[k], NULL);
  free(workspace);
  return wrong ? REFUSED : DONE;
}
