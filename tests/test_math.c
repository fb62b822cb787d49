// Vectors, quaternions and matrices as values, against double arithmetic that is written apart
// (examples/scenery/oracle.h); where numbers lie in rows; bits and sizes.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/ground/motions.h"
#include "../src/ground/spheres.h"
#include "../src/ground/bits.h"

#include "../examples/scenery/oracle.h"
#include "check.h"
#include "random_numbers.h"

void test_math(void);

#define MATH_ROUNDING 2.5e-7  // four roundings of a float, of the size of what is added up
#define MATH_TRIALS 20000

// ----------------------------------------------------------------------------------------- numbers

static float math_float_of(uint32_t bits) {
  float x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

// Every exponent with either sign, and mantissas about their ends: denormals, infinity and NaN are
// among them.
static void math_numbers_by_their_bits(void) {
  const uint32_t low[4] = {0, 1, 0x7fff, 0xffff};
  const uint32_t most = nsvcd__magnitude(FLT_MAX);
  size_t wrong = 0;
  for (uint32_t high = 0; high < 65536; high++) {
    for (size_t n = 0; n < 4; n++) {
      const float x = math_float_of(high << 16 | low[n]);
      wrong += nsvcd__is_finite(x) != (isfinite(x) != 0);
      wrong += (nsvcd__magnitude(x) <= most) != (isfinite(x) != 0);
      wrong += nsvcd__magnitude(x) != nsvcd__magnitude(-x);
    }
  }
  CHECK_EQ(wrong, 0);
  for (uint32_t bits = 0; bits <= most; bits += 12345) {
    const float x = math_float_of(bits);
    wrong += !(nsvcd__magnitude(x) < nsvcd__magnitude(-nextafterf(x, INFINITY)));
  }
  CHECK_EQ(wrong, 0);
}

// What floats keep of a place, side by side: where gcc 12 would like to skip the rounding.
static NSVCD__NOINLINE void math_keep_floats(const nsvcd__d3 *in, nsvcd__d3 *out) {
  *out = nsvcd__d3_widen(nsvcd__f3_round(*in));
}

// The nearest float, and no more digits than a float has.
static void math_rounding_is_done(void) {
  size_t wrong = 0;
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    const double scale = pow(10, uniform(-44, 38));
    const nsvcd__d3 x = {uniform(-1, 1) * scale, uniform(-1, 1) * scale, uniform(-1, 1) * scale};
    const nsvcd__f3 narrow = nsvcd__d3_narrow(x);
    nsvcd__d3 kept;
    math_keep_floats(&x, &kept);
    volatile float stored[3];
    stored[0] = narrow.x;
    stored[1] = narrow.y;
    stored[2] = narrow.z;
    for (size_t k = 0; k < 3; k++) {
      const double from = nsvcd__d3_axis(x, k);
      const double off = fabs((double)stored[k] - from);
      wrong += off > fabs((double)nextafterf(stored[k], INFINITY) - from);
      wrong += off > fabs((double)nextafterf(stored[k], -INFINITY) - from);
      wrong += nsvcd__d3_axis(kept, k) - (double)stored[k] != 0;
    }
  }
  CHECK_EQ(wrong, 0);
  CHECK_EQ(nsvcd__to_float(1 + 1e-9), 1);
  CHECK_EQ(nsvcd__to_float(1e-46), 0);
  CHECK(isinf(nsvcd__to_float(1e39)));
}

// ----------------------------------------------------------------------------------------- vectors

// Of three doubles.
static double math_size(const double *a) {
  return fmax(fmax(fabs(a[0]), fabs(a[1])), fabs(a[2]));
}

static void math_check(nsvcd__f3 found, const double *want, double size) {
  CHECK_NEAR(found.x, want[0], MATH_ROUNDING * size);
  CHECK_NEAR(found.y, want[1], MATH_ROUNDING * size);
  CHECK_NEAR(found.z, want[2], MATH_ROUNDING * size);
}

static void math_check_d3(nsvcd__d3 found, const double *want, double size) {
  CHECK_NEAR(found.x, want[0], 1e-15 * size);
  CHECK_NEAR(found.y, want[1], 1e-15 * size);
  CHECK_NEAR(found.z, want[2], 1e-15 * size);
}

// Floats, at the scales that bodies may have.
static void math_vectors(void) {
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    float p[2][3];
    double a[3], b[3], want[3];
    for (int n = 0; n < 2; n++) {
      const double scale = pow(10, uniform(-12, 6));
      for (int k = 0; k < 3; k++) p[n][k] = (float)(scale * uniform(-1, 1));
    }
    for (int k = 0; k < 3; k++) {
      a[k] = (double)p[0][k];
      b[k] = (double)p[1][k];
    }
    const float s = p[0][trial % 3];
    const nsvcd__f3 x = nsvcd__f3_load(p[0]);
    const nsvcd__f3 y = nsvcd__f3_row(p[0], 1);
    const double size = math_size(a);
    const double other = math_size(b);
    for (int k = 0; k < 3; k++) want[k] = a[k] + b[k];
    math_check(nsvcd__f3_add(x, y), want, size + other);
    oracle_sub(a, b, want);
    math_check(nsvcd__f3_sub(x, y), want, size + other);
    for (int k = 0; k < 3; k++) want[k] = (double)s * b[k];
    math_check(nsvcd__f3_scale(y, s), want, size * other);
    for (int k = 0; k < 3; k++) want[k] += a[k];
    math_check(nsvcd__f3_fma(s, y, x), want, size + size * other);
    oracle_cross(a, b, want);
    math_check(nsvcd__f3_cross(x, y), want, 2 * size * other);
    CHECK_NEAR(nsvcd__f3_dot(x, y), oracle_dot(a, b), MATH_ROUNDING * 3 * size * other);
    CHECK_NEAR(nsvcd__f3_norm(x), oracle_length(a), MATH_ROUNDING * oracle_length(a));
    for (int k = 0; k < 3; k++) want[k] = fmin(a[k], b[k]);
    math_check(nsvcd__f3_min(x, y), want, 0);
    CHECK_EQ(nsvcd__f3_exceeds(x, y), want[0] < a[0] || want[1] < a[1] || want[2] < a[2]);
    for (int k = 0; k < 3; k++) want[k] = fmax(a[k], b[k]);
    math_check(nsvcd__f3_max(x, y), want, 0);
    CHECK(!nsvcd__f3_exceeds(x, x));
  }
}

// Doubles, at every scale of floats: denormal ones, and the largest.
static void math_vectors_in_double(void) {
  const nsvcd__d3 none = {0, 0, 0};
  const nsvcd__d3 east = {1, 0, 0};
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    double a[3], b[3], want[3];
    const double s = uniform(-2, 2);
    const double scale = pow(10, uniform(-44, 38));
    for (int k = 0; k < 3; k++) {
      a[k] = scale * uniform(-1, 1);
      b[k] = scale * uniform(-1, 1);
    }
    const nsvcd__d3 x = nsvcd__d3_of(a[0], a[1], a[2]);
    const nsvcd__d3 y = nsvcd__d3_of(b[0], b[1], b[2]);
    const double size = scale * scale;
    oracle_sub(a, b, want);
    math_check_d3(nsvcd__d3_sub(x, y), want, scale);
    CHECK_NEAR(nsvcd__d3_distance2(x, y), oracle_dot(want, want), 1e-14 * size);
    for (int k = 0; k < 3; k++) want[k] = a[k] + s * b[k];
    math_check_d3(nsvcd__d3_fma(s, y, x), want, 4 * scale);
    math_check_d3(nsvcd__d3_add(x, nsvcd__d3_scale(y, s)), want, 4 * scale);
    for (int k = 0; k < 3; k++) want[k] = (1 - s) * a[k] + s * b[k];
    math_check_d3(nsvcd__d3_mix(x, y, s), want, 10 * scale);
    for (int k = 0; k < 3; k++) want[k] = a[k] / s;
    math_check_d3(nsvcd__d3_over(x, s), want, scale / fabs(s));
    oracle_cross(a, b, want);
    math_check_d3(nsvcd__d3_cross(x, y), want, 2 * size);
    CHECK_NEAR(nsvcd__d3_dot(x, y), oracle_dot(a, b), 1e-15 * 3 * size);
    CHECK_NEAR(nsvcd__d3_norm(x) / oracle_length(a), 1, 1e-15);
    CHECK_NEAR(nsvcd__d3_norm(nsvcd__d3_unit(x, none)), 1, 1e-15);
    const nsvcd__d3 low = nsvcd__d3_min(x, y);
    const nsvcd__d3 high = nsvcd__d3_max(x, y);
    nsvcd__d3 copy = none;
    for (size_t k = 0; k < 3; k++) {
      CHECK_EQ(nsvcd__d3_axis(low, k), fmin(a[k], b[k]));
      CHECK_EQ(nsvcd__d3_axis(high, k), fmax(a[k], b[k]));
      nsvcd__d3_set_axis(&copy, k, a[k]);
    }
    math_check_d3(copy, a, 0);
  }
  CHECK_EQ(nsvcd__d3_unit(none, east).x, 1);
}

// --------------------------------------------------------------------------------------- rotations

static nsvcd__quat math_quat(double *exact) {
  float q[4];
  random_quat(q);
  for (int k = 0; k < 4; k++) exact[k] = (double)q[k];
  return nsvcd__quat_load(q);
}

static void math_check_quat(nsvcd__quat found, const double *want, double size) {
  float q[4];
  nsvcd__quat_store(found, q);
  for (int k = 0; k < 4; k++) CHECK_NEAR(q[k], want[k], MATH_ROUNDING * size);
}

static void math_check_matrix(const nsvcd__mat3 *found, const double *want, double size) {
  math_check(found->x, want, size);
  math_check(found->y, want + 3, size);
  math_check(found->z, want + 6, size);
}

// Of what comes of matrices and quaternions, each against double, and the same by another way.
static void math_rotations(void) {
  const double one[4] = {0, 0, 0, 1};
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    double a[4], b[4], ab[4], m[9], n[9], mn[9], v[3], want[3];
    const nsvcd__quat p = math_quat(a);
    const nsvcd__quat q = math_quat(b);
    const nsvcd__quat pq = nsvcd__quat_mul(p, q);
    const float s = (float)uniform(-1, 1);
    for (int k = 0; k < 3; k++) v[k] = (double)(float)uniform(-1, 1);
    const nsvcd__f3 x = nsvcd__f3_of((float)v[0], (float)v[1], (float)v[2]);
    oracle_quat_mul(a, b, ab);
    math_check_quat(pq, ab, 2);
    math_check_quat(nsvcd__quat_mul(p, nsvcd__quat_inverse(p)), one, 2);
    CHECK_NEAR(nsvcd__quat_dot(nsvcd__quat_unit(pq), nsvcd__quat_unit(pq)), 1, 2 * MATH_ROUNDING);
    const nsvcd__quat opposite = nsvcd__quat_beside(p, 1);
    CHECK_EQ(nsvcd__quat_dot(opposite, q), -nsvcd__quat_dot(p, q));
    CHECK_EQ(nsvcd__quat_dot(nsvcd__quat_beside(p, 0), q), nsvcd__quat_dot(p, q));

    oracle_matrix(a, m);
    oracle_matrix(b, n);
    const nsvcd__mat3 turn = nsvcd__mat3_of(p);
    const nsvcd__mat3 before = nsvcd__mat3_of(q);
    math_check_matrix(&turn, m, 4);
    const nsvcd__mat3 back = nsvcd__mat3_transpose(turn);
    const nsvcd__mat3 inverse = nsvcd__mat3_of(nsvcd__quat_inverse(p));
    CHECK(memcmp(&back, &inverse, sizeof back) == 0);
    oracle_rotate(m, v, want);
    math_check(nsvcd__mat3_apply(&turn, x), want, 6);
    const nsvcd__transform moved = {turn, {3, -2, 1}};
    want[0] += 3;
    want[1] -= 2;
    want[2] += 1;
    math_check(nsvcd__f3_transform(&moved, x), want, 8);
    oracle_rotate_back(m, v, want);
    math_check(nsvcd__mat3_apply_transpose(&turn, x), want, 6);
    for (int k = 0; k < 9; k++) mn[k] = 2 * (m[k] + (double)s * n[k]);
    const nsvcd__mat3 mixed = nsvcd__mat3_mix(2, &turn, s, &before);
    math_check_matrix(&mixed, mn, 8);

    // from p to q: the turn that has to follow p
    a[0] = -a[0];
    a[1] = -a[1];
    a[2] = -a[2];
    oracle_quat_mul(b, a, ab);
    math_check(nsvcd__quat_turn(p, q), ab, 2);
  }
}

static nsvcd__dquat math_dquat(const double *q) {
  const nsvcd__dquat out = {q[0], q[1], q[2], q[3]};
  return out;
}

static void math_rotations_in_double(void) {
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    double a[4], b[4], inverse[4], ab[4], m[9], want[3];
    const double length = pow(10, uniform(-100, 100));
    (void)math_quat(a);
    (void)math_quat(b);
    oracle_quat_normalize(a);
    oracle_quat_normalize(b);
    const nsvcd__dquat p = math_dquat(a);
    const nsvcd__dquat q = math_dquat(b);
    for (int k = 0; k < 4; k++) inverse[k] = k < 3 ? -a[k] : a[k];
    oracle_quat_mul(inverse, b, ab);
    const nsvcd__dquat turn = nsvcd__dquat_mul(nsvcd__dquat_inverse(p), q);
    math_check_d3(nsvcd__dquat_axis(turn), ab, 4);
    CHECK_NEAR(turn.w, ab[3], 4e-15);
    const nsvcd__dquat sum = nsvcd__dquat_fma(length, q, p);
    math_check_d3(nsvcd__d3_of(sum.x, sum.y, sum.z),
                  (double[3]){a[0] + length * b[0], a[1] + length * b[1], a[2] + length * b[2]},
                  1 + length);
    CHECK_NEAR(sum.w, a[3] + length * b[3], 1e-15 * (1 + length));
    const nsvcd__dquat unit = nsvcd__dquat_unit(nsvcd__dquat_scale(p, length));
    math_check_d3(nsvcd__dquat_axis(unit), a, 2);
    CHECK_NEAR(nsvcd__dquat_dot(unit, unit), 1, 2e-15);

    oracle_matrix(a, m);
    const nsvcd__d3 x = nsvcd__dquat_axis(q);
    const nsvcd__dmat3 matrix = nsvcd__dmat3_of(p);
    const nsvcd__dmat3 back = nsvcd__dmat3_transpose(matrix);
    const nsvcd__dmat3 twice = nsvcd__dmat3_scale(&matrix, 2);
    oracle_rotate(m, b, want);
    math_check_d3(nsvcd__dmat3_apply(&matrix, x), want, 6);
    oracle_rotate_back(m, b, want);
    math_check_d3(nsvcd__dmat3_apply(&back, x), want, 6);
    math_check_d3(nsvcd__dmat3_apply_transpose(&matrix, x), want, 6);
    math_check_d3(nsvcd__d3_scale(nsvcd__dmat3_apply_transpose(&twice, x), 0.5), want, 6);
  }
}

// A unit quaternion has the direction of what it was made of, long or short.
static void math_units_of_any_length(void) {
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    double a[4];
    const nsvcd__quat q = math_quat(a);
    const float length = (float)pow(10, uniform(-17, 18));
    oracle_quat_normalize(a);
    math_check_quat(nsvcd__quat_unit(nsvcd__quat_scale(q, length)), a, 2);
  }
}

// Half the angle between a rotation and one that is this far from it; and between the same, on the
// other side.
static void math_arcs(void) {
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    double a[4], b[4], axis[3], turn[4];
    const nsvcd__quat p = math_quat(a);
    (void)math_quat(b);
    for (int k = 0; k < 3; k++) axis[k] = b[k] / oracle_length(b);
    oracle_axis_angle(axis, pow(10, uniform(-6, 0.49)), turn);
    oracle_quat_mul(turn, a, b);
    const nsvcd__quat q = nsvcd__quat_of((float)b[0], (float)b[1], (float)b[2], (float)b[3]);
    double square = 0;  // of the chord, between the floats
    const double d[4] = {(double)p.x - (double)q.x, (double)p.y - (double)q.y,
                         (double)p.z - (double)q.z, (double)p.w - (double)q.w};
    for (int k = 0; k < 4; k++) square += d[k] * d[k];
    const double want = 2 * asin(0.5 * sqrt(square));
    CHECK_NEAR(nsvcd__quat_arc(p, q), want, 1e-6 * want);
    CHECK(!nsvcd__quats_opposed(p, q));
    CHECK(nsvcd__quats_opposed(p, nsvcd__quat_beside(q, 1)));
  }
}

// About half a turn apart, the side is that of the exact product, also where floats would have
// rounded its sign away.
static void math_sides_are_exact(void) {
  size_t opposed = 0;
  size_t rounded = 0;
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    float a[4], b[4];
    int64_t product = 0;  // exact, in units of 2^-46
    for (int k = 0; k < 4; k++) {
      const int64_t x = (int64_t)uniform(-8388608, 8388608);
      int64_t y = (int64_t)uniform(-8388608, 8388608);
      if (k == 3 && x) y = -product / x;  // so that the sum is near 0
      a[k] = (float)x / 8388608;
      b[k] = (float)y / 8388608;
      if (y > 8388608 || y < -8388608)
        a[k] = b[k] = 0;
      else
        product += x * y;
    }
    const nsvcd__quat p = nsvcd__quat_load(a);
    const nsvcd__quat q = nsvcd__quat_load(b);
    CHECK_EQ(nsvcd__quats_opposed(p, q), product < 0);
    opposed += product < 0;
    rounded += (nsvcd__quat_dot(p, q) < 0) != (product < 0);
  }
  CHECK_GE(opposed, MATH_TRIALS / 4);
  CHECK_GE(rounded, MATH_TRIALS / 50);  // floats alone would not do
}

// Of rotations that are close, far, and half a turn apart, of quaternions that are unit to 1e-4.
static void math_slerps(void) {
  const double angles[10] = {0, 1e-7, 1e-4, 1.9e-3, 2.1e-3, 0.1, 1, 3, 3.1415, 6.2};
  double worst = 0;
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    oracle_pose ends[2] = {{{0, 0, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
    double axis[3], turn[4];
    float stored[2][4];
    const float u = trial % 5 ? (float)uniform(0, 1) : trial % 2 ? 0 : 1;
    (void)math_quat(ends[0].rotation);
    (void)math_quat(turn);
    for (int k = 0; k < 3; k++) axis[k] = turn[k] / oracle_length(turn);
    oracle_axis_angle(axis, angles[trial % 10], turn);
    oracle_quat_mul(turn, ends[0].rotation, ends[1].rotation);
    for (int n = 0; n < 2; n++) {
      const double length = uniform(1 - 1e-4, 1 + 1e-4);
      for (int k = 0; k < 4; k++) {
        stored[n][k] = (float)(length * ends[n].rotation[k]);
        ends[n].rotation[k] = (double)stored[n][k];
      }
      oracle_quat_normalize(ends[n].rotation);
    }
    const oracle_pose want = oracle_pose_between(&ends[0], &ends[1], (double)u);
    const nsvcd__quat a = nsvcd__quat_load(stored[0]);
    const nsvcd__quat b = nsvcd__quat_load(stored[1]);
    const nsvcd__quat found = nsvcd__quat_slerp(a, b, u);
    const nsvcd__quat other = nsvcd__quat_slerp(a, nsvcd__quat_beside(b, 1), u);
    float q[4];
    double dot = 0;
    nsvcd__quat_store(found, q);
    for (int k = 0; k < 4; k++) dot += (double)q[k] * want.rotation[k];
    for (int k = 0; k < 4; k++)
      worst = fmax(worst, fabs((double)q[k] - (dot < 0 ? -1 : 1) * want.rotation[k]));
    CHECK(memcmp(&found, &other, sizeof found) == 0);  // b and its opposite are one rotation
  }
  printf("  slerp: within %.2g\n", worst);
  CHECK_LE(worst, 4e-7);
}

// Between two poses a body is where the oracle has it. In a part of the way no point leaves its
// chord, along any direction n, by more than |w|^2 / 8 times its distance from the axis of w, the
// rotation vector, and |n x that axis|.
static void math_between_poses(void) {
  double worst = 0;
  double most = 0;
  for (int trial = 0; trial < MATH_TRIALS; trial++) {
    nsvcd_pose ends[2];
    oracle_pose wide[2];
    double x[3], along[3], turn[4], axis[3];
    const double angle = trial % 4 ? pow(10, uniform(-3, 0.49)) : 3.14;
    (void)math_quat(wide[0].rotation);
    (void)math_quat(turn);
    for (int k = 0; k < 3; k++) {
      axis[k] = turn[k] / oracle_length(turn);
      x[k] = uniform(-1, 1);
      along[k] = uniform(-1, 1);
    }
    oracle_axis_angle(axis, angle, turn);
    oracle_quat_mul(turn, wide[0].rotation, wide[1].rotation);
    for (int k = 0; k < 4 && trial % 2; k++) wide[1].rotation[k] *= -1;  // as good
    for (int n = 0; n < 2; n++) {
      for (int k = 0; k < 3; k++)
        wide[n].position[k] = (double)(ends[n].position[k] = (float)uniform(-1, 1));
      for (int k = 0; k < 4; k++)
        wide[n].rotation[k] = (double)(ends[n].rotation[k] = (float)wide[n].rotation[k]);
      oracle_quat_normalize(wide[n].rotation);
    }
    const double u0 = uniform(0, 0.9);
    const double u1 = uniform(u0, 1);
    const double v = trial % 3 ? 0.5 : uniform(0, 1);
    const double at[3] = {u0, u0 + v * (u1 - u0), u1};
    nsvcd__slerp s = nsvcd__slerp_of(&ends[0], &ends[1]);
    s.from = u0;
    s.fraction = u1 - u0;
    // about the origin, or about a pivot
    const double own[3] = {trial % 5 ? 0 : uniform(-1, 1), 0, trial % 5 ? 0 : uniform(-1, 1)};
    const nsvcd__d3 pivot = nsvcd__d3_of(own[0], own[1], own[2]);
    double pivots[2][3], turn_at[9], arm[3];
    for (int n = 0; n < 2; n++) oracle_transform(&wide[n], own, pivots[n]);
    nsvcd__d3 seen[3];
    for (int n = 0; n < 3; n++) {
      oracle_pose want = oracle_pose_between(&wide[0], &wide[1], at[n]);
      const nsvcd__dpose pose = nsvcd__dpose_between(&ends[0], &ends[1], pivot, at[n]);
      oracle_matrix(want.rotation, turn_at);
      oracle_rotate(turn_at, own, arm);
      for (int k = 0; k < 3; k++)
        want.position[k] = (1 - at[n]) * pivots[0][k] + at[n] * pivots[1][k] - arm[k];
      const nsvcd__dtransform found = nsvcd__dtransform_of(&pose);
      const nsvcd__d3 here = nsvcd__d3_transform(&found, nsvcd__d3_of(x[0], x[1], x[2]));
      double there[3];
      oracle_transform(&want, x, there);
      seen[n] = nsvcd__d3_of(there[0], there[1], there[2]);
      worst = fmax(worst, sqrt(nsvcd__d3_distance2(here, seen[n])));
    }
    const nsvcd__d3 w = nsvcd__slerp_turn(&s);
    const nsvcd__d3 about = nsvcd__d3_unit(w, w);
    const nsvcd__d3 n = nsvcd__d3_of(along[0], along[1], along[2]);
    const nsvcd__d3 middle = nsvcd__d3_mix(seen[0], seen[2], v);
    const nsvcd__d3 origin =
        nsvcd__d3_mix(nsvcd__pivot_of(&ends[0], pivot), nsvcd__pivot_of(&ends[1], pivot), u0);
    const double rho = nsvcd__d3_norm(nsvcd__d3_cross(nsvcd__d3_sub(seen[0], origin), about));
    const double bend =
        0.125 * nsvcd__d3_dot(w, w) * rho * nsvcd__d3_norm(nsvcd__d3_cross(n, about));
    const double off = fabs(nsvcd__d3_dot(n, nsvcd__d3_sub(seen[1], middle)));
    CHECK_LE(off, bend * (1 + 1e-9) + 1e-14);
    if (bend > 1e-9) most = fmax(most, off / bend);
  }
  CHECK_LE(worst, 1e-13);
  CHECK_GE(most, 0.99);  // the bound is as close as that
}

// -------------------------------------------------------------------------------------------- rows

#define MATH_STRIDE 7
#define MATH_ROWS (6 * MATH_STRIDE)

// Of an array of -1 these are 1, 2, 3 ... from `at` on, so many numbers apart, and no others.
static void math_check_rows(const float *rows, size_t at, size_t stride, size_t count) {
  for (size_t i = 0; i < MATH_ROWS; i++) {
    float want = -1;
    for (size_t k = 0; k < count; k++) {
      if (i == at + k * stride) want = (float)(k + 1);
    }
    CHECK_EQ(rows[i], want);
  }
}

static void math_clear(float *rows) {
  for (size_t i = 0; i < MATH_ROWS; i++) rows[i] = -1;
}

// What is written where it belongs is read from there, and nothing beside it is touched.
static void math_rows(void) {
  float rows[MATH_ROWS];
  const nsvcd__f3 vector = {1, 2, 3};
  const nsvcd__quat quat = {1, 2, 3, 4};
  const nsvcd__sphere sphere = {{1, 2, 3}, 4};
  const nsvcd__slab disc = {{1, 2, 3}, 4, 5, 6};
  for (size_t i = 0; i < MATH_STRIDE; i++) {
    math_clear(rows);
    nsvcd__f3_put(vector, rows + i, MATH_STRIDE);
    math_check_rows(rows, i, MATH_STRIDE, 3);
    const nsvcd__f3 v = nsvcd__f3_get(rows + i, MATH_STRIDE);
    CHECK(memcmp(&v, &vector, sizeof v) == 0);

    math_clear(rows);
    nsvcd__quat_put(quat, rows + i, MATH_STRIDE);
    math_check_rows(rows, i, MATH_STRIDE, 4);

    math_clear(rows);
    nsvcd__sphere_store(sphere, rows, MATH_STRIDE, i);
    math_check_rows(rows, i, MATH_STRIDE, 4);
    const nsvcd__spheres all = nsvcd__spheres_of(rows, MATH_STRIDE);
    const nsvcd__sphere s = nsvcd__sphere_of(nsvcd__spheres_from(all, i), 0);
    CHECK(memcmp(&s, &sphere, sizeof s) == 0);
    const nsvcd__f3 centre = nsvcd__centre_of(all, i);
    CHECK(memcmp(&centre, &vector, sizeof centre) == 0);

    math_clear(rows);
    nsvcd__slab_store(disc, rows, MATH_STRIDE, i);
    math_check_rows(rows, i, MATH_STRIDE, 6);
    const nsvcd__slab d = nsvcd__slab_at(rows, MATH_STRIDE, i);
    CHECK(memcmp(&d, &disc, sizeof d) == 0);
  }
  math_clear(rows);
  nsvcd__f3_store(vector, rows + 3);
  math_check_rows(rows, 3, 1, 3);
  const nsvcd__d3 row = nsvcd__d3_row(rows, 1);
  CHECK(row.x == 1 && row.y == 2 && row.z == 3);
}

// ---------------------------------------------------------------------------------- bits and sizes

static void math_bits(void) {
  for (size_t bit = 0; bit < 64; bit++) {
    for (int trial = 0; trial < 100; trial++) {
      const uint64_t above = (uint64_t)uniform(0, 1e18) << bit;
      const uint64_t bits = above | (uint64_t)1 << bit;
      size_t count = 0;
      for (size_t k = 0; k < 64; k++) count += bits >> k & 1;
      CHECK_EQ(nsvcd__low_bit(bits), bit);
      CHECK_EQ(nsvcd__bit_count(bits), count);
    }
  }
  CHECK_EQ(nsvcd__bit_count(0), 0);
  CHECK_EQ(nsvcd__bit_count(UINT64_MAX), 64);
}

// The least multiple that is no less, up to the greatest that a size can hold.
static void math_sizes_are_rounded_up(void) {
  const size_t multiples[5] = {1, 4, 8, 16, 24};
  for (size_t n = 0; n < 5; n++) {
    const size_t m = multiples[n];
    const size_t last = SIZE_MAX / m * m;
    for (size_t k = 0; k < 1000; k++) {
      const size_t up = nsvcd__round_up(k, m);
      CHECK(up >= k && up < k + m && up % m == 0);
    }
    CHECK(nsvcd__round_up(last - m + 1, m) == last);
    CHECK(nsvcd__round_up(SIZE_MAX - m + 1, m) == last);
  }
}

void test_math(void) {
  RUN(math_numbers_by_their_bits);
  RUN(math_rounding_is_done);
  RUN(math_vectors);
  RUN(math_vectors_in_double);
  RUN(math_rotations);
  RUN(math_rotations_in_double);
  RUN(math_units_of_any_length);
  RUN(math_arcs);
  RUN(math_sides_are_exact);
  RUN(math_slerps);
  RUN(math_between_poses);
  RUN(math_rows);
  RUN(math_bits);
  RUN(math_sizes_are_rounded_up);
}

CHECK_ALONE(test_math)
