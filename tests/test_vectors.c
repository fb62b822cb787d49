// 16 lanes against one float, to the bit, and vectors, quaternions and matrices of lanes against
// double. On the vectors that the compiler's flags allow: `make check-levels` tries each level.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/motion/workspace.h"
#include "../src/lanes/turns.h"

#include "../examples/scenery/oracle.h"
#include "check.h"
#include "random_numbers.h"

void test_vectors(void);

// ------------------------------------------------------------------------------------------- lanes

// Zeros, the least and the greatest numbers, infinity, NaN, and neighbours of one.
static float vectors_odd(size_t n) {
  static const float numbers[16] = {0,           1,       2,        1 + FLT_EPSILON,
                                    3,           0.1f,    1e-45f,   FLT_MIN,
                                    FLT_MIN / 3, FLT_MAX, INFINITY, NAN,
                                    1e-20f,      1e20f,   0.5f,     1 - FLT_EPSILON / 2};
  return n % 32 < 16 ? numbers[n % 16] : -numbers[n % 16];
}

// Odd ones in all pairings, then random ones of any size.
static void vectors_draw(size_t trial, float *a, float *b) {
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    a[l] = vectors_odd(trial);
    b[l] = vectors_odd(trial / 32 + l);
    if (trial >= 1024) {
      a[l] = (float)(uniform(-1, 1) * pow(10, uniform(-40, 38)));
      b[l] = trial % 3 ? (float)uniform(-1, 1) * a[l] : (float)uniform(-9, 9);
    }
  }
}
#define VECTORS_TRIALS 4096

static int vectors_same(float a, float b) {
  return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

typedef void vectors_lanes(const float *a, const float *b, float *out);
typedef float vectors_one(float a, float b);

// LANES(NAME, WHAT, ONE): two functions of a and b, over all slices and of one float.
#define LANES(name, what, one)                                             \
  static void lanes_##name(const float *pa, const float *pb, float *out) { \
    NSVCD__EACH_SLICE(l) {                                                 \
      const nsvcd__v a = nsvcd__v_load(pa + l);                            \
      const nsvcd__v b = nsvcd__v_load(pb + l);                            \
      (void)b;                                                             \
      nsvcd__v_store(out + l, what);                                       \
    }                                                                      \
  }                                                                        \
  static float one_##name(float a, float b) {                              \
    (void)b;                                                               \
    return one;                                                            \
  }
LANES(add, nsvcd__v_add(a, b), a + b)
LANES(sub, nsvcd__v_sub(a, b), a - b)
LANES(mul, nsvcd__v_mul(a, b), a *b)
LANES(div, nsvcd__v_div(a, b), a / b)
LANES(sqrt, nsvcd__v_sqrt(a), sqrtf(a))
LANES(min, nsvcd__v_min(a, b), a < b ? a : b)
LANES(max, nsvcd__v_max(a, b), a > b ? a : b)
LANES(pick, nsvcd__v_pick(a, b, nsvcd__v_set(3), a), a <= b ? 3 : a)
LANES(scale, nsvcd__v_scale(a, 3), a * 3)
LANES(plus, nsvcd__v_plus(a, 0.1f), a + 0.1f)
LANES(negate, nsvcd__v_negate(a), 0 - a)
LANES(abs, nsvcd__v_abs(a), fabsf(a))
LANES(clamp, nsvcd__v_clamp(a, -0.5f, 2), a > -0.5f ? a < 2 ? a : 2 : -0.5f)
#undef LANES

static void vectors_compare(const char *name, vectors_lanes *lanes, vectors_one *one) {
  size_t wrong = 0;
  for (size_t trial = 0; trial < VECTORS_TRIALS; trial++) {
    float a[NSVCD__LANES], b[NSVCD__LANES], out[NSVCD__LANES];
    vectors_draw(trial, a, b);
    lanes(a, b, out);
    for (size_t l = 0; l < NSVCD__LANES; l++) {
#if NSVCD__SLICE > 1 && defined(__aarch64__)
      // with NEON NaN wins, and -0 is less than 0
      if (isnan(a[l]) || isnan(b[l]) || (a[l] == 0 && b[l] == 0)) continue;
#endif
      if (vectors_same(out[l], one(a[l], b[l]))) continue;
      if (wrong++ == 0)
        printf("  %s(%a, %a): %a\n", name, (double)a[l], (double)b[l], (double)out[l]);
    }
  }
  CHECK_EQ(wrong, 0);
}

static void vectors_are_lanes_of_floats(void) {
  printf("  %d lanes at a time\n", NSVCD__SLICE);
#define COMPARE(name) vectors_compare(#name, lanes_##name, one_##name)
  COMPARE(add);
  COMPARE(sub);
  COMPARE(mul);
  COMPARE(div);
  COMPARE(sqrt);
  COMPARE(min);
  COMPARE(max);
  COMPARE(pick);
  COMPARE(scale);
  COMPARE(plus);
  COMPARE(negate);
  COMPARE(abs);
  COMPARE(clamp);
#undef COMPARE
}

// a b + c is rounded once, or twice, but in all lanes alike.
static void vectors_fma_rounds_once_or_twice(void) {
  size_t once = 0;
  size_t twice = 0;
  for (size_t trial = 0; trial < VECTORS_TRIALS; trial++) {
    float a[NSVCD__LANES], b[NSVCD__LANES], c[NSVCD__LANES], out[NSVCD__LANES];
    vectors_draw(trial, a, b);
    for (size_t l = 0; l < NSVCD__LANES; l++)
      c[l] = trial % 2 ? -a[l] * b[l] : vectors_odd(trial + l);
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v sum =
          nsvcd__v_fma(nsvcd__v_load(a + l), nsvcd__v_load(b + l), nsvcd__v_load(c + l));
      nsvcd__v_store(out + l, sum);
    }
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      const volatile float product = a[l] * b[l];
      const int as_once = vectors_same(out[l], fmaf(a[l], b[l], c[l]));
      const int as_twice = vectors_same(out[l], product + c[l]);
      CHECK(as_once || as_twice);
      once += as_once && !as_twice;
      twice += as_twice && !as_once;
    }
  }
  CHECK(once == 0 || twice == 0);
  CHECK_GE(once + twice, 100);
#if NSVCD__SLICE >= 8 || (NSVCD__SLICE > 1 && defined(__aarch64__))
  CHECK_EQ(twice, 0);
#endif
}

// A bit for each lane, and none beside them; NaN is neither less nor equal.
static void vectors_masks(void) {
  CHECK_EQ(NSVCD__SLICE_MASK, ((uint64_t)1 << NSVCD__SLICE) - 1);
  for (size_t trial = 0; trial < VECTORS_TRIALS; trial++) {
    float a[NSVCD__LANES], b[NSVCD__LANES];
    uint32_t le = 0;
    uint32_t lt = 0;
    vectors_draw(trial, a, b);
    b[trial % NSVCD__LANES] = a[trial % NSVCD__LANES];
    NSVCD__EACH_SLICE(l) {
      const uint32_t slice_le = nsvcd__v_le(nsvcd__v_load(a + l), nsvcd__v_load(b + l));
      const uint32_t slice_lt = nsvcd__v_lt(nsvcd__v_load(a + l), nsvcd__v_load(b + l));
      CHECK_EQ((slice_le | slice_lt) & ~NSVCD__SLICE_MASK, 0);
      le |= slice_le << l;
      lt |= slice_lt << l;
    }
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      CHECK_EQ(le >> l & 1, a[l] <= b[l]);
      CHECK_EQ(lt >> l & 1, a[l] < b[l]);
    }
  }
}

// Of a slice, wherever the least one is.
static void vectors_least(void) {
  for (size_t trial = 0; trial < VECTORS_TRIALS; trial++) {
    float a[NSVCD__LANES];
    for (size_t l = 0; l < NSVCD__LANES; l++)
      a[l] = (float)(uniform(-1, 3) * pow(10, uniform(-40, 38)));
    a[trial % NSVCD__LANES] = trial % 3 ? -INFINITY : INFINITY;
    NSVCD__EACH_SLICE(l) {
      float least = a[l];
      for (size_t k = 0; k < NSVCD__SLICE; k++) least = a[l + k] < least ? a[l + k] : least;
      CHECK_EQ(nsvcd__v_least(nsvcd__v_load(a + l)), least);
    }
  }
}

// ------------------------------------------------------------------------------ from and to memory

// At any place, bits as they are, and no number beside them.
static void vectors_loads_and_stores(void) {
  float from[NSVCD__LANES + 16], to[NSVCD__LANES + 16];
  for (size_t at = 0; at < 16; at++) {
    for (size_t l = 0; l < NSVCD__LANES + 16; l++) {
      from[l] = vectors_odd(l);
      to[l] = 7;
    }
    nsvcd__v_store(to + at, nsvcd__v_load(from + at));
    for (size_t l = 0; l < NSVCD__LANES + 16; l++) {
      const float want = l >= at && l < at + NSVCD__SLICE ? from[l] : 7;
      CHECK(memcmp(&to[l], &want, sizeof want) == 0);
    }
    nsvcd__v_store(to + at, nsvcd__v_set(from[at]));
    for (size_t l = at; l < at + NSVCD__SLICE; l++)
      CHECK(memcmp(&to[l], &from[at], sizeof to[l]) == 0);
  }
}

// All that 16 bits can say, in every lane.
static void vectors_of_small_numbers(void) {
  int16_t from[NSVCD__LANES];
  float to[NSVCD__LANES];
  size_t wrong = 0;
  for (int32_t n = INT16_MIN; n <= INT16_MAX; n++) {
    for (size_t l = 0; l < NSVCD__LANES; l++) from[l] = (int16_t)((n + 4099 * (int32_t)l) % 32768);
    from[n & 15] = (int16_t)n;
    NSVCD__EACH_SLICE(l) {
      nsvcd__v_store(to + l, nsvcd__v_load_int16(from + l));
    }
    for (size_t l = 0; l < NSVCD__LANES; l++)
      wrong += to[l] < (float)from[l] || to[l] > (float)from[l];
  }
  CHECK_EQ(wrong, 0);
}

#define VECTORS_STRIDE (NSVCD__LANES + 3)
#define VECTORS_ROWS 9

// Row r of numbers has 100 r + l in place l.
static void vectors_number(float *rows, size_t stride) {
  for (size_t i = 0; i < VECTORS_ROWS * stride; i++)
    rows[i] = (float)(100 * (i / stride) + i % stride);
}

// Slices of rows are where they belong, read and written; and so is each lane alone.
static void vectors_rows(void) {
  static float from[VECTORS_ROWS * VECTORS_STRIDE], to[VECTORS_ROWS * VECTORS_STRIDE];
  static float lanes[VECTORS_ROWS][NSVCD__LANES], copy[VECTORS_ROWS][NSVCD__LANES];
  vectors_number(from, VECTORS_STRIDE);
  vectors_number(lanes[0], NSVCD__LANES);
  NSVCD__EACH_SLICE(l) {
    nsvcd__vquat_store(nsvcd__vquat_load(from + l, VECTORS_STRIDE), to + l, VECTORS_STRIDE);
    const nsvcd__spheres all = nsvcd__spheres_of(from, VECTORS_STRIDE);
    nsvcd__v3_put(nsvcd__v3_centres(all, l), to + 4 * VECTORS_STRIDE + l, VECTORS_STRIDE);
    nsvcd__vmat3_store(copy, l, nsvcd__vmat3_load(lanes, l));
  }
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    for (size_t k = 0; k < 4; k++) CHECK_EQ(to[k * VECTORS_STRIDE + l], 100 * k + l);
    for (size_t k = 0; k < 3; k++) CHECK_EQ(to[(4 + k) * VECTORS_STRIDE + l], 100 * k + l);
    const nsvcd__mat3 m = nsvcd__mat3_lane(lanes, l);
    const float *number = &m.x.x;
    for (size_t k = 0; k < 9; k++) CHECK_EQ(number[k], 100 * k + l);
    nsvcd__lane_set(nsvcd__f3_of(-1, -2, -3), copy, l);
    CHECK_EQ(nsvcd__lane_of(copy, l).y, -2);
  }
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    for (size_t k = 0; k < 9; k++) CHECK_EQ(copy[k][l], k < 3 ? -1 - (float)k : lanes[k][l]);
    CHECK_EQ(to[3 * VECTORS_STRIDE + NSVCD__LANES], 0);  // between two rows: nothing
  }
  NSVCD__EACH_SLICE(l) {
    nsvcd__v3_store(copy, l, nsvcd__v3_rows(lanes[4] + l));
  }
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    for (size_t k = 0; k < 3; k++) CHECK_EQ(copy[k][l], lanes[4 + k][l]);
  }
}

// ------------------------------------------------------------- vectors, quaternions and matrices

#define VECTORS_MOST 19  // inputs

typedef float vectors_in[NSVCD__LANES];

// What is done to a slice of inputs, and the same to the numbers of one lane, in double.
typedef struct vectors_case {
  const char *name;
  size_t inputs, outputs;
  double tolerance;  // of inputs up to 1
  void (*slice)(vectors_in *in, size_t l, vectors_in *out);
  void (*lane)(const double *in, double *out);
} vectors_case;

// What a slice gives, to rows of outputs.
static void v_to(vectors_in *out, size_t l, nsvcd__v a) {
  nsvcd__v_store(out[0] + l, a);
}
static void v3_to(vectors_in *out, size_t l, nsvcd__v3 a) {
  nsvcd__v3_store(out, l, a);
}
static void quat_to(vectors_in *out, size_t l, nsvcd__vquat a) {
  nsvcd__vquat_store(a, out[0] + l, NSVCD__LANES);
}
static void mat3_to(vectors_in *out, size_t l, nsvcd__vmat3 a) {
  nsvcd__vmat3_store(out, l, a);
}

// The same in double, of n numbers: a + s b; s a; the lesser, the greater; the sum of products.
static void sum_of(const double *a, double s, const double *b, size_t n, double *out) {
  for (size_t k = 0; k < n; k++) out[k] = a[k] + s * b[k];
}
static void times(double s, const double *a, size_t n, double *out) {
  for (size_t k = 0; k < n; k++) out[k] = s * a[k];
}
static void lesser(const double *a, const double *b, size_t n, double *out) {
  for (size_t k = 0; k < n; k++) out[k] = fmin(a[k], b[k]);
}
static void greater(const double *a, const double *b, size_t n, double *out) {
  for (size_t k = 0; k < n; k++) out[k] = fmax(a[k], b[k]);
}
static double product(const double *a, const double *b, size_t n) {
  double sum = 0;
  for (size_t k = 0; k < n; k++) sum += a[k] * b[k];
  return sum;
}
static void inverse(const double *q, double *out) {
  times(-1, q, 3, out);
  out[3] = q[3];
}
static void unit(const double *q, double *out) {
  memcpy(out, q, 4 * sizeof *out);
  oracle_quat_normalize(out);
}
static void matrix_of(const double *q, double *out) {
  double of_length_1[4];
  unit(q, of_length_1);
  oracle_matrix(of_length_1, out);
}
static void transposed(const double *m, double *out) {
  for (size_t k = 0; k < 9; k++) out[k] = m[k % 3 * 3 + k / 3];
}
static void rotate_add(const double *m, const double *a, const double *p, double *out) {
  oracle_rotate(m, a, out);
  sum_of(p, 1, out, 3, out);
}
static void matrices(const double *a, const double *b, double *out) {
  for (size_t i = 0; i < 3; i++) oracle_rotate_back(b, a + 3 * i, out + 3 * i);
}

// One transform for all lanes, and the same as numbers.
static const nsvcd__transform vectors_moved = {{{0, -1, 0.5f}, {1, 0.25f, 0}, {0, 2, 1}},
                                               {3, -2, 1}};
static const double vectors_matrix[9] = {0, -1, 0.5, 1, 0.25, 0, 0, 2, 1};
static const double vectors_place[3] = {3, -2, 1};

// CASE(NAME, TO, SLICE, LANE): of a slice of inputs, from rows V(k), V3(k), Q(k) or M(k) on, and of
// the inputs `in` of one lane to its outputs.
#define V(k) nsvcd__v_load(in[k] + l)
#define V3(k) nsvcd__v3_load(in + (k), l)
#define Q(k) nsvcd__vquat_load(in[k] + l, NSVCD__LANES)
#define M(k) nsvcd__vmat3_load(in + (k), l)
#define CASE(name, to, slice, lane)                                     \
  static void slice_##name(vectors_in *in, size_t l, vectors_in *out) { \
    to(out, l, slice);                                                  \
  }                                                                     \
  static void lane_##name(const double *in, double *out) {              \
    lane;                                                               \
  }
CASE(add, v3_to, nsvcd__v3_add(V3(0), V3(3)), sum_of(in, 1, in + 3, 3, out))
CASE(sub, v3_to, nsvcd__v3_sub(V3(0), V3(3)), sum_of(in, -1, in + 3, 3, out))
CASE(negate, v3_to, nsvcd__v3_negate(V3(0)), times(-1, in, 3, out))
CASE(min, v3_to, nsvcd__v3_min(V3(0), V3(3)), lesser(in, in + 3, 3, out))
CASE(max, v3_to, nsvcd__v3_max(V3(0), V3(3)), greater(in, in + 3, 3, out))
CASE(scale, v3_to, nsvcd__v3_scale(V3(0), V(3)), times(in[3], in, 3, out))
CASE(fma, v3_to, nsvcd__v3_fma(V(0), V3(1), V3(4)), sum_of(in + 4, in[0], in + 1, 3, out))
CASE(dot, v_to, nsvcd__v3_dot(V3(0), V3(3)), *out = product(in, in + 3, 3))
CASE(dot_add, v_to, nsvcd__v3_dot_add(V3(0), V3(3), V(6)), *out = in[6] + product(in, in + 3, 3))
CASE(length, v_to, nsvcd__v3_norm(V3(0)), *out = oracle_length(in))
CASE(cross, v3_to, nsvcd__v3_cross(V3(0), V3(3)), oracle_cross(in, in + 3, out))
CASE(unit, v3_to, nsvcd__v3_unit(V3(0)), times(1 / oracle_length(in), in, 3, out))
CASE(transform, v3_to, nsvcd__v3_transform(&vectors_moved, V3(0)),
     rotate_add(vectors_matrix, in, vectors_place, out))
CASE(quat_axis, v3_to, nsvcd__vquat_axis(Q(0)), times(1, in, 3, out))
CASE(quat_dot, v_to, nsvcd__vquat_dot(Q(0), Q(4)), *out = product(in, in + 4, 4))
CASE(quat_fma, quat_to, nsvcd__vquat_fma(V(0), Q(1), Q(5)), sum_of(in + 5, in[0], in + 1, 4, out))
CASE(quat_unit, quat_to, nsvcd__vquat_unit(Q(0)), unit(in, out))
CASE(quat_inverse, quat_to, nsvcd__vquat_inverse(Q(0)), inverse(in, out))
CASE(quat_mul, quat_to, nsvcd__vquat_mul(Q(0), Q(4)), oracle_quat_mul(in, in + 4, out))
CASE(mat3_of, mat3_to, nsvcd__vmat3_of(Q(0)), matrix_of(in, out))
CASE(mat3_scale, mat3_to, nsvcd__vmat3_scale(M(0), V(9)), times(in[9], in, 9, out))
CASE(mat3_sub, mat3_to, nsvcd__vmat3_sub(M(0), M(9)), sum_of(in, -1, in + 9, 9, out))
CASE(mat3_fma, mat3_to, nsvcd__vmat3_fma(V(0), M(1), M(10)), sum_of(in + 10, in[0], in + 1, 9, out))
CASE(mat3_transpose, mat3_to, nsvcd__vmat3_transpose(M(0)), transposed(in, out))
CASE(mat3_apply, v3_to, nsvcd__vmat3_apply(M(0), V3(9)), oracle_rotate(in, in + 9, out))
CASE(mat3_apply_add, v3_to, nsvcd__vmat3_apply_add(M(0), V3(9), V3(12)),
     rotate_add(in, in + 9, in + 12, out))
CASE(mat3_apply_transpose, v3_to, nsvcd__vmat3_apply_transpose(M(0), V3(9)),
     oracle_rotate_back(in, in + 9, out))
CASE(mat3_mul, mat3_to, nsvcd__vmat3_mul(M(0), M(9)), matrices(in, in + 9, out))
CASE(mat3_square, v_to, nsvcd__vmat3_square(M(0)), *out = product(in, in, 9))
#undef CASE

#define OF(name, inputs, outputs, tolerance) \
  { #name, inputs, outputs, tolerance, slice_##name, lane_##name }
static const vectors_case vectors_cases[] = {
    OF(add, 6, 3, 2e-7),
    OF(sub, 6, 3, 2e-7),
    OF(negate, 3, 3, 0),
    OF(min, 6, 3, 0),
    OF(max, 6, 3, 0),
    OF(scale, 4, 3, 1e-7),
    OF(fma, 7, 3, 3e-7),
    OF(dot, 6, 1, 5e-7),
    OF(dot_add, 7, 1, 6e-7),
    OF(length, 3, 1, 5e-7),
    OF(cross, 6, 3, 3e-7),
    OF(unit, 3, 3, 3e-7),
    OF(transform, 3, 3, 2e-6),
    OF(quat_axis, 4, 3, 0),
    OF(quat_dot, 8, 1, 6e-7),
    OF(quat_fma, 9, 4, 3e-7),
    OF(quat_unit, 4, 4, 3e-7),
    OF(quat_inverse, 4, 4, 0),
    OF(quat_mul, 8, 4, 8e-7),
    OF(mat3_of, 4, 9, 6e-7),
    OF(mat3_scale, 10, 9, 1e-7),
    OF(mat3_sub, 18, 9, 2e-7),
    OF(mat3_fma, 19, 9, 3e-7),
    OF(mat3_transpose, 9, 9, 0),
    OF(mat3_apply, 12, 3, 5e-7),
    OF(mat3_apply_add, 15, 3, 6e-7),
    OF(mat3_apply_transpose, 12, 3, 5e-7),
    OF(mat3_mul, 18, 9, 5e-7),
    OF(mat3_square, 9, 1, 2e-6),
};
enum { VECTORS_CASES = sizeof vectors_cases / sizeof *vectors_cases };
#undef OF

// How many outputs of a case are off by more than its tolerance, times out_scale, or no numbers. All
// inputs are multiplied by scale.
static size_t vectors_misses(const vectors_case *c, double scale, double out_scale) {
  static vectors_in in[VECTORS_MOST], out[9];
  size_t misses = 0;
  for (size_t i = 0; i < c->inputs; i++) {
    for (size_t l = 0; l < NSVCD__LANES; l++) in[i][l] = (float)(scale * uniform(-1, 1));
  }
  NSVCD__EACH_SLICE(l) {
    c->slice(in, l, out);
  }
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    double numbers[VECTORS_MOST], want[9];
    for (size_t i = 0; i < c->inputs; i++) numbers[i] = (double)in[i][l];
    c->lane(numbers, want);
    for (size_t i = 0; i < c->outputs; i++)
      misses += !(fabs((double)out[i][l] - want[i]) <= c->tolerance * out_scale);
  }
  return misses;
}

static void vectors_against_double(void) {
  for (size_t n = 0; n < VECTORS_CASES; n++) {
    const vectors_case *c = &vectors_cases[n];
    size_t misses = 0;
    for (int trial = 0; trial < 2000; trial++) misses += vectors_misses(c, 1, 1);
    if (misses > 0) printf("  %s\n", c->name);
    CHECK_EQ(misses, 0);
  }
}

// What has no unit is the same at every scale that leaves squares in the range of floats.
static void vectors_at_any_scale(void) {
  for (size_t n = 0; n < VECTORS_CASES; n++) {
    const vectors_case *c = &vectors_cases[n];
    const int is_length = !strcmp(c->name, "length");
    const int is_direction = !strcmp(c->name, "unit") || !strcmp(c->name, "quat_unit");
    if (!is_length && !is_direction && strcmp(c->name, "mat3_of")) continue;
    size_t misses = 0;
    for (int trial = 0; trial < 2000; trial++) {
      const double scale = pow(10, uniform(-15, 18));
      misses += vectors_misses(c, scale, is_length ? scale : 1);
    }
    if (misses > 0) printf("  %s\n", c->name);
    CHECK_EQ(misses, 0);
  }
}

// What has no length becomes x, and the lanes beside it do not.
static void vectors_without_length(void) {
  static vectors_in in[3], out[3];
  const float lengths[4] = {0, 1e-30f, 0.9e-18f, 1.1e-18f};
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    in[0][l] = in[2][l] = 0;
    in[1][l] = l % 5 < 4 ? lengths[l % 5] : -2;
  }
  NSVCD__EACH_SLICE(l) {
    nsvcd__v3_store(out, l, nsvcd__v3_unit(nsvcd__v3_load(in, l)));
  }
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    CHECK_EQ(out[0][l], l % 5 < 3);
    CHECK_NEAR(out[1][l], l % 5 < 3 ? 0 : l % 5 == 3 ? 1 : -1, 2e-7);
    CHECK_EQ(out[2][l], 0);
  }
}

// One value for all lanes.
static void vectors_are_set(void) {
  static float lanes[VECTORS_ROWS][NSVCD__LANES];
  const nsvcd__f3 a = {1, -2, 3};
  const nsvcd__quat q = {1, -2, 3, -4};
  const nsvcd__mat3 m = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  NSVCD__EACH_SLICE(l) {
    nsvcd__vmat3_store(lanes, l, nsvcd__vmat3_set(&m));
  }
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const nsvcd__mat3 back = nsvcd__mat3_lane(lanes, l);
    CHECK(memcmp(&back, &m, sizeof m) == 0);
  }
  NSVCD__EACH_SLICE(l) {
    nsvcd__v3_store(lanes, l, nsvcd__v3_set(a));
    quat_to(lanes + 3, l, nsvcd__vquat_set(q));
  }
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    CHECK(lanes[0][l] == 1 && lanes[1][l] == -2 && lanes[2][l] == 3);
    CHECK(lanes[3][l] == 1 && lanes[4][l] == -2 && lanes[5][l] == 3 && lanes[6][l] == -4);
  }
}

void test_vectors(void) {
  RUN(vectors_are_lanes_of_floats);
  RUN(vectors_fma_rounds_once_or_twice);
  RUN(vectors_masks);
  RUN(vectors_least);
  RUN(vectors_loads_and_stores);
  RUN(vectors_of_small_numbers);
  RUN(vectors_rows);
  RUN(vectors_against_double);
  RUN(vectors_at_any_scale);
  RUN(vectors_without_length);
  RUN(vectors_are_set);
}

CHECK_ALONE(test_vectors)
