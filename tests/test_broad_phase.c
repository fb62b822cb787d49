// Body blobs, the motion, the broad phase and containment. The reference is double precision and
// written apart.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "any_query.h"
#include "ask.h"
#include "check.h"

#include <time.h>

void test_broad_phase(void);

// ----------------------------------------------------------------------------------- random bodies

static uint64_t rng_state = 1;
static double uniform(double low, double high) {  // splitmix64 (Vigna)
  uint64_t x = (rng_state += 0x9e3779b97f4a7c15u);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  x ^= x >> 31;
  return low + (high - low) * (double)(x >> 11) / 9007199254740992.0;
}
static size_t pick(size_t low, size_t high) {
  return low + (size_t)uniform(0, (double)(high - low + 1));
}

#define BLOB 65536
typedef union blob {
  uint64_t align[BLOB / 8];
  char bytes[BLOB];
} blob;
static blob blob_a_memory, blob_b_memory;
static char *aligned(blob *b) { return b->bytes + (16 - (uintptr_t)b->bytes % 16) % 16; }
static const size_t blob_capacity = BLOB - 16;

static float centres[3 * NSVCD_SMALL_POINTS], radii[NSVCD_SMALL_POINTS],
    areas[3 * NSVCD_SMALL_POINTS];
static int8_t latents[NSVCD_SMALL_POINTS * NSVCD__LATENT];

// Puts the patches of `centres` in order (points).
static void put_in_order(size_t points, uint16_t *order) {
  uint16_t spare[NSVCD_SMALL_POINTS];
  const nsvcd__f3 *at = (const nsvcd__f3 *)(const void *)centres;
  const nsvcd__ordering all = {at, order, spare, points};
  for (size_t i = 0; i < points; i++)
    order[i] = (uint16_t)i;
  nsvcd__body_order(all);
}

static const nsvcd_body *build(size_t points, blob *memory) {
  const nsvcd_body *body = NULL;
  uint16_t order[NSVCD_SMALL_POINTS];
  nsvcd__latents_source source;
  put_in_order(points, order);
  source.count = points;
  source.centres = (const nsvcd__f3 *)(const void *)centres;
  source.radii = radii;
  source.areas = (const nsvcd__f3 *)(const void *)areas;
  source.latents = latents;
  source.order = order;
  source.weights_id = NSVCD_WEIGHTS_ID;
  source.open = 0;
  CHECK_EQ(nsvcd__body_build(&source, aligned(memory), blob_capacity, &body), NSVCD_OK);
  return body;
}

// Spheres strewn in a box of the given size whose middle is `offset` away from the body's origin.
static const nsvcd_body *random_body(size_t points, double size, double offset, blob *memory) {
  for (size_t i = 0; i < points; i++) {
    for (size_t k = 0; k < 3; k++) {
      centres[3 * i + k] = (float)(uniform(-0.5, 0.5) * size + (k == 1 ? offset : 0));
      areas[3 * i + k] = (float)(uniform(-1, 1) * size * size);
    }
    radii[i] = (float)(size * uniform(0, 1.0 / cbrt((double)points)) * 0.3);
    for (size_t k = 0; k < NSVCD__LATENT; k++)
      latents[NSVCD__LATENT * i + k] = (int8_t)pick(0, 200);
  }
  return build(points, memory);
}

// Points spread evenly over a sphere (spiral), as closed patches that cover it; the radius covers
// the patch.
static const nsvcd_body *shell_body(size_t points, double radius, blob *memory) {
  double area = 4 * 3.14159265358979 * radius * radius / (double)points;
  for (size_t i = 0; i < points; i++) {
    double z = 1 - (2.0 * (double)i + 1) / (double)points;
    double s = sqrt(1 - z * z);
    double angle = 2.39996322973 * (double)i;
    double n[3] = {s * cos(angle), s * sin(angle), z};
    for (size_t k = 0; k < 3; k++) {
      centres[3 * i + k] = (float)(radius * n[k]);
      areas[3 * i + k] = (float)(area * n[k]);
    }
    radii[i] = (float)(1.3 * sqrt(area / 3.14159265358979));
  }
  memset(latents, 1, sizeof latents);
  return build(points, memory);
}

static size_t body_bytes(const nsvcd_body *body) { return nsvcd_body_size(body->points); }

// -------------------------------------------------------------------------------------- blob tests

static void body_round_trip(void) {
  CHECK_EQ(sizeof(struct nsvcd_body), 64);
  CHECK_EQ(nsvcd_body_size(0), 0);
  CHECK_EQ(nsvcd_body_size(NSVCD_MAX_POINTS + 1), 0);
  CHECK_LE(nsvcd_body_size(512), 65535);
  for (size_t points = 1; points <= 512; points += points < 20 ? 1 : 41) {
    const nsvcd_body *body = random_body(points, 1, 0.3, &blob_a_memory);
    const nsvcd_body *loaded = NULL;
    memcpy(aligned(&blob_b_memory), body, body_bytes(body));
    CHECK_EQ(nsvcd_body_load(aligned(&blob_b_memory), body_bytes(body), &loaded), NSVCD_OK);
    CHECK((const void *)loaded == (const void *)aligned(&blob_b_memory));
    // The same patches, in another order: sums over patches of invariants of (x, r, area, latent)
    // agree.
    double want = 0;
    double got = 0;
    for (size_t i = 0; i < points; i++) {
      want += (double)(centres[3 * i] * areas[3 * i + 2] * radii[i]) *
              latents[NSVCD__LATENT * (i + 1) - 1];
      got += (double)(nsvcd__body_x(body)[i] * nsvcd__body_areas(body)[2 * body->padded + i] *
                      nsvcd__body_r(body)[i]) *
             nsvcd__body_latents(body)[NSVCD__LATENT * (i + 1) - 1];
    }
    CHECK_NEAR(want, got, 1e-9 * (fabs(want) + 1));
    for (size_t i = points; i < body->padded; i++)
      CHECK(nsvcd__body_r(body)[i] <= -1e14f);
  }
}

// The order visits every patch once, and neighbours end up together: groups are much smaller than
// the body.
static void body_order(void) {
  uint16_t order[NSVCD_SMALL_POINTS];
  for (size_t points = 1; points <= 512; points += 37) {
    const nsvcd_body *body = random_body(points, 1, 0, &blob_a_memory);
    int seen[NSVCD_SMALL_POINTS] = {0};
    put_in_order(points, order);
    for (size_t i = 0; i < points; i++)
      seen[order[i]]++;
    for (size_t i = 0; i < points; i++)
      CHECK_EQ(seen[i], 1);
    size_t groups = nsvcd__body_groups(body);
    for (size_t g = 0; g < groups; g++) {
      for (size_t i = NSVCD__GROUP * g; i < NSVCD__GROUP * (g + 1) && i < points; i++) {
        double dx = (double)nsvcd__body_x(body)[i] - (double)nsvcd__group_spheres(body).x[g];
        double dy = (double)nsvcd__body_y(body)[i] - (double)nsvcd__group_spheres(body).y[g];
        double dz = (double)nsvcd__body_z(body)[i] - (double)nsvcd__group_spheres(body).z[g];
        double far = sqrt(dx * dx + dy * dy + dz * dz) + (double)nsvcd__body_r(body)[i];
        CHECK_LE(far, nsvcd__group_spheres(body).r[g]);
      }
    }
    double sum = 0;
    for (size_t g = 0; g < groups; g++)
      sum += (double)nsvcd__group_spheres(body).r[g];
    if (points > 256)
      CHECK_LE(sum / (double)groups, 0.45 * (double)body->radius);
  }
}

// Whatever one byte becomes, the blob is refused: the checksum's steps are bijections. Cut short:
// refused.
static void body_corruption(void) {
  const nsvcd_body *body = random_body(9, 1, 0, &blob_a_memory);
  const nsvcd_body *loaded = NULL;
  size_t size = body_bytes(body);
  char *copy = aligned(&blob_b_memory);
  size_t tried = 0;
  size_t refused = 0;
  for (size_t at = 0; at < size; at++) {
    for (int flip = 1; flip < 256; flip++) {
      memcpy(copy, body, size);
      copy[at] = (char)(copy[at] ^ flip);
      tried++;
      refused += nsvcd_body_load(copy, size, &loaded) == NSVCD_ERROR_BODY;
    }
  }
  CHECK_EQ(tried, refused);
  memcpy(copy, body, size);
  for (size_t cut = 0; cut < size; cut++)
    CHECK_EQ(nsvcd_body_load(copy, cut, &loaded), NSVCD_ERROR_BODY);
  CHECK(loaded == NULL);  // outputs untouched
  memmove(copy + 4, copy, size);
  CHECK_EQ(nsvcd_body_load(copy + 4, size, &loaded), NSVCD_ERROR_BODY);
  CHECK_EQ(nsvcd_body_load(NULL, size, &loaded), NSVCD_ERROR_ARGUMENT);
}

// With a valid checksum, every float replaced by a harmful one in turn: refused, or harmless (an
// area vector).
static void body_malice(void) {
  // NaN, inf, -inf, 1.7e38
  const uint32_t bad[4] = {0x7fc00000u, 0x7f800000u, 0xff800000u, 0x7f000000u};
  const nsvcd_body *body = random_body(9, 1, 0, &blob_a_memory);
  const nsvcd_body *loaded = NULL;
  size_t size = body_bytes(body);
  size_t floats_end = size - 9 * NSVCD__LATENT;
  char *copy = aligned(&blob_b_memory);
  for (size_t at = offsetof(struct nsvcd_body, centre); at + 4 <= floats_end; at += 4) {
    if (at >= offsetof(struct nsvcd_body, open) && at < sizeof *body)
      continue;
    // the zeros at the end shift the latents' start by up to 15 bytes
    if (at + 16 > floats_end)
      continue;
    for (size_t n = 0; n < 4; n++) {
      memcpy(copy, body, size);
      memcpy(copy + at, &bad[n], 4);
      nsvcd_body *evil = (nsvcd_body *)(void *)copy;
      evil->checksum = nsvcd__body_checksum(evil);
      CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
    }
  }
  memcpy(copy, body, size);  // group and bounding spheres that do not cover
  nsvcd_body *evil = (nsvcd_body *)(void *)copy;
  float *group_r =
      (float *)(void *)(copy + ((const char *)nsvcd__group_spheres(body).r - (const char *)body));
  group_r[0] *= 0.99f;
  evil->checksum = nsvcd__body_checksum(evil);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
  memcpy(copy, body, size);
  evil->radius *= 0.99f;
  evil->checksum = nsvcd__body_checksum(evil);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
  memcpy(copy, body, size);
  evil->extent *= 0.99f;
  evil->checksum = nsvcd__body_checksum(evil);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
  memcpy(copy, body, size);
  evil->weights_id++;
  evil->checksum = nsvcd__body_checksum(evil);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
}

static void body_scale(void) {
  const float scales[5] = {0.25f, 1, 3.7f, 1e-4f, 1e4f};
  for (size_t n = 0; n < 5; n++) {
    const nsvcd_body *body = random_body(77, 1, 0.5, &blob_a_memory);
    const nsvcd_body *scaled = NULL;
    const nsvcd_body *loaded = NULL;
    char *memory = aligned(&blob_b_memory);
    double s = (double)scales[n];
    CHECK_EQ(nsvcd_body_scale(body, scales[n], memory, blob_capacity, &scaled), NSVCD_OK);
    CHECK_EQ(nsvcd_body_load(memory, body_bytes(body), &loaded), NSVCD_OK);
    for (size_t i = 0; i < 77; i++) {
      CHECK_NEAR(nsvcd__body_z(scaled)[i], s * (double)nsvcd__body_z(body)[i], 1e-6 * s);
      CHECK_NEAR(nsvcd__body_r(scaled)[i], s * (double)nsvcd__body_r(body)[i], 1e-6 * s);
      CHECK_NEAR(nsvcd__body_areas(scaled)[i], s * s * (double)nsvcd__body_areas(body)[i],
                 1e-6 * s * s);
    }
    CHECK(memcmp(nsvcd__body_latents(scaled), nsvcd__body_latents(body), 77 * NSVCD__LATENT) == 0);
    CHECK_NEAR(scaled->radius, s * (double)body->radius, 1e-4 * s);
  }
  const nsvcd_body *body = random_body(20, 1, 0, &blob_a_memory);
  const nsvcd_body *scaled = NULL;
  char *memory = aligned(&blob_b_memory);
  CHECK_EQ(nsvcd_body_scale(body, 0, memory, blob_capacity, &scaled), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_body_scale(body, -1, memory, blob_capacity, &scaled), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_body_scale(body, (float)NAN, memory, blob_capacity, &scaled),
           NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_body_scale(body, 1e30f, memory, blob_capacity, &scaled), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_body_scale(body, 1, memory, body_bytes(body) - 1, &scaled), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_body_scale(body, 1, memory + 4, blob_capacity - 4, &scaled),
           NSVCD_ERROR_WORKSPACE);
  CHECK(scaled == NULL);
}

// -------------------------------------------------------------------------------------- the motion

// As nsvcd_sweep does; bodies do not matter to it.
static nsvcd_result motion_init(const nsvcd_pose *samples, size_t count,
                                const nsvcd_pose *fixed_pose, nsvcd__motion *motion) {
  static const struct nsvcd_body any = {0};
  const nsvcd_question question = question_of(&any, samples, count, &any, fixed_pose, NULL);
  nsvcd_result result = nsvcd__mover_check(&question.a);
  if (!result)
    result = nsvcd__mover_check(&question.b);
  if (!result)
    nsvcd__motion_init(&question.a, &question.b, motion);
  return result;
}

static nsvcd_pose poses[NSVCD_MAX_POSES];
static nsvcd__search *work;
static nsvcd__candidate items[1 << 20], few[64];

static int deepest_first(const void *a, const void *b) {
  return nsvcd__is_shallower((const nsvcd__candidate *)a, (const nsvcd__candidate *)b) ? 1 : -1;
}

// The whole search: counts all runs, keeps the `limit` deepest in `found`, deepest first.
static void search(const nsvcd_body *moving, const nsvcd_body *fixed, nsvcd__motion *motion,
                   nsvcd__search *space, nsvcd__candidate *found, size_t limit,
                   nsvcd__candidates *kept) {
  nsvcd__cut_motion(motion, moving->extent + fixed->extent, space);
  int more = nsvcd__search_begin(moving, fixed, space);
  nsvcd__candidates_start(kept, found, limit);
  while (more)
    more = nsvcd__search_step(space, moving, fixed, kept);
  qsort(found, kept->count, sizeof *found, deepest_first);
}

typedef struct pose64 {
  double q[4], p[3];
} pose64;

static pose64 to_double(const nsvcd_pose *pose) {
  pose64 out;
  double square = 0;
  for (int k = 0; k < 4; k++) {
    out.q[k] = (double)pose->rotation[k];
    square += out.q[k] * out.q[k];
  }
  for (int k = 0; k < 4; k++)
    out.q[k] /= sqrt(square);
  for (int k = 0; k < 3; k++)
    out.p[k] = (double)pose->position[k];
  return out;
}

// v + 2 w (u x v) + 2 u x (u x v)
static void rotate64(const double *q, const double *v, double *out) {
  double c[3] = {q[1] * v[2] - q[2] * v[1], q[2] * v[0] - q[0] * v[2], q[0] * v[1] - q[1] * v[0]};
  double d[3] = {q[1] * c[2] - q[2] * c[1], q[2] * c[0] - q[0] * c[2], q[0] * c[1] - q[1] * c[0]};
  for (int k = 0; k < 3; k++)
    out[k] = v[k] + 2 * (q[3] * c[k] + d[k]);
}

// FORMATS.md's motion, in double.
static pose64 pose_at(const nsvcd_pose *samples, size_t count, double t) {
  if (count == 1)
    return to_double(&samples[0]);
  double at = t * (double)(count - 1);
  size_t k = (size_t)at;
  if (k > count - 2)
    k = count - 2;
  double u = at - (double)k;
  double dot = 0;
  pose64 a = to_double(&samples[k]);
  pose64 b = to_double(&samples[k + 1]);
  pose64 out;
  for (int i = 0; i < 4; i++)
    dot += a.q[i] * b.q[i];
  for (int i = 0; i < 4 && dot < 0; i++)
    b.q[i] = -b.q[i];
  double angle = acos(fmin(fabs(dot), 1));
  double wa = 1 - u;
  double wb = u;
  double square = 0;
  if (angle > 1e-7) {
    wa = sin((1 - u) * angle) / sin(angle);
    wb = sin(u * angle) / sin(angle);
  }
  for (int i = 0; i < 4; i++) {
    out.q[i] = wa * a.q[i] + wb * b.q[i];
    square += out.q[i] * out.q[i];
  }
  for (int i = 0; i < 4; i++)
    out.q[i] /= sqrt(square);
  for (int i = 0; i < 3; i++)
    out.p[i] = (1 - u) * a.p[i] + u * b.p[i];
  return out;
}

// A body-frame point of the moving body at time t, in the fixed body's frame.
static void place64(const pose64 *at, const pose64 *fixed, const double *point, double *out) {
  double world[3];
  double back[4] = {-fixed->q[0], -fixed->q[1], -fixed->q[2], fixed->q[3]};
  rotate64(at->q, point, world);
  for (int k = 0; k < 3; k++)
    world[k] += at->p[k] - fixed->p[k];
  rotate64(back, world, out);
}

static void random_quat(float *q) {
  double v[4];
  double square = 0;
  do {
    square = 0;
    for (int k = 0; k < 4; k++) {
      v[k] = uniform(-1, 1);
      square += v[k] * v[k];
    }
  } while (square > 1 || square < 0.01);
  for (int k = 0; k < 4; k++)
    q[k] = (float)(v[k] / sqrt(square));
}

// Kinds: 0 smooth, turning by `turn` in all about one axis; 1 smooth with a wobble; 2 jumping at
// random.
static void random_motion(size_t count, int kind, double turn, double path, const double *middle) {
  double axis[3], along[3], start[4];
  float q[4];
  random_quat(q);
  double length = sqrt((double)(q[0] * q[0] + q[1] * q[1] + q[2] * q[2])) + 1e-9;
  for (int k = 0; k < 3; k++) {
    axis[k] = (double)q[k] / length;
    along[k] = uniform(-1, 1) * path;
  }
  random_quat(q);
  for (int k = 0; k < 4; k++)
    start[k] = (double)q[k];
  for (size_t n = 0; n < count; n++) {
    double t = count > 1 ? (double)n / (double)(count - 1) : 0.5;
    double half = 0.5 * turn * t;
    double s = sin(half);
    double c = cos(half);
    double wobble = kind == 1 ? 0.3 * sin(7 * t) : 0;
    const double *b = start;
    const double a[4] = {s * axis[0], s * axis[1], s * axis[2], c};
    poses[n].rotation[0] = (float)(a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1]);
    poses[n].rotation[1] = (float)(a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0]);
    poses[n].rotation[2] = (float)(a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3]);
    poses[n].rotation[3] = (float)(a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]);
    for (int k = 0; k < 3; k++) {
      poses[n].position[k] =
          (float)(middle[k] + along[k] * (t - 0.5) + (k == 0 ? wobble * path : 0));
    }
    if (kind == 2) {
      random_quat(poses[n].rotation);
      for (int k = 0; k < 3; k++)
        poses[n].position[k] = (float)(middle[k] + uniform(-1, 1) * path);
    }
    double sign = uniform(-1, 1) < 0 ? -1 : 1;
    double scale = sign * uniform(1 - 9e-5, 1 + 9e-5);  // still unit to 1e-4
    for (int k = 0; k < 4; k++)
      poses[n].rotation[k] = (float)((double)poses[n].rotation[k] * scale);
  }
}

static void motion_pose_is_slerp(void) {
  double worst = 0;
  for (int trial = 0; trial < 300; trial++) {
    double middle[3] = {uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)};
    size_t count = pick(1, 40);
    nsvcd_pose fixed = {{1, -2, 0.5f}, {0, 0, 0, 1}};
    random_quat(fixed.rotation);
    random_motion(count, trial % 3, uniform(0, 12), 1, middle);
    nsvcd__motion motion;
    CHECK_EQ(motion_init(poses, count, &fixed, &motion), NSVCD_OK);
    for (int n = 0; n <= 10; n++) {
      float t = n == 10 ? 1 : (float)uniform(0, 1);
      float rotation[9];
      float position[3];
      float out[3];
      const float point[3] = {0.3f, -0.2f, 0.9f};
      const double point64[3] = {(double)point[0], (double)point[1], (double)point[2]};
      double want[3];
      pose64 at = pose_at(poses, count, (double)t);
      pose64 f = to_double(&fixed);
      place64(&at, &f, point64, want);
      nsvcd__motion_pose(&motion, t, rotation, position);
      nsvcd__mul33_vec(rotation, point, out);
      for (int k = 0; k < 3; k++)
        worst = fmax(worst, fabs((double)(out[k] + position[k]) - want[k]));
    }
  }
  CHECK_LE(worst, 3e-5);  // t itself is rounded: 40 samples of speed 6 between them, times 6e-8
}

// Sixteen poses at once are the pose one by one.
static void poses_at_are_poses(void) {
  double worst = 0;
  for (int trial = 0; trial < 300; trial++) {
    double middle[3] = {uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)};
    size_t count = pick(1, 40);
    nsvcd_pose fixed = {{1, -2, 0.5f}, {0, 0, 0, 1}};
    float times[NSVCD__LANES], lanes[12][NSVCD__LANES];
    nsvcd__motion motion;
    random_quat(fixed.rotation);
    random_motion(count, trial % 3, uniform(0, 12), 1, middle);
    CHECK_EQ(motion_init(poses, count, &fixed, &motion), NSVCD_OK);
    for (size_t l = 0; l < NSVCD__LANES; l++)
      times[l] = l == 0 ? 0 : l == 1 ? 1 : (float)uniform(0, 1);
    NSVCD__EACH_SLICE(l) {
      nsvcd__v q[4], p[3], m[9];
      nsvcd__v_poses_at(&motion, times + l, NSVCD__SLICE, q, p);
      nsvcd__v_matrix(q, m);
      for (size_t k = 0; k < 9; k++)
        nsvcd__v_store(lanes[k] + l, m[k]);
      for (size_t k = 0; k < 3; k++)
        nsvcd__v_store(lanes[9 + k] + l, p[k]);
    }
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      float rotation[9], position[3];
      nsvcd__motion_pose(&motion, times[l], rotation, position);
      for (size_t k = 0; k < 9; k++)
        worst = fmax(worst, fabs((double)(lanes[k][l] - rotation[k])));
      for (size_t k = 0; k < 3; k++)
        worst = fmax(worst, fabs((double)(lanes[9 + k][l] - position[k])));
    }
  }
  CHECK_LE(worst, 1e-5);
}

// Half the rotation vector of a quaternion, at every angle including 0 and pi.
static void half_rotation_vector(void) {
  const double angles[12] = {0, 1e-8, 1e-6, 1e-4, 1e-2, 0.5, 1.04, 1.05, 1.5, 3, 3.14, 3.1415};
  for (int trial = 0; trial < 1200; trial++) {
    float random[4], lane[NSVCD__SLICE];
    double axis[3];
    double length;
    double angle = angles[trial % 12];
    double s = sin(angle / 2);
    double sign = trial % 5 ? 1 : -1;
    random_quat(random);
    length = sqrt((double)(random[0] * random[0] + random[1] * random[1] + random[2] * random[2]));
    for (int k = 0; k < 3; k++)
      axis[k] = (double)random[k] / length;
    nsvcd__v q[4], w[3];
    for (int k = 0; k < 3; k++)
      q[k] = nsvcd__v_set((float)(sign * s * axis[k]));
    q[3] = nsvcd__v_set((float)(sign * cos(angle / 2)));
    nsvcd__v_half_rotation(q, w);
    for (int k = 0; k < 3; k++) {
      nsvcd__v_store(lane, w[k]);
      CHECK_NEAR(lane[trial % NSVCD__SLICE], 0.5 * angle * axis[k], 3e-6);
    }
  }
}

static void bad_poses(void) {
  nsvcd_pose good = {{0, 0, 0}, {0, 0, 0, 1}};
  nsvcd__motion motion;
  memset(&motion, 7, sizeof motion);
  nsvcd__motion before = motion;
  for (int n = 0; n < 5; n++)
    poses[n] = good;
  CHECK_EQ(motion_init(poses, 0, &good, &motion), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(motion_init(poses, (size_t)NSVCD_MAX_POSES + 1, &good, &motion), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(motion_init(NULL, 5, &good, &motion), NSVCD_ERROR_ARGUMENT);
  const float bad[6] = {(float)NAN, (float)INFINITY, -(float)INFINITY, 3e38f, 2e6f, 1e30f};
  for (int at = 0; at < 7; at++) {
    for (int n = 0; n < 6; n++) {
      nsvcd_pose evil = good;
      *(at < 3 ? &evil.position[at] : &evil.rotation[at - 3]) = bad[n];
      CHECK_EQ(motion_init(poses, 5, &evil, &motion), NSVCD_ERROR_POSE);
      poses[4] = evil;
      CHECK_EQ(motion_init(poses, 5, &good, &motion), NSVCD_ERROR_POSE);
      poses[4] = good;
    }
  }
  const float lengths[6] = {0, 0.9998f, 1.0002f, 0.99995f, 1.00005f, 1};
  for (int n = 0; n < 6; n++) {
    nsvcd_pose q = good;
    q.rotation[3] = lengths[n];
    nsvcd__motion m;
    CHECK_EQ(motion_init(&q, 1, &good, &m), n < 3 ? NSVCD_ERROR_POSE : NSVCD_OK);
  }
  CHECK(memcmp(&motion, &before, sizeof motion) == 0);  // outputs untouched
}

// -------------------------------------------------------------------------------- conservativeness

static int by_pair(const void *a, const void *b) {
  const nsvcd__candidate *x = (const nsvcd__candidate *)a;
  const nsvcd__candidate *y = (const nsvcd__candidate *)b;
  if (x->moving != y->moving)
    return x->moving < y->moving ? -1 : 1;
  if (x->fixed != y->fixed)
    return x->fixed < y->fixed ? -1 : 1;
  return x->t_enter < y->t_enter ? -1 : x->t_enter > y->t_enter ? 1 : 0;
}

// Is t in one of the pair's intervals? Slack: times are floats, 1e-6.
static int is_covered(const nsvcd__candidate *sorted, size_t count, size_t i, size_t j, double t) {
  size_t low = 0;
  size_t high = count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    const nsvcd__candidate *c = &sorted[middle];
    if (c->moving < i || (c->moving == i && c->fixed < j))
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < count && sorted[low].moving == i && sorted[low].fixed == j; low++) {
    if ((double)sorted[low].t_enter - 1e-6 <= t && t <= (double)sorted[low].t_exit + 1e-6)
      return 1;
  }
  return 0;
}

typedef struct tally {
  size_t motions, tested, overlaps, lost, free_motions, runs, runs_real, kept_wrong;
} tally;

// One motion: candidates against spheres sampled densely in time.
static void try_motion(const nsvcd_body *moving, const nsvcd_body *fixed, size_t count,
                       const nsvcd_pose *fixed_pose, size_t samples, tally *sum) {
  static unsigned char pair_met[NSVCD_SMALL_POINTS][NSVCD_SMALL_POINTS];
  nsvcd__motion motion;
  CHECK_EQ(motion_init(poses, count, fixed_pose, &motion), NSVCD_OK);
  nsvcd__candidates all, best;
  search(moving, fixed, &motion, work, items, sizeof items / sizeof *items, &all);
  CHECK_EQ(all.count, all.total);
  size_t limit = pick(1, 64);
  search(moving, fixed, &motion, work, few, limit, &best);
  CHECK_EQ(best.total, all.total);
  CHECK_EQ(best.count, all.total < limit ? all.total : limit);
  for (size_t n = 0; n < best.count; n++)
    sum->kept_wrong += memcmp(&few[n], &items[n], sizeof few[n]) != 0;
  for (size_t n = 1; n < all.count; n++)
    CHECK(items[n - 1].depth >= items[n].depth);
  for (size_t n = 0; n < all.count; n++) {
    const nsvcd__candidate *c = &items[n];
    CHECK(0 <= c->t_enter && c->t_enter <= c->t_least && c->t_least <= c->t_exit && c->t_exit <= 1);
    CHECK(c->moving < moving->points && c->fixed < fixed->points);
  }
  qsort(items, all.count, sizeof *items, by_pair);
  sum->motions++;
  sum->free_motions += all.total == 0;
  sum->runs += all.total;

  memset(pair_met, 0, sizeof pair_met);
  pose64 f = to_double(fixed_pose);
  for (size_t n = 0; n < samples; n++) {
    // A third of the samples exactly on the poses, the rest anywhere.
    double t =
        n % 3 || count == 1 ? uniform(0, 1) : (double)pick(0, count - 1) / (double)(count - 1);
    pose64 at = pose_at(poses, count, t);
    for (size_t i = 0; i < moving->points; i++) {
      double c[3] = {(double)nsvcd__body_x(moving)[i], (double)nsvcd__body_y(moving)[i],
                     (double)nsvcd__body_z(moving)[i]};
      double p[3];
      double ri = (double)nsvcd__body_r(moving)[i];
      place64(&at, &f, c, p);
      for (size_t j = 0; j < fixed->points; j++) {
        double d[3] = {p[0] - (double)nsvcd__body_x(fixed)[j],
                       p[1] - (double)nsvcd__body_y(fixed)[j],
                       p[2] - (double)nsvcd__body_z(fixed)[j]};
        double r = ri + (double)nsvcd__body_r(fixed)[j];
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > r * r)
          continue;
        sum->overlaps++;
        pair_met[i][j] = 1;
        sum->lost += !is_covered(items, all.count, i, j, t);
      }
    }
    sum->tested += (size_t)moving->points * fixed->points;
  }
  for (size_t n = 0; n < all.count; n++)
    sum->runs_real += pair_met[items[n].moving][items[n].fixed];
}

static void print_tally(const char *name, const tally *t) {
  printf(
      "  %-12s %5zu motions, %9zu sphere tests, %8zu overlaps, %zu lost; %4zu free; %zu runs, %.1f "
      "%% not met\n",
      name, t->motions, t->tested, t->overlaps, t->lost, t->free_motions, t->runs,
      100.0 * (double)(t->runs - t->runs_real) / (double)(t->runs + (t->runs == 0)));
}

// `turn` in radians; bodies of `size_a` and `size_b`, in a scene `away` from the origin.
static void conservative(const char *name, int motions, int kind, double turn, size_t least_count,
                         size_t most_count, double size_a, double size_b, double away) {
  tally sum;
  memset(&sum, 0, sizeof sum);
  rng_state = 12345;
  for (int n = 0; n < motions; n++) {
    const nsvcd_body *moving = random_body(pick(1, 40), size_a, n % 2 ? 0 : size_a, &blob_a_memory);
    const nsvcd_body *fixed = random_body(pick(1, 40), size_b, 0, &blob_b_memory);
    double apart = uniform(0, 1.5) * (size_a + size_b);
    double middle[3];
    nsvcd_pose fixed_pose = {{0, 0, 0}, {0, 0, 0, 1}};
    random_quat(fixed_pose.rotation);
    for (int k = 0; k < 3; k++) {
      fixed_pose.position[k] = (float)(away * uniform(0.5, 1));
      middle[k] = (double)fixed_pose.position[k] + (k == n % 3 ? apart : 0);
    }
    size_t count = pick(least_count, most_count);
    random_motion(count, kind, turn * uniform(0, 1), uniform(0, 2) * (size_a + size_b), middle);
    try_motion(moving, fixed, count, &fixed_pose, 90, &sum);
  }
  print_tally(name, &sum);
  CHECK_EQ(sum.lost, 0);
  CHECK_EQ(sum.kept_wrong, 0);
  CHECK_GE(sum.overlaps, 100);  // else nothing was tested
}

static const double degrees = 3.14159265358979 / 180;

static void conservative_smooth(void) {
  conservative("smooth", 400, 0, 120 * degrees, 2, 40, 1, 1, 0);
}
static void conservative_wobble(void) {
  conservative("wobble", 300, 1, 120 * degrees, 1, 200, 1, 1, 0);
}
static void conservative_spin(void) {
  conservative("720 degrees", 400, 0, 720 * degrees, 9, 200, 1, 1, 0);
}
static void conservative_tumble(void) {
  conservative("50 turns", 100, 0, 18000 * degrees, 150, 200, 1, 1, 0);
}
static void conservative_jumps(void) { conservative("jumps", 200, 2, 0, 1, 200, 1, 1, 0); }
static void conservative_still(void) { conservative("single pose", 200, 0, 0, 1, 1, 1, 1, 0); }
static void conservative_far(void) { conservative("1 km away", 200, 0, 2, 2, 40, 0.1, 0.2, 1000); }
static void conservative_sizes(void) {
  conservative("1 : 1000", 100, 1, 2, 2, 40, 1e-3, 1, 0);
  conservative("1000 : 1", 100, 1, 2, 2, 40, 1, 1e-3, 0);
  conservative("10 km", 100, 1, 2, 2, 40, 1e4, 1e4, 0);
  conservative("micrometre", 100, 1, 2, 2, 40, 1e-6, 1e-6, 0);
}

// The bound itself: the true place of a point against its place on the chord, in double, at most
// dev apart. The points lie across the axis of rotation too, where the bound is attained: a bound
// that is a little too small fails here.
static void deviation_is_bounded(void) {
  const double paths[4] = {0, 1, 0, 0};
  const double aways[4] = {0, 0, 1000, 0};
  double most = 0;
  rng_state = 7;
  for (int trial = 0; trial < 2000; trial++) {
    size_t count = trial % 4 == 3 ? 2 : pick(1, 60);
    nsvcd_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
    double middle[3];
    random_quat(fixed.rotation);
    for (int k = 0; k < 3; k++) {
      fixed.position[k] = (float)(uniform(0.5, 1) * aways[trial % 4]);
      middle[k] = (double)fixed.position[k] + uniform(-1, 1);
    }
    random_motion(count, trial % 4 == 1 ? trial % 3 : 0, trial % 2 ? uniform(0, 12) : 0,
                  paths[trial % 4], middle);
    nsvcd__motion motion;
    CHECK_EQ(motion_init(poses, count, &fixed, &motion), NSVCD_OK);
    nsvcd__cut_motion(&motion, 1, work);
    pose64 f = to_double(&fixed);
    for (int n = 0; n < 200; n++) {
      float q[4], c[3];
      random_quat(q);
      double length = sqrt((double)(q[0] * q[0] + q[1] * q[1] + q[2] * q[2])) * 2;
      double p[3];
      double c64[3];
      double square = 0;
      for (int k = 0; k < 3; k++) {
        c[k] = (float)((double)q[k] / length);
        c64[k] = (double)c[k];
      }
      size_t s = pick(0, work->segments - 1);
      size_t l = s % NSVCD__LANES;
      double tau = uniform(0.4, 0.6);
      const nsvcd__segments *b = &work->blocks[s / NSVCD__LANES];
      double start = (double)work->time[s];
      pose64 at = pose_at(poses, count, start + tau * ((double)work->time[s + 1] - start));
      place64(&at, &f, c64, p);
      nsvcd__chords chords;
      const nsvcd__sphere point = {{c[0], c[1], c[2]}, 0};
      nsvcd__chords_of_sphere(b, point, &chords);
      const float x[3] = {chords.start[0][l], chords.start[1][l], chords.start[2][l]};
      const float v[3] = {chords.way[0][l], chords.way[1][l], chords.way[2][l]};
      for (int k = 0; k < 3; k++)
        square += pow((double)x[k] + tau * (double)v[k] - p[k], 2);
      CHECK_LE(sqrt(square), chords.reach[l]);
      if (trial % 4 == 3)
        most = fmax(most, sqrt(square) / (double)chords.reach[l]);
    }
  }
  printf("  the bound is attained to %.4f\n", most);
  CHECK_GE(most, 0.98);
}

// With all depths equal, which pairs are kept must not depend on the order in which they were
// found.
static void ties(void) {
  memset(centres, 0, sizeof centres);
  memset(areas, 0, sizeof areas);
  memset(latents, 0, sizeof latents);
  for (size_t i = 0; i < 40; i++)
    radii[i] = 1;
  const nsvcd_body *a = build(40, &blob_a_memory);
  const nsvcd_body *b = build(40, &blob_b_memory);
  nsvcd_pose fixed = {{0.5f, 0, 0}, {0, 0, 0, 1}};
  nsvcd__motion motion;
  nsvcd__candidates all, best;
  poses[0] = fixed;
  poses[0].position[0] = 0;
  CHECK_EQ(motion_init(poses, 1, &fixed, &motion), NSVCD_OK);
  search(a, b, &motion, work, items, 1600, &all);
  CHECK_EQ(all.total, 1600);
  for (size_t limit = 1; limit <= 64; limit++) {
    search(a, b, &motion, work, few, limit, &best);
    CHECK(memcmp(few, items, limit * sizeof *few) == 0);
    for (size_t n = 0; n < limit; n++)
      CHECK_EQ(few[n].moving * 40 + few[n].fixed, n);
  }
}

// A known case: two unit spheres, one passes the other at distance 1.5 along x from -5 to 5.
static void closed_form(void) {
  memset(latents, 0, sizeof latents);
  memset(areas, 0, sizeof areas);
  memset(centres, 0, sizeof centres);
  radii[0] = 1;
  const nsvcd_body *a = build(1, &blob_a_memory);
  const nsvcd_body *b = build(1, &blob_b_memory);
  nsvcd_pose fixed = {{0, 1.5f, 0}, {0, 0, 0, 1}};
  for (int n = 0; n < 2; n++) {
    poses[n] = fixed;
    poses[n].position[0] = n ? 5 : -5;
    poses[n].position[1] = 0;
  }
  nsvcd__motion motion;
  nsvcd__candidates kept;
  CHECK_EQ(motion_init(poses, 2, &fixed, &motion), NSVCD_OK);
  search(a, b, &motion, work, items, 8, &kept);
  CHECK_EQ(kept.total, 1);
  CHECK_NEAR(items[0].t_enter, 0.5 - sqrt(4 - 2.25) / 10, 1e-5);
  CHECK_NEAR(items[0].t_exit, 0.5 + sqrt(4 - 2.25) / 10, 1e-5);
  CHECK_NEAR(items[0].t_least, 0.5, 1e-6);
  CHECK_NEAR(items[0].depth, 0.25, 1e-6);
  search(a, b, &motion, work, items, 0, &kept);  // only counting
  CHECK_EQ(kept.total, 1);
  fixed.position[1] = 2.001f;
  CHECK_EQ(motion_init(poses, 2, &fixed, &motion), NSVCD_OK);
  search(a, b, &motion, work, items, 8, &kept);
  CHECK_EQ(kept.total, 0);
}

// One pair that overlaps throughout a full turn: runs follow each other without a hole, none turns
// over 45 degrees.
static void runs_are_cut(void) {
  memset(latents, 0, sizeof latents);
  memset(areas, 0, sizeof areas);
  memset(centres, 0, sizeof centres);
  radii[0] = 1;
  const nsvcd_body *a = build(1, &blob_a_memory);
  const nsvcd_body *b = build(1, &blob_b_memory);
  const double middle[3] = {0.1, 0, 0};
  nsvcd_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
  nsvcd__motion motion;
  nsvcd__candidates kept;
  random_motion(17, 0, 360 * degrees, 0, middle);
  CHECK_EQ(motion_init(poses, 17, &fixed, &motion), NSVCD_OK);
  search(a, b, &motion, work, items, 100, &kept);
  qsort(items, kept.count, sizeof *items, by_pair);
  CHECK_GE(kept.count, 8);
  CHECK_LE(kept.count, 17);
  CHECK_EQ(items[0].t_enter, 0);
  CHECK_EQ(items[kept.count - 1].t_exit, 1);
  for (size_t n = 0; n < kept.count; n++) {
    CHECK_LE((items[n].t_exit - items[n].t_enter) * 360, 46);
    if (n > 0)
      CHECK_EQ(items[n].t_enter, items[n - 1].t_exit);
  }
}

// ------------------------------------------------------------------------------------- containment

static void containment(void) {
  const float eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  // of the winding number, by clearance: 0.75-1, 1-1.5, 1.5-2, over 2 radii
  double error[4] = {0, 0, 0, 0};
  size_t clear = 0;
  size_t rough = 0;  // places from NSVCD__CLEARANCE on, and those whose error exceeds 0.3
  for (size_t points = 32; points <= 512; points *= 2) {
    const nsvcd_body *outer = shell_body(points, 1, &blob_a_memory);
    const nsvcd_body *inner = shell_body(64, 0.1, &blob_b_memory);
    double r = (double)nsvcd__body_r(outer)[0];
    for (int n = 0; n < 2000; n++) {
      float q[4];
      float rotation[9];
      float at[3] = {0, 0, 0};
      float way[3];
      random_quat(q);
      nsvcd__quat_normalize(q, q);
      nsvcd__quat_to_matrix(q, rotation);
      double distance = uniform(0, 2);
      for (int k = 0; k < 3; k++) {
        way[k] = rotation[3 * k];
        at[k] = (float)distance * way[k];
      }
      float places[3][NSVCD__PLACES], lanes[NSVCD__PLACES];
      for (int k = 0; k < 3 * NSVCD__PLACES; k++)
        places[k / NSVCD__PLACES][k % NSVCD__PLACES] = at[k / NSVCD__PLACES];
      nsvcd__clearances(outer, places, lanes);
      double clearance = sqrt((double)lanes[7]);
      int bin = clearance < 1 ? 0 : clearance < 1.5 ? 1 : clearance < 2 ? 2 : 3;
      double want = distance < 1 ? 1 : 0;
      double off = fabs((double)nsvcd__winding_number(outer, at) - want);
      if (clearance >= 0.75)
        error[bin] = fmax(error[bin], off);
      clear += clearance >= (double)NSVCD__CLEARANCE;
      rough += clearance >= (double)NSVCD__CLEARANCE && off > 0.3;
      // In the clear: exactly when it is inside. On the surface: anything. Outside: never.
      if (distance < 1 - 0.1 - r)
        CHECK(nsvcd__is_contained(inner, outer, 1, rotation, at));
      if (distance < 1 - 0.1 - r) {
        float back[9], from[3];
        nsvcd__transpose33(rotation, back);
        nsvcd__mul33_vec(back, at, from);
        for (int k = 0; k < 3; k++)
          from[k] = -from[k];
        CHECK(nsvcd__is_contained(outer, inner, 1, back, from));
      }
      if (distance > 1.1)
        CHECK(!nsvcd__is_contained(inner, outer, 1, rotation, at));
    }
    const float far[3] = {30, 0, 0};
    const float none[3] = {0, 0, 0};
    CHECK(!nsvcd__is_contained(inner, outer, 1, eye, far));
    CHECK(nsvcd__is_contained(inner, outer, 1, eye, none));
  }
  printf(
      "  winding number, worst error from 0.75 / 1 / 1.5 / 2 patch radii on: %.3f %.3f %.3f %.4f; "
      "over 0.3: %zu of "
      "%zu\n",
      error[0], error[1], error[2], error[3], rough, clear);
  CHECK_GE(clear, 5000);
  CHECK_LE(rough, clear / 1000);  // from NSVCD__CLEARANCE on; a verdict turns at 0.5
  CHECK_LE(error[3], 0.02);
}

// A hollow ball (two shells, the inner one turned inside out): its cavity is outside.
static void containment_in_a_cavity(void) {
  const float eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  shell_body(256, 0.6, &blob_a_memory);
  float inner_centres[3 * 256], inner_areas[3 * 256], inner_radii[256];
  memcpy(inner_centres, centres, sizeof inner_centres);
  memcpy(inner_areas, areas, sizeof inner_areas);
  memcpy(inner_radii, radii, sizeof inner_radii);
  shell_body(256, 1, &blob_a_memory);
  for (size_t n = 0; n < 3 * 256; n++) {
    centres[3 * 256 + n] = inner_centres[n];
    areas[3 * 256 + n] = -inner_areas[n];
  }
  for (size_t n = 0; n < 256; n++)
    radii[256 + n] = inner_radii[n];
  const nsvcd_body *hollow = build(512, &blob_a_memory);
  const nsvcd_body *ball = shell_body(32, 0.02, &blob_b_memory);
  const float middle[3] = {0, 0, 0};
  const float wall[3] = {0, 0.8f, 0};
  const float outside[3] = {1.4f, 0, 0};
  CHECK(!nsvcd__is_contained(ball, hollow, 1, eye, middle));
  CHECK(nsvcd__is_contained(ball, hollow, 1, eye, wall));
  CHECK(!nsvcd__is_contained(ball, hollow, 1, eye, outside));
}

// ------------------------------------------------------------------------------------------- speed

static int by_value(const void *a, const void *b) {
  double x = *(const double *)a;
  double y = *(const double *)b;
  return x < y ? -1 : x > y ? 1 : 0;
}

// Not a check: two shells of 0.1 m radius, path up to 0.4 m, turning up to 120 degrees, 17 poses, K
// = 8; a near miss to a graze (`gap` to 0.08 m between them at the middle), or nested deeply.
static void time_broad_phase(const char *name, double least_gap, double most_gap) {
  for (size_t points = 64; points <= 512; points *= 2) {
    double times[300], runs[300];
    rng_state = 99;
    const nsvcd_body *a = shell_body(points, 0.1, &blob_a_memory);
    const nsvcd_body *b = shell_body(points, 0.1, &blob_b_memory);
    for (int n = 0; n < 300; n++) {
      double middle[3] = {0.2 + uniform(least_gap, most_gap), 0, 0};
      nsvcd_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
      random_motion(17, 0, uniform(0, 120) * degrees, 0.2, middle);
      nsvcd__motion motion;
      nsvcd__candidates kept;
      clock_t start = clock();
      for (int repeat = 0; repeat < 50; repeat++) {
        motion_init(poses, 17, &fixed, &motion);
        search(a, b, &motion, work, few, 8, &kept);
      }
      times[n] = 1e6 * (double)(clock() - start) / CLOCKS_PER_SEC / 50;
      runs[n] = (double)kept.total;
    }
    qsort(times, 300, sizeof *times, by_value);
    qsort(runs, 300, sizeof *runs, by_value);
    printf(
        "  %s, N = %3zu: median %.2f us, 90 %% %.2f us, worst %.2f us; median %.0f runs, worst "
        "%.0f\n",
        name, points, times[150], times[270], times[299], runs[150], runs[299]);
  }
}

static void broad_phase_speed(void) {
  time_broad_phase("grazing", -0.01, 0.1);
  time_broad_phase("deep", -0.1, 0);
}

void test_broad_phase(void) {
  work = &any_query()->broad_phase;
  RUN(body_round_trip);
  RUN(body_order);
  RUN(body_corruption);
  RUN(body_malice);
  RUN(body_scale);
  RUN(motion_pose_is_slerp);
  RUN(poses_at_are_poses);
  RUN(half_rotation_vector);
  RUN(bad_poses);
  RUN(closed_form);
  RUN(ties);
  RUN(deviation_is_bounded);
  RUN(runs_are_cut);
  RUN(conservative_smooth);
  RUN(conservative_wobble);
  RUN(conservative_spin);
  RUN(conservative_tumble);
  RUN(conservative_jumps);
  RUN(conservative_still);
  RUN(conservative_far);
  RUN(conservative_sizes);
  RUN(containment);
  RUN(containment_in_a_cavity);
  RUN(broad_phase_speed);
}
