// What tests/test_proof.c tries the proof with: bodies whose stored surface is read and held
// against the mesh in double, and motions. Independent of the
// header's arithmetic: from the header only the layout of a body is taken. Include after
// neuralsvcd.h with its implementation.
#ifndef PROOF_SCENE_H
#define PROOF_SCENE_H

#include "body_of.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"

#define PROOF_POOL 96  // points of the surface by which a patch is judged
#define PROOF_POSES 80
#define PROOF_HULL 16

// -------------------------------------------------------------------------------------------------
// hulls

// Solves the symmetric system of n <= 3 rows; the answer replaces b. Returns 0 if it is singular.
static int proof_solve(double a[3][3], double *b, int n) {
  for (int i = 0; i < n; i++) {
    if (!(fabs(a[i][i]) > 1e-300)) return 0;
    for (int j = i + 1; j < n; j++) {
      const double factor = a[j][i] / a[i][i];
      for (int k = i; k < n; k++) a[j][k] -= factor * a[i][k];
      b[j] -= factor * b[i];
    }
  }
  for (int i = n - 1; i >= 0; i--) {
    for (int j = i + 1; j < n; j++) b[i] -= a[i][j] * b[j];
    b[i] /= a[i][i];
  }
  return 1;
}

// The point of the plane through these 1 to 4 points nearest to the origin, if it is between them.
static int proof_foot(const double (*p)[3], const int *chosen, int count, double *foot) {
  double edges[3][3];
  double gram[3][3];
  double weights[3];
  double first = 1;
  for (int i = 0; i + 1 < count; i++) oracle_sub(p[chosen[i + 1]], p[chosen[0]], edges[i]);
  for (int i = 0; i + 1 < count; i++) {
    for (int j = 0; j + 1 < count; j++) gram[i][j] = oracle_dot(edges[i], edges[j]);
    weights[i] = -oracle_dot(edges[i], p[chosen[0]]);
  }
  if (!proof_solve(gram, weights, count - 1)) return 0;
  memcpy(foot, p[chosen[0]], 3 * sizeof *foot);
  for (int i = 0; i + 1 < count; i++) {
    if (!(weights[i] >= 0)) return 0;
    first -= weights[i];
    for (int k = 0; k < 3; k++) foot[k] += weights[i] * edges[i][k];
  }
  return first >= 0;
}

// Keeps of up to 4 points those whose hull has the point nearest to the origin; that point goes to
// `nearest`.
static void proof_reduce(double (*p)[3], int *count, double *nearest) {
  double best = DBL_MAX;
  unsigned kept = 1;
  double out[4][3];
  for (unsigned set = 1; set < 1u << *count; set++) {
    int chosen[4];
    int n = 0;
    double foot[3];
    for (int i = 0; i < *count; i++) {
      if (set >> i & 1) chosen[n++] = i;
    }
    if (!proof_foot((const double(*)[3])p, chosen, n, foot)) continue;
    if (oracle_dot(foot, foot) >= best) continue;
    best = oracle_dot(foot, foot);
    memcpy(nearest, foot, sizeof foot);
    kept = set;
  }
  int n = 0;
  for (int i = 0; i < *count; i++) {
    if (kept >> i & 1) memcpy(out[n++], p[i], sizeof out[0]);
  }
  memcpy(p, out, (size_t)n * sizeof out[0]);
  *count = n;
}

// Distance of x from the hull of some points, as a lower and an upper bound (Gilbert, Johnson and
// Keerthi 1988).
static void proof_hull_distance(const double (*hull)[3], size_t count, const double *x, double *low,
                                double *high) {
  double simplex[4][3], nearest[3];
  int size = 1;
  oracle_sub(hull[0], x, simplex[0]);
  memcpy(nearest, simplex[0], sizeof nearest);
  *low = 0;
  *high = oracle_length(nearest);
  for (int step = 0; step < 60 && *high > *low * (1 + 1e-10) && *high > 0; step++) {
    double least = DBL_MAX;
    double support[3] = {0, 0, 0};
    for (size_t i = 0; i < count; i++) {
      double d[3];
      oracle_sub(hull[i], x, d);
      const double at = oracle_dot(d, nearest);
      if (at >= least) continue;
      least = at;
      memcpy(support, d, sizeof d);
    }
    *low = fmax(*low, least / oracle_length(nearest));
    if (size == 4) return;
    memcpy(simplex[size++], support, sizeof support);
    proof_reduce(simplex, &size, nearest);
    if (oracle_length(nearest) >= *high) return;
    *high = oracle_length(nearest);
  }
}

// -------------------------------------------------------------------------------------------------
// bodies

typedef struct proof_patch {
  double centre[3], radius;
  double above[2][4];  // spheres over it, of its group and of the body: centre, radius
  double normal[3], low, high, across;
  double slack, quantum;
  double hull[PROOF_HULL][3];
  size_t hull_count;
  size_t first, end;           // listings
  double pool[PROOF_POOL][3];  // points of the mesh that it holds for certain
  size_t pool_count;
} proof_patch;

typedef struct proof_listing {
  size_t patch, triangle;
  int whole;             // else it is a part of the triangle
  double corners[3][3];  // the mesh's where it is whole, else as stored
  double stored[3][3];
} proof_listing;

typedef struct proof_body {
  const nsvcd_body *body;
  double *positions;  // of the mesh
  uint32_t *indices;
  size_t vertices, triangles;
  oracle_mesh oracle;
  proof_patch *patches;
  size_t count, listed;
  proof_listing *listings;
  size_t *first_of, *of_triangle;  // listings by triangle
  double size;                     // radius about the origin of the body
} proof_body;

static void proof_corners(const proof_body *b, size_t triangle, double corners[3][3]) {
  for (size_t k = 0; k < 3; k++) {
    memcpy(corners[k], b->positions + 3 * (size_t)b->indices[3 * triangle + k], 3 * sizeof(double));
  }
}

static void proof_read_patch(const nsvcd__geometry *f, size_t i, proof_patch *out) {
  const size_t padded = f->body->padded;
  const float *spheres = (const float *)(const void *)(f->body + 1);
  const size_t all = f->first_vertex[i + 1] - f->first_vertex[i];
  const int16_t *x = f->vertices + 3 * (size_t)f->first_vertex[i];
  for (size_t k = 0; k < 3; k++) out->centre[k] = (double)spheres[k * padded + i];
  for (size_t k = 0; k < 3; k++) out->normal[k] = (double)f->slabs[k * padded + i];
  out->radius = (double)spheres[3 * padded + i];
  const nsvcd__sphere above[2] = {nsvcd__sphere_of(nsvcd__groups_of(f->body), i / 16),
                                  nsvcd__body_sphere(f->body)};
  for (size_t n = 0; n < 2; n++) {
    const float *sphere = &above[n].centre.x;
    for (size_t k = 0; k < 4; k++) out->above[n][k] = (double)sphere[k];
  }
  out->low = (double)f->slabs[3 * padded + i];
  out->high = (double)f->slabs[4 * padded + i];
  out->across = (double)f->slabs[5 * padded + i];
  out->slack = (double)f->margins[i];
  out->quantum = (double)f->errors[i];
  out->hull_count = f->hull_counts[i];
  out->first = f->first_triangle[i];
  out->end = f->first_triangle[i + 1];
  out->pool_count = 0;
  for (size_t n = 0; n < out->hull_count; n++) {
    for (size_t k = 0; k < 3; k++) {
      out->hull[n][k] = out->centre[k] + (double)f->steps[i] * x[k * all + n];
    }
  }
}

static size_t proof_stored_number(const unsigned char *at, size_t bytes) {
  size_t number = 0;
  for (size_t k = 0; k < bytes; k++) number |= (size_t)at[k] << 8 * k;
  return number;
}

// Points of a patch: stored ones, its own vertices, references to others.
static size_t proof_points(const nsvcd__geometry *f, size_t i) {
  const size_t stored = f->first_vertex[i + 1] - f->first_vertex[i];
  const size_t own = f->first_own[i + 1] - f->first_own[i];
  return stored + own + f->first_reference[i + 1] - f->first_reference[i];
}

// The place of one of them. Returns 1 if it is a vertex of the mesh.
static int proof_point(const proof_body *b, const nsvcd__geometry *f, size_t i, size_t number,
                       double place[3]) {
  const size_t stored = f->first_vertex[i + 1] - f->first_vertex[i];
  const size_t own = f->first_own[i + 1] - f->first_own[i];
  const int16_t *x = f->vertices + 3 * (size_t)f->first_vertex[i];
  const size_t bytes = f->counts->positions > 65536 ? 4 : 2;
  if (number < stored) {
    for (size_t k = 0; k < 3; k++)
      place[k] = b->patches[i].centre[k] + (double)f->steps[i] * x[k * stored + number];
    return 0;
  }
  size_t at = f->first_own[i] + number - stored;
  if (number >= stored + own) {
    at = f->first_reference[i] + number - stored - own;
    at = proof_stored_number(f->references + bytes * at, bytes);
  }
  for (size_t k = 0; k < 3; k++) place[k] = (double)f->positions[3 * at + k];
  return 1;
}

// Where the numbers of a patch's triangles are: behind their corners.
static const unsigned char *proof_numbers(const nsvcd__geometry *f, size_t i) {
  const size_t triangles = f->first_triangle[i + 1] - f->first_triangle[i];
  return f->entries + f->first_byte[i] + (proof_points(f, i) <= 256 ? 3 : 6) * triangles;
}

// The number of the patch's n-th triangle: the sum of what n + 1 codes say, each in groups of seven
// bits.
static size_t proof_triangle_number(const nsvcd__geometry *f, size_t i, size_t n) {
  const unsigned char *at = proof_numbers(f, i);
  size_t sum = 0;
  for (size_t k = 0; k <= n; k++) {
    size_t code = 0;
    size_t place = 1;
    do {
      code += place * (*at & 127);
      place *= 128;
    } while (*at++ >= 128);
    sum += code / 2;
  }
  return sum % ((size_t)1 << 31);
}

static void proof_read_listing(const proof_body *b, const nsvcd__geometry *f, size_t i, size_t n,
                               proof_listing *out) {
  const size_t bytes = proof_points(f, i) <= 256 ? 1 : 2;
  out->patch = i;
  out->triangle = proof_triangle_number(f, i, n - f->first_triangle[i]);
  proof_corners(b, out->triangle, out->corners);
  out->whole = 1;
  for (size_t c = 0; c < 3; c++) {
    const size_t corner = 3 * (n - f->first_triangle[i]) + c;
    const unsigned char *at = f->entries + f->first_byte[i] + bytes * corner;
    const size_t number = proof_stored_number(at, bytes);
    if (!proof_point(b, f, i, number, out->stored[c])) out->whole = 0;
  }
  for (size_t c = 0; c < 3 && out->whole && f->counts->convex_radius <= 0; c++) {
    for (size_t k = 0; k < 3; k++) CHECK_NEAR(out->stored[c][k], out->corners[c][k], 0);
  }
  if (!out->whole) memcpy(out->corners, out->stored, sizeof out->corners);
}

// Does the patch hold a point of one of its triangles: 1 for certain, 0 for certain not, -1 unknown
// (to rounding).
static int proof_holds(const proof_patch *p, const double *x) {
  double d[3], along[3], low, high;
  oracle_sub(x, p->centre, d);
  const double square = oracle_dot(p->normal, p->normal);
  const double height = oracle_dot(p->normal, d);
  const double rounding = 1e-12 * (oracle_length(p->centre) + p->radius);
  for (int k = 0; k < 3; k++) along[k] = d[k] - p->normal[k] * height / square;
  const double outside = fmax(fmax(oracle_length(d) - p->radius, oracle_length(along) - p->across),
                              fmax(height - p->high, p->low - height));
  if (outside > rounding) return 0;
  proof_hull_distance((const double(*)[3])p->hull, p->hull_count, x, &low, &high);
  if (low > p->slack + rounding) return 0;
  return outside <= 0 && high <= p->slack ? 1 : -1;
}

static int proof_lists(const proof_body *b, size_t i, size_t triangle) {
  for (size_t n = b->first_of[triangle]; n < b->first_of[triangle + 1]; n++) {
    if (b->listings[b->of_triangle[n]].patch == i) return 1;
  }
  return 0;
}

static void proof_pool_add(proof_patch *p, const double *x) {
  if (p->pool_count == PROOF_POOL || proof_holds(p, x) != 1) return;
  memcpy(p->pool[p->pool_count++], x, 3 * sizeof *x);
}

static void proof_point_in(shapes_rng *rng, double corners[3][3], double *out) {
  double u = shapes_uniform(rng, 0, 1);
  double v = shapes_uniform(rng, 0, 1);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  for (int k = 0; k < 3; k++) {
    out[k] = (1 - u - v) * corners[0][k] + u * corners[1][k] + v * corners[2][k];
  }
}

// Between a point that is held and one that is not: about the last one that is.
static void proof_pool_border(proof_patch *p, const double *inside, const double *outside) {
  double in = 0;
  double out = 1;
  double x[3];
  for (int step = 0; step < 24; step++) {
    const double middle = 0.5 * (in + out);
    for (int k = 0; k < 3; k++) x[k] = inside[k] + middle * (outside[k] - inside[k]);
    if (proof_holds(p, x) == 1) in = middle;
    if (proof_holds(p, x) != 1) out = middle;
  }
  for (int k = 0; k < 3; k++) x[k] = inside[k] + in * (outside[k] - inside[k]);
  proof_pool_add(p, x);
}

// Fills a patch's pool: corners of its triangles, then random points, and where triangles leave
// what it holds.
static void proof_fill_pool(proof_body *b, size_t i, shapes_rng *rng) {
  proof_patch *p = &b->patches[i];
  for (size_t n = p->first; n < p->end && p->pool_count < PROOF_POOL / 2; n++) {
    double corners[3][3];
    proof_corners(b, b->listings[n].triangle, corners);
    for (int k = 0; k < 3; k++) proof_pool_add(p, corners[k]);
  }
  for (int trial = 0; trial < 2 * PROOF_POOL && p->end > p->first; trial++) {
    const size_t n = p->first + (size_t)(shapes_next(rng) % (p->end - p->first));
    double corners[3][3], x[3];
    proof_corners(b, b->listings[n].triangle, corners);
    proof_point_in(rng, corners, x);
    if (proof_holds(p, x) == 1) {
      proof_pool_add(p, x);
      const double *corner = corners[trial % 3];
      if (proof_holds(p, corner) == 0) proof_pool_border(p, x, corner);
    }
  }
}

static void proof_sort_listings(proof_body *b) {
  size_t *first = (size_t *)calloc(b->triangles + 2, sizeof *first);
  b->of_triangle = (size_t *)malloc((b->listed + 1) * sizeof *b->of_triangle);
  if (!first || !b->of_triangle) exit(1);
  for (size_t n = 0; n < b->listed; n++) first[b->listings[n].triangle + 2]++;
  for (size_t t = 0; t < b->triangles; t++) first[t + 2] += first[t + 1];
  for (size_t n = 0; n < b->listed; n++) b->of_triangle[first[b->listings[n].triangle + 1]++] = n;
  b->first_of = first;
}

static void proof_read_body(proof_body *b) {
  const nsvcd__geometry f = nsvcd__geometry_of(nsvcd__triangles_of(b->body));
  shapes_rng rng = {b->triangles};
  b->count = f.body->patches;
  b->listed = f.counts->listed;
  b->patches = (proof_patch *)calloc(b->count, sizeof *b->patches);
  b->listings = (proof_listing *)calloc(b->listed + 1, sizeof *b->listings);
  if (!b->patches || !b->listings) exit(1);
  for (size_t i = 0; i < b->count; i++) {
    proof_read_patch(&f, i, &b->patches[i]);
    for (size_t n = b->patches[i].first; n < b->patches[i].end; n++) {
      proof_read_listing(b, &f, i, n, &b->listings[n]);
    }
  }
  proof_sort_listings(b);
  for (size_t i = 0; i < b->count; i++) {
    const proof_patch *p = &b->patches[i];
    proof_fill_pool(b, i, &rng);
    for (size_t n = 0; n < 2 * p->pool_count; n++) {  // the balls over it hold what it holds
      double d[3];
      oracle_sub(p->pool[n / 2], p->above[n % 2], d);
      CHECK_LE(oracle_length(d), p->above[n % 2][3]);
    }
  }
}

// Takes the shape, multiplied by scale.
static proof_body proof_encode(shapes_mesh *shape, double scale,
                               const nsvcd_encode_options *options) {
  proof_body b;
  memset(&b, 0, sizeof b);
  for (size_t i = 0; i < 3 * shape->vertices && scale != 1; i++) shape->positions[i] *= scale;
  b.body = body_of(shape, options);
  b.vertices = shape->vertices;
  b.triangles = shape->triangles;
  b.positions = shape->positions;
  b.indices = shape->indices;
  if (!oracle_mesh_init(&b.oracle, b.positions, b.vertices, b.indices, b.triangles, 1)) exit(1);
  for (size_t i = 0; i < b.vertices; i++) b.size = fmax(b.size, oracle_length(b.positions + 3 * i));
  proof_read_body(&b);
  return b;
}

static void proof_free(proof_body *b) {
  nsvcd_body_free(b->body, NULL);
  oracle_mesh_free(&b->oracle);
  free(b->positions);
  free(b->indices);
  free(b->patches);
  free(b->listings);
  free(b->first_of);
  free(b->of_triangle);
  memset(b, 0, sizeof *b);
}

// -------------------------------------------------------------------------------------------------
// motions

typedef struct proof_track {
  nsvcd_pose raw[PROOF_POSES];     // as asked
  oracle_pose poses[PROOF_POSES];  // the same in double, quaternions of unit length
  float times[PROOF_POSES];        // of them, if it is timed; else they are uniform
  int timed;
  size_t count;
  float scale;     // of the body
  float pivot[3];  // of the body's mesh
} proof_track;

typedef struct proof_motion {
  proof_track moving, fixed;  // "fixed" is the body in whose frame the library looks at the other
} proof_motion;

// x -> matrix x + position: from the moving body's frame to the fixed one's, in units of the fixed
// body's mesh.
typedef struct proof_place {
  double matrix[9], position[3];
} proof_place;

// Rounds the poses to float, and takes them as they then are.
static void proof_track_set(proof_track *track, const oracle_pose *poses, size_t count) {
  track->count = count;
  track->scale = 1;
  track->timed = 0;
  memset(track->pivot, 0, sizeof track->pivot);
  for (size_t i = 0; i < count; i++) {
    track->raw[i] = pose_rounded(&poses[i]);
    track->poses[i] = pose_widened(&track->raw[i]);
  }
}
static void proof_motion_set(proof_motion *m, const oracle_pose *poses, size_t count,
                             const oracle_pose *fixed) {
  proof_track_set(&m->moving, poses, count);
  proof_track_set(&m->fixed, fixed, 1);
}

static proof_place proof_relative(const oracle_pose *pose, const oracle_pose *fixed) {
  proof_place out;
  double turn[9], base[9], d[3];
  oracle_matrix(pose->rotation, turn);
  oracle_matrix(fixed->rotation, base);
  oracle_sub(pose->position, fixed->position, d);
  oracle_rotate_back(base, d, out.position);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      out.matrix[3 * i + j] =
          base[i] * turn[j] + base[3 + i] * turn[3 + j] + base[6 + i] * turn[6 + j];
    }
  }
  return out;
}

// Gives some tracks times of their own: most poses in a moment, or not. rng: a copy, so that scenes
// are what they are without.
static void proof_set_times(shapes_rng rng, proof_track *track) {
  const double uneven = shapes_uniform(&rng, 0.5, 3.5);
  double sums[PROOF_POSES] = {0};
  if (track->count < 2 || shapes_next(&rng) % 3) return;
  track->timed = 1;
  for (size_t k = 1; k < track->count; k++)
    sums[k] = sums[k - 1] + pow(10, -uneven * shapes_uniform(&rng, 0, 1));
  // of 20 bits, which are at ticks
  for (size_t k = 0; k < track->count; k++)
    track->times[k] = (float)(rint(sums[k] / sums[track->count - 1] * 1048576) / 1048576);
}

// Gives some tracks pivots, as far from the origin as the body moves, or less. rng: a copy, too.
static void proof_set_pivot(shapes_rng rng, proof_track *track) {
  double moved[3], direction[3];
  if (track->count < 2 || shapes_next(&rng) % 4) return;
  oracle_sub(track->poses[track->count - 1].position, track->poses[0].position, moved);
  const double length = pow(10, shapes_uniform(&rng, -2, 0)) * oracle_length(moved);
  shapes_direction(&rng, direction);
  for (int k = 0; k < 3; k++)
    track->pivot[k] = (float)(length * direction[k] / (double)track->scale);
}

// From the origin of a pose to the track's pivot, and where that is.
static void proof_pivot_arm(const proof_track *m, const oracle_pose *pose, double *arm) {
  double turn[9], own[3];
  for (int i = 0; i < 3; i++) own[i] = (double)m->scale * (double)m->pivot[i];
  oracle_matrix(pose->rotation, turn);
  oracle_rotate(turn, own, arm);
}
static void proof_pivot_of(const proof_track *m, const oracle_pose *pose, double *out) {
  proof_pivot_arm(m, pose, out);
  for (int i = 0; i < 3; i++) out[i] += pose->position[i];
}

// How far a track's pivot moves from pose k to the next, with what points at most `size` from the
// origin add by their turn.
static double proof_track_way(const proof_track *m, size_t k, double size) {
  double from[3], to[3], moved[3], arm[3], axis[3];
  proof_pivot_of(m, &m->poses[k], from);
  proof_pivot_of(m, &m->poses[k + 1], to);
  oracle_sub(to, from, moved);
  proof_pivot_arm(m, &m->poses[k], arm);
  const double turn = oracle_quat_arc(m->poses[k].rotation, m->poses[k + 1].rotation, axis);
  return oracle_length(moved) + turn * (size + oracle_length(arm));
}

// When pose k is, and the last pose before t, which is not the last of all.
static double proof_time_of(const proof_track *m, size_t k) {
  return m->timed ? (double)m->times[k] : (double)k / (double)(m->count - 1);
}
static size_t proof_pose_before(const proof_track *m, double t) {
  const double at = t * (double)(m->count - 1);
  const size_t last = m->count - 2;
  size_t k = 0;
  if (!m->timed) return at <= 0 ? 0 : (size_t)at < last ? (size_t)at : last;
  while (k < last && (double)m->times[k + 1] <= t) k++;
  return k;
}

// The pose at t. As oracle_pose_at, but where samples are exactly half a turn apart and both arcs
// are as short: there the sign is that of the floats' own product, and 0 leaves them as they are.
static oracle_pose proof_pose_at(const proof_track *m, double t) {
  if (m->count == 1) return m->poses[0];
  const size_t k = proof_pose_before(m, t);
  const oracle_pose *a = &m->poses[k];
  const oracle_pose *b = a + 1;
  const double from = proof_time_of(m, k);
  const double f = m->timed ? (t - from) / (proof_time_of(m, k + 1) - from)
                            : t * (double)(m->count - 1) - (double)k;
  double product = 0;
  double apart = 0;
  double together = 0;
  double q[4];
  for (int i = 0; i < 4; i++)
    product += (double)m->raw[k].rotation[i] * (double)m->raw[k + 1].rotation[i];
  for (int i = 0; i < 4; i++) {
    q[i] = product < 0 ? -b->rotation[i] : b->rotation[i];
    apart += (q[i] - a->rotation[i]) * (q[i] - a->rotation[i]);
    together += (q[i] + a->rotation[i]) * (q[i] + a->rotation[i]);
  }
  const double half = 2 * atan2(sqrt(apart), sqrt(together));
  const double before = half > 1e-9 ? sin((1 - f) * half) / sin(half) : 1 - f;
  const double after = half > 1e-9 ? sin(f * half) / sin(half) : f;
  oracle_pose out;
  double pivots[2][3], arm[3];
  for (int i = 0; i < 4; i++) out.rotation[i] = before * a->rotation[i] + after * q[i];
  oracle_quat_normalize(out.rotation);
  proof_pivot_of(m, a, pivots[0]);
  proof_pivot_of(m, b, pivots[1]);
  proof_pivot_arm(m, &out, arm);
  for (int i = 0; i < 3; i++)
    out.position[i] = pivots[0][i] + f * (pivots[1][i] - pivots[0][i]) - arm[i];
  return out;
}
static proof_place proof_place_at(const proof_motion *m, double t) {
  const oracle_pose pose = proof_pose_at(&m->moving, t);
  const oracle_pose fixed = proof_pose_at(&m->fixed, t);
  const double scale = (double)m->moving.scale / (double)m->fixed.scale;
  proof_place at = proof_relative(&pose, &fixed);
  for (int k = 0; k < 9; k++) at.matrix[k] *= scale;
  for (int k = 0; k < 3; k++) at.position[k] /= (double)m->fixed.scale;
  return at;
}
static void proof_apply(const proof_place *at, const double *x, double *out) {
  double turned[3];
  oracle_rotate(at->matrix, x, turned);
  for (int k = 0; k < 3; k++) out[k] = turned[k] + at->position[k];
}

// -------------------------------------------------------------------------------------------------
// bodies

enum { SOLID, HOLLOW, BOX, BLOCK, PLATE, SHEET, SHELL, NEEDLE, TRIANGLE, BALL, KINDS };

// A wavy sheet, open.
static void proof_sheet(shapes_mesh *mesh, double size, int cuts) {
  for (int i = 0; i <= cuts; i++) {
    for (int j = 0; j <= cuts; j++) {
      const double x = size * ((double)i / cuts - 0.5);
      const double y = size * ((double)j / cuts - 0.5);
      shapes_vertex(mesh, x, y, 0.05 * size * sin(9 * x / size) * cos(7 * y / size));
    }
  }
  for (int i = 0; i < cuts; i++) {
    for (int j = 0; j < cuts; j++) {
      const uint32_t at = (uint32_t)(i * (cuts + 1) + j);
      shapes_quad(mesh, at, at + (uint32_t)cuts + 1, at + (uint32_t)cuts + 2, at + 1);
    }
  }
}

static void proof_shape(int kind, uint64_t seed, shapes_mesh *mesh) {
  shapes_rng rng = {seed};
  memset(mesh, 0, sizeof *mesh);
  if (kind == SOLID) shapes_random_solid(mesh, &rng, shapes_uniform(&rng, 0.1, 0.4));
  if (kind == HOLLOW) shapes_random_hollow(mesh, &rng, (int)(seed % SHAPES_HOLLOWS), 0.4);
  if (kind == BOX) shapes_box(mesh, 0.2, 0.15, 0.1, 4);
  if (kind == BLOCK) shapes_box(mesh, 0.3, 0.3, 0.1, 1);  // two triangles a side: listed in parts
  if (kind == PLATE) shapes_box(mesh, 0.3, 0.2, 0.001, 3);
  if (kind == SHEET) proof_sheet(mesh, 0.3, 8);
  if (kind == SHELL) shapes_shell(mesh, 0.4, 0.35, 0.3, 0.02, (int)(seed % 2), 20);
  if (kind == NEEDLE) shapes_box(mesh, 0.5, 5e-5, 5e-5, 2);
  if (kind == BALL) shapes_ellipsoid(mesh, 0.11, 0.09, 0.07, 24);
  if (kind != TRIANGLE) return;
  const uint32_t a = shapes_vertex(mesh, 0.1, 0, 0);
  const uint32_t b = shapes_vertex(mesh, -0.05, 0.1, 0.01);
  shapes_triangle(mesh, a, b, shapes_vertex(mesh, -0.04, -0.1, -0.02));
}

static proof_body proof_make(int kind, uint64_t seed, size_t points, double scale) {
  shapes_mesh shape;
  const nsvcd_encode_options options = {.patches = points,
                                        .open = kind == SHEET || kind == TRIANGLE};
  proof_shape(kind, seed, &shape);
  return proof_encode(&shape, scale, &options);
}

// Bodies of one scale, shared by the tests; made once.
#define SCALES 6
#define MAKES 18
static const double proof_scales[SCALES] = {1, 1e-10, 1e-6, 1e3, 3e5, 3e-11};

static const proof_body *proof_shared(size_t scale, size_t n) {
  static const struct {
    int kind;
    uint64_t seed;
    size_t points;
  } makes[MAKES] = {{SOLID, 1, 64},    {SOLID, 2, 16},   {SOLID, 3, 128},  {HOLLOW, 4, 64},
                    {HOLLOW, 12, 128}, {BOX, 6, 32},     {BLOCK, 7, 48},   {PLATE, 8, 40},
                    {SHEET, 9, 32},    {SHELL, 10, 64},  {NEEDLE, 11, 24}, {TRIANGLE, 12, 1},
                    {BALL, 13, 100},   {SOLID, 14, 256}, {BLOCK, 15, 3},   {HOLLOW, 21, 96},
                    {SOLID, 17, 1},    {BALL, 18, 4}};
  static proof_body bodies[SCALES][MAKES];
  proof_body *b = &bodies[scale][n];
  if (!b->body) *b = proof_make(makes[n].kind, makes[n].seed, makes[n].points, proof_scales[scale]);
  return b;
}

static void *proof_workspace(void) {
  static void *memory;
  if (!memory) memory = malloc(nsvcd_sweep_workspace_size(NULL));
  if (!memory) exit(1);
  return memory;
}

static nsvcd_question proof_options(void) {
  nsvcd_question options;
  memset(&options, 0, sizeof options);
  options.method = NSVCD_METHOD_PROOF;
  return options;
}

#endif
