// The network: parity with the trainer, equivariance of the encoder, group laws of D(R), invariance
// of the logit.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "check.h"
#include "data/golden.h"

static uint32_t seed = 1;
static float uniform(void) {  // [-1, 1)
  seed = seed * 1664525u + 1013904223u;
  return (float)(seed >> 8) / 8388608.0f - 1;
}

static void random_rotation(float *m) {
  float q[4];
  float length = 0;
  do {
    for (size_t k = 0; k < 4; k++)
      q[k] = uniform();
    length = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  } while (length > 1 || length < 0.1f);
  for (size_t k = 0; k < 4; k++)
    q[k] /= length;
  nsvcd__quat_to_matrix(q, m);
}

static float largest_difference(const float *a, const float *b, size_t count) {
  float most = 0;
  for (size_t k = 0; k < count; k++)
    most = fmaxf(most, fabsf(a[k] - b[k]));
  return most;
}

// One pair, as nsvcd__pairs holds a slice of them.
typedef struct pair_data {
  float p1[3], p2[3], r1, r2, rotation[9], v[3], w[3];
  const int8_t *z1, *z2;
} pair_data;

// In lane `lane`, of a slice; the others hold the same pair, pushed apart.
static void inputs_in_lane(const pair_data *pair, size_t lane, float *x) {  // (DECODER_IN)
  static float batch[NSVCD__SLICE * NSVCD__DECODER_IN];
  const float *from[5] = {pair->p1, pair->p2, pair->rotation, pair->v, pair->w};
  nsvcd__pairs pairs;
  nsvcd__v *to[5] = {pairs.p1, pairs.p2, pairs.rotation, pairs.v, pairs.w};
  for (size_t n = 0; n < 5; n++) {
    for (size_t k = 0; k < (n == 2 ? 9u : 3u); k++) {
      float lanes[NSVCD__SLICE];
      for (size_t l = 0; l < NSVCD__SLICE; l++)
        lanes[l] = from[n][k] + (n == 0 && l != lane ? 0.1f * (float)l : 0);
      to[n][k] = nsvcd__v_load(lanes);
    }
  }
  pairs.r1 = nsvcd__v_set(pair->r1);
  pairs.r2 = nsvcd__v_set(pair->r2);
  for (size_t l = 0; l < NSVCD__SLICE; l++) {
    pairs.z1[l] = pair->z1;
    pairs.z2[l] = pair->z2;
  }
  nsvcd__invariants(&pairs, NSVCD__SLICE, batch);
  memcpy(x, batch + NSVCD__DECODER_IN * lane, NSVCD__DECODER_IN * sizeof *x);
}
static void inputs_of(const pair_data *pair, float *x) {
  inputs_in_lane(pair, 5 % NSVCD__SLICE, x);
}

static float head_logit(const nsvcd__decoder *head, const float *x, int int8) {
  static float batch[NSVCD__ROWS * NSVCD__DECODER_IN];
  const size_t rows = NSVCD__ROWS < 7 ? NSVCD__ROWS : 7;
  float logits[NSVCD__ROWS];
  for (size_t p = 0; p < rows; p++)
    memcpy(batch + NSVCD__DECODER_IN * p, x, NSVCD__DECODER_IN * sizeof *x);
  nsvcd__decoder_logits(head, batch, rows, int8, logits);
  return logits[rows - 1];
}

// D(R) as floats: (9 + 25).
static void wigner(const float *r, float *d) {
  nsvcd__v m[9];
  float lanes[NSVCD__WIGNER][NSVCD__SLICE];
  for (size_t k = 0; k < 9; k++)
    m[k] = nsvcd__v_set(r[k]);
  nsvcd__wigner(m, nsvcd__v_set(1), lanes);
  for (size_t k = 0; k < NSVCD__WIGNER; k++)
    d[k] = lanes[k][3 % NSVCD__SLICE];
}

// D(R) z of a latent's vectors: (3, CHANNELS), then (5, CHANNELS).
static void rotate_latent(const float *r, const float *z, float *turned) {
  float d[NSVCD__WIGNER];
  wigner(r, d);
  for (size_t i = 0; i < 8; i++) {
    for (size_t c = 0; c < NSVCD_W_CHANNELS; c++) {
      float sum = 0;
      for (size_t k = 0; k < (i < 3 ? 3u : 5u); k++) {
        sum += d[i < 3 ? 3 * i + k : 9 + 5 * (i - 3) + k] *
               z[NSVCD_W_CHANNELS * ((i < 3 ? 0 : 3) + k) + c];
      }
      turned[NSVCD_W_CHANNELS * i + c] = sum;
    }
  }
}

static void heads_fit_their_buffers(void) {
  const size_t widest[3] = {NSVCD__WIDEST_TINY, NSVCD__WIDEST_SMALL, NSVCD__WIDEST};
  for (size_t h = 0; h < 3; h++) {
    const nsvcd__decoder *head = &nsvcd_w_decoders[h];
    for (size_t l = 1; l <= head->layers; l++)
      CHECK(head->sizes[l] <= widest[h]);
  }
}

// The latent of a patch of `count` samples; points, normals: (count, 3).
static void encode_patch(const float *points, const float *normals, size_t count,
                         const float *centre, float radius, float *latent) {
  nsvcd__encoded patch;
  patch.samples = (const nsvcd__f3 *)(const void *)points;
  patch.normals = (const nsvcd__f3 *)(const void *)normals;
  patch.count = count;
  patch.centre = nsvcd__f3_load(centre);
  patch.inverse_radius = 1 / radius;
  nsvcd__encode_patch(&patch, latent);
}

static void encoder_matches_the_trainer(void) {
  for (size_t i = 0; i < GOLDEN_PATCHES; i++) {
    float latent[NSVCD__LATENT];
    encode_patch(golden_points + 3 * GOLDEN_POINTS * i, golden_normals + 3 * GOLDEN_POINTS * i,
                 GOLDEN_POINTS, golden_centre + 3 * i, golden_radius[i], latent);
    CHECK_LE(largest_difference(latent, golden_latent + NSVCD__LATENT * i, NSVCD__LATENT), 1e-4);
  }
}

// golden_pair rows: p1 p2 r1 r2 q v w, logits of tiny small base.
#define GOLDEN_ROW 21
static void golden_pair_at(size_t n, int8_t *z1, int8_t *z2, pair_data *pair) {
  const float *row = golden_pair + GOLDEN_ROW * n;
  for (size_t k = 0; k < NSVCD__LATENT; k++) {
    z1[k] = (int8_t)lrintf(127 * golden_latent[NSVCD__LATENT * (size_t)golden_index[2 * n] + k]);
    z2[k] =
        (int8_t)lrintf(127 * golden_latent[NSVCD__LATENT * (size_t)golden_index[2 * n + 1] + k]);
  }
  memcpy(pair->p1, row, sizeof pair->p1);
  memcpy(pair->p2, row + 3, sizeof pair->p2);
  pair->r1 = row[6];
  pair->r2 = row[7];
  nsvcd__quat_to_matrix(row + 8, pair->rotation);
  memcpy(pair->v, row + 12, sizeof pair->v);
  memcpy(pair->w, row + 15, sizeof pair->w);
  pair->z1 = z1;
  pair->z2 = z2;
}

static void golden_inputs(size_t n, float *x) {  // (DECODER_IN)
  int8_t z1[NSVCD__LATENT], z2[NSVCD__LATENT];
  pair_data pair;
  golden_pair_at(n, z1, z2, &pair);
  inputs_of(&pair, x);
}

static void heads_match_the_trainer(void) {
  for (size_t n = 0; n < GOLDEN_PAIRS; n++) {
    float x[NSVCD__DECODER_IN];
    golden_inputs(n, x);
    for (size_t h = 0; h < 3; h++) {
      float expected = golden_pair[GOLDEN_ROW * n + 18 + h];
      CHECK_NEAR(head_logit(&nsvcd_w_decoders[h], x, 0), expected,
                 1e-4 * fmax(1, fabs((double)expected)));
    }
  }
}

// int8 arithmetic moves a logit, but not by much: the worst seen is printed.
static void int8_heads_follow_fp32(void) {
  double worst = 0;
  double sum = 0;
  for (size_t n = 0; n < GOLDEN_PAIRS; n++) {
    float x[NSVCD__DECODER_IN];
    golden_inputs(n, x);
    for (size_t h = 0; h < 3; h++) {
      double exact = (double)head_logit(&nsvcd_w_decoders[h], x, 0);
      double error =
          fabs((double)head_logit(&nsvcd_w_decoders[h], x, 1) - exact) / fmax(1, fabs(exact));
      worst = fmax(worst, error);
      sum += error / (3 * GOLDEN_PAIRS);
    }
  }
  printf("  int8 logits: mean difference %.4f, worst %.4f, of max(1, |logit|)\n", sum, worst);
  CHECK_GE(worst, 1e-6);  // it is another arithmetic
  CHECK_LE(sum, 0.05);
  CHECK_LE(worst, 0.5);
}

// Random oriented points in the unit ball about a random centre.
static void random_patch(float *points, float *normals, size_t count) {
  float lean[3] = {uniform(), uniform(), uniform()};
  for (size_t i = 0; i < count; i++) {
    float n[3], length;
    for (size_t k = 0; k < 3; k++) {
      points[3 * i + k] = 0.57f * uniform();
      n[k] = uniform() + lean[k];
    }
    length = nsvcd__length3(n);
    for (size_t k = 0; k < 3; k++)
      normals[3 * i + k] = n[k] / length;
  }
}

static void encoder_is_equivariant(void) {
  for (int trial = 0; trial < 100; trial++) {
    float points[3 * 40], normals[3 * 40], turned_points[3 * 40], turned_normals[3 * 40], m[9];
    float latent[NSVCD__LATENT];
    float expected[NSVCD__LATENT];
    float turned[NSVCD__LATENT];
    float zero[3] = {0, 0, 0};
    float centre[3];
    random_patch(points, normals, 40);
    random_rotation(m);
    if (trial % 2) {  // mirrored as well: the degree-2 block is even, degree 1 odd
      for (size_t k = 0; k < 9; k++)
        m[k] = -m[k];
    }
    const float scale = powf(10, 3 * uniform());
    for (size_t k = 0; k < 3; k++)
      centre[k] = scale * uniform();
    for (size_t i = 0; i < 40; i++) {
      nsvcd__mul33_vec(m, points + 3 * i, turned_points + 3 * i);
      nsvcd__mul33_vec(m, normals + 3 * i, turned_normals + 3 * i);
      for (size_t k = 0; k < 3; k++)
        turned_points[3 * i + k] = scale * turned_points[3 * i + k] + centre[k];
    }
    encode_patch(points, normals, 40, zero, 1, latent);
    encode_patch(turned_points, turned_normals, 40, centre, scale, turned);
    rotate_latent(m, latent, expected);
    memcpy(expected + NSVCD__VECTORS, latent + NSVCD__VECTORS, NSVCD_W_SCALARS * sizeof(float));
    // float32, and gates that amplify
    CHECK_LE(largest_difference(turned, expected, NSVCD__LATENT), 2e-4);
    CHECK_GE(largest_difference(latent, turned, NSVCD__LATENT), 1e-3);  // it does depend on R
  }
}

static void rotation_operator_is_a_group(void) {
  const float half_turn[9] = {-1, 0, 0, 0, -1, 0, 0, 0, 1};
  for (int trial = 0; trial < 200; trial++) {
    float a[9], b[9], ab[9], z[NSVCD__VECTORS], x[NSVCD__VECTORS], y[NSVCD__VECTORS],
        w[NSVCD__VECTORS];
    random_rotation(a);
    random_rotation(b);
    nsvcd__mul33(a, b, ab);
    for (size_t k = 0; k < NSVCD__VECTORS; k++)
      z[k] = uniform();
    rotate_latent(b, z, x);
    rotate_latent(a, x, y);
    rotate_latent(ab, z, w);
    CHECK_LE(largest_difference(y, w, NSVCD__VECTORS), 3e-6);  // D(A) D(B) = D(AB)
    rotate_latent(half_turn, z, x);
    CHECK_GE(largest_difference(x, z, NSVCD__VECTORS), 0.1);
    rotate_latent(half_turn, x, y);
    CHECK_LE(largest_difference(y, z, NSVCD__VECTORS), 1e-6);  // twice 180 degrees is the identity
    float back[9];
    nsvcd__transpose33(a, back);
    rotate_latent(a, z, x);
    rotate_latent(back, x, y);
    CHECK_LE(largest_difference(y, z, NSVCD__VECTORS), 2e-6);  // D(R)^T is the inverse
  }
}

static void inputs_are_invariant(void) {
  for (size_t n = 0; n < GOLDEN_PAIRS; n++) {
    int8_t z1[NSVCD__LATENT], z2[NSVCD__LATENT];
    pair_data pair, moved;
    float x[NSVCD__DECODER_IN], y[NSVCD__DECODER_IN];
    golden_pair_at(n, z1, z2, &pair);
    inputs_of(&pair, x);
    moved = pair;  // time runs backwards
    for (size_t k = 0; k < 3; k++) {
      moved.v[k] = -pair.v[k];
      moved.w[k] = -pair.w[k];
    }
    inputs_of(&moved, y);
    CHECK_LE(largest_difference(x, y, NSVCD__DECODER_IN), 1e-5);
    moved = pair;  // another unit of length
    for (size_t k = 0; k < 3; k++) {
      moved.p1[k] *= 8;
      moved.p2[k] *= 8;
      moved.v[k] *= 8;
    }
    moved.r1 *= 8;
    moved.r2 *= 8;
    inputs_of(&moved, y);
    CHECK_LE(largest_difference(x, y, NSVCD__DECODER_IN), 1e-6);
  }
}

// Seen from body 1 at mid-interval, body 2 moves with the opposite twist: the inputs must be the
// same.
static void inputs_do_not_depend_on_who_moves(void) {
  for (size_t n = 0; n < GOLDEN_PAIRS; n++) {
    int8_t z1[NSVCD__LATENT], z2[NSVCD__LATENT];
    pair_data pair, other;
    float x[NSVCD__DECODER_IN], y[NSVCD__DECODER_IN];
    golden_pair_at(n, z1, z2, &pair);
    inputs_of(&pair, x);
    nsvcd__transpose33(pair.rotation, other.rotation);  // body 2 in the axes of body 1
    nsvcd__mul33_vec(other.rotation, pair.p2, other.p1);
    nsvcd__mul33_vec(other.rotation, pair.p1, other.p2);
    nsvcd__mul33_vec(other.rotation, pair.v, other.v);
    nsvcd__mul33_vec(other.rotation, pair.w, other.w);
    for (size_t k = 0; k < 3; k++) {
      other.v[k] = -other.v[k];
      other.w[k] = -other.w[k];
    }
    other.r1 = pair.r2;
    other.r2 = pair.r1;
    other.z1 = z2;
    other.z2 = z1;
    inputs_of(&other, y);
    // where the lean is short, its direction is rough
    CHECK_LE(largest_difference(x, y, NSVCD__DECODER_IN), 2e-4);
  }
}

static void degenerate_pairs_are_finite(void) {
  int8_t z[NSVCD__LATENT] = {0};
  int8_t other[NSVCD__LATENT];
  for (size_t k = 0; k < NSVCD__LATENT; k++)
    other[k] = (int8_t)(k % 100);
  for (int trial = 0; trial < 32; trial++) {
    pair_data pair;
    memset(&pair, 0, sizeof pair);
    random_rotation(pair.rotation);
    pair.z1 = trial & 1 ? z : other;
    pair.z2 = trial & 2 ? z : other;
    pair.r1 = trial & 4 ? 0 : 0.1f;
    pair.r2 = 0;
    for (size_t k = 0; k < 3; k++) {
      pair.p1[k] = trial & 8 ? 0.01f * uniform() : 0;
      pair.v[k] = trial & 16 ? 2 * pair.p1[k] : 0;  // along the line
    }
    float x[NSVCD__DECODER_IN];
    inputs_of(&pair, x);
    for (size_t k = 0; k < NSVCD__DECODER_IN; k++)
      CHECK(nsvcd__is_finite(x[k]));
    for (size_t h = 0; h < 3; h++)
      CHECK(nsvcd__is_finite(head_logit(&nsvcd_w_decoders[h], x, 0)));
  }
}

void test_network(void) {
  RUN(heads_fit_their_buffers);
  RUN(encoder_matches_the_trainer);
  RUN(heads_match_the_trainer);
  RUN(int8_heads_follow_fp32);
  RUN(encoder_is_equivariant);
  RUN(rotation_operator_is_a_group);
  RUN(inputs_are_invariant);
  RUN(inputs_do_not_depend_on_who_moves);
  RUN(degenerate_pairs_are_finite);
}
