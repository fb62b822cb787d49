// The decoder: poses of pairs, what it is told of them, parity with the trainer, int8 against float.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/network/decoder.h"

#include "arrays.h"
#include "check.h"
#include "network_scene.h"
#include "random_motions.h"

void test_decoder(void);

// ------------------------------------------------------------------------------------------- poses

// Sixteen poses at once are those of the oracle.
static void poses_at_are_poses(void) {
  double worst = 0;
  for (int trial = 0; trial < 300; trial++) {
    double middle[3] = {uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)};
    size_t count = pick(1, 40);
    nsvcd_pose fixed = {{1, -2, 0.5f}, {0, 0, 0, 1}};
    float times[NSVCD__LANES], lanes[12][NSVCD__LANES];
    nsvcd__motion motion;
    memset(&motion, 0, sizeof motion);
    random_quat(fixed.rotation);
    random_motion(count, trial % 3, uniform(0, 12), 1, middle);
    CHECK_EQ(motion_init(poses, count, &fixed, &motion), NSVCD_OK);
    for (size_t l = 0; l < NSVCD__LANES; l++)
      times[l] = l == 0 ? 0 : l == 1 ? 1 : (float)uniform(0, 1);
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v_pose at = nsvcd__v_poses_at(&motion, times + l, NSVCD__SLICE);
      nsvcd__vmat3_store(lanes, l, nsvcd__vmat3_of(at.rotation));
      nsvcd__v3_store(lanes + 9, l, at.position);
    }
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      const oracle_pose moving = pose_at(poses, count, (double)times[l]);
      const oracle_pose at = seen_from(&fixed, &moving);
      double want[12];
      oracle_matrix(at.rotation, want);
      memcpy(want + 9, at.position, sizeof at.position);
      for (size_t k = 0; k < 12; k++) worst = fmax(worst, fabs((double)lanes[k][l] - want[k]));
    }
  }
  CHECK_LE(worst, 3e-5);  // t itself is rounded: 40 samples of speed 6 between them, times 6e-8
}

// Half the rotation vector of a quaternion, at every angle including 0 and pi.
static void half_rotation_vector(void) {
  const double angles[12] = {0, 1e-8, 1e-6, 1e-4, 1e-2, 0.5, 1.04, 1.05, 1.5, 3, 3.14, 3.1415};
  for (int trial = 0; trial < 1200; trial++) {
    float random[4], lanes[3 * NSVCD__SLICE];
    double axis[3];
    double length;
    double angle = angles[trial % 12];
    double s = sin(angle / 2);
    double sign = trial % 5 ? 1 : -1;
    random_quat(random);
    length = sqrt((double)(random[0] * random[0] + random[1] * random[1] + random[2] * random[2]));
    for (int k = 0; k < 3; k++) axis[k] = (double)random[k] / length;
    nsvcd__quat q;
    q.x = (float)(sign * s * axis[0]);
    q.y = (float)(sign * s * axis[1]);
    q.z = (float)(sign * s * axis[2]);
    q.w = (float)(sign * cos(angle / 2));
    const nsvcd__v3 w = nsvcd__v_half_rotation(nsvcd__vquat_set(q));
    nsvcd__v3_put(w, lanes, NSVCD__SLICE);
    for (int k = 0; k < 3; k++)
      CHECK_NEAR(lanes[k * NSVCD__SLICE + trial % NSVCD__SLICE], 0.5 * angle * axis[k], 3e-6);
  }
}

// ------------------------------------------------------------------------------- inputs and logits

// One pair, as nsvcd__pairs holds a slice of them.
typedef struct pair_data {
  float p1[3], p2[3], r1, r2, rotation[9], v[3], w[3];
  // of each patch, in its body's frame; tips as a body of one group has them
  float normal1[3], normal2[3], flat1, flat2;
  const int8_t *z1, *z2, *tips1, *tips2;
} pair_data;

// In lane `lane`, of a slice; the others hold the same pair, pushed apart.
static void inputs_in_lane(const pair_data *pair, size_t lane, float *x) {  // (DECODER_IN)
  static float batch[NSVCD__SLICE * NSVCD__DECODER_IN];
  const float *from[7] = {pair->p1, pair->p2,      pair->rotation, pair->v,
                          pair->w,  pair->normal1, pair->normal2};
  nsvcd__pairs pairs;
  nsvcd__v *to[7] = {&pairs.p1.x, &pairs.p2.x,        &pairs.rotation.x.x, &pairs.v.x,
                     &pairs.w.x,  &pairs.normal[0].x, &pairs.normal[1].x};
  for (size_t n = 0; n < 7; n++) {
    for (size_t k = 0; k < (n == 2 ? 9u : 3u); k++) {
      float lanes[NSVCD__SLICE];
      for (size_t l = 0; l < NSVCD__SLICE; l++)
        lanes[l] = from[n][k] + (n == 0 && l != lane ? 0.1f * (float)l : 0);
      to[n][k] = nsvcd__v_load(lanes);
    }
  }
  pairs.r1 = nsvcd__v_set(pair->r1);
  pairs.r2 = nsvcd__v_set(pair->r2);
  pairs.flat[0] = nsvcd__v_set(pair->flat1);
  pairs.flat[1] = nsvcd__v_set(pair->flat2);
  for (size_t l = 0; l < NSVCD__SLICE; l++) {
    pairs.z[0][l] = pair->z1;
    pairs.z[1][l] = pair->z2;
    pairs.extremes[0][l] = pair->tips1;
    pairs.extremes[1][l] = pair->tips2;
  }
  nsvcd__invariants(&pairs, NSVCD__SLICE, batch);
  memcpy(x, batch + NSVCD__DECODER_IN * lane, NSVCD__DECODER_IN * sizeof *x);
}

static void inputs_of(const pair_data *pair, float *x) {
  inputs_in_lane(pair, 5 % NSVCD__SLICE, x);
}

static void head_says(const nsvcd__decoder *head, const float *x, int int8, float *out) {
  static float batch[NSVCD__ROWS * NSVCD__DECODER_IN];
  const size_t rows = NSVCD__ROWS < 7 ? NSVCD__ROWS : 7;
  float said[NSVCD__ROWS][NSVCD__DECODER_OUT];
  for (size_t p = 0; p < rows; p++)
    memcpy(batch + NSVCD__DECODER_IN * p, x, NSVCD__DECODER_IN * sizeof *x);
  nsvcd__decoder_run(head, batch, rows, int8, said);
  memcpy(out, said[rows - 1], sizeof said[0]);
}

// golden_pair rows: two matrices, facts, what tiny, small and base say.
#define GOLDEN_ROW (18 + NSVCD__FACTS + 3 * NSVCD__DECODER_OUT)

static void golden_latents(size_t n, int8_t *z1, int8_t *z2) {
  for (size_t k = 0; k < NSVCD__LATENT; k++) {
    z1[k] = (int8_t)lrintf(127 * golden_latent[NSVCD__LATENT * (size_t)golden_index[2 * n] + k]);
    z2[k] =
        (int8_t)lrintf(127 * golden_latent[NSVCD__LATENT * (size_t)golden_index[2 * n + 1] + k]);
  }
}

// The inputs of the trainer's n-th pair, of which the first patch is the larger: x (DECODER_IN).
static void golden_inputs(size_t n, float *x) {
  const float *row = golden_pair + GOLDEN_ROW * n;
  static float batch[NSVCD__SLICE * NSVCD__DECODER_IN];
  int8_t z1[NSVCD__LATENT], z2[NSVCD__LATENT];
  nsvcd__pairs pairs;
  nsvcd__inputs inputs;
  golden_latents(n, z1, z2);
  for (size_t b = 0; b < 2; b++) {
    nsvcd__v *to = &inputs.turn[b].x.x;
    for (size_t k = 0; k < 9; k++) to[k] = nsvcd__v_set(row[9 * b + k]);
  }
  for (size_t l = 0; l < NSVCD__SLICE; l++) {
    pairs.z[0][l] = z1;
    pairs.z[1][l] = z2;
    for (size_t k = 0; k < NSVCD__FACTS; k++) inputs.facts[k][l] = row[18 + k];
  }
  const float larger = row[18 + NSVCD__FACT_RADIUS];
  inputs.keep = ~0u;
  inputs.k[0] = nsvcd__v_set(larger);
  inputs.k[1] = nsvcd__v_set(1 - larger);
  nsvcd__inputs_write(&inputs, &pairs, NSVCD__SLICE, batch);
  memcpy(x, batch, NSVCD__DECODER_IN * sizeof *x);
}

static void heads_match_the_trainer(void) {
  for (size_t n = 0; n < GOLDEN_PAIRS; n++) {
    float x[NSVCD__DECODER_IN], said[NSVCD__DECODER_OUT];
    golden_inputs(n, x);
    for (size_t h = 0; h < 3; h++) {
      head_says(&nsvcd_w_decoders[h], x, 0, said);
      for (size_t k = 0; k < NSVCD__DECODER_OUT; k++) {
        const float expected =
            golden_pair[GOLDEN_ROW * n + 18 + NSVCD__FACTS + NSVCD__DECODER_OUT * h + k];
        CHECK_NEAR(said[k], expected, 1e-4 * fmax(1, fabs((double)expected)));
      }
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
      float exact[NSVCD__DECODER_OUT], rounded[NSVCD__DECODER_OUT];
      head_says(&nsvcd_w_decoders[h], x, 0, exact);
      head_says(&nsvcd_w_decoders[h], x, 1, rounded);
      for (size_t k = 0; k < NSVCD__DECODER_OUT; k++) {
        const double error =
            fabs((double)(rounded[k] - exact[k])) / fmax(1, fabs((double)exact[k]));
        worst = fmax(worst, error);
        sum += error / (3 * NSVCD__DECODER_OUT * GOLDEN_PAIRS);
      }
    }
  }
  printf("  int8: mean difference %.4f, worst %.4f, of max(1, |output|)\n", sum, worst);
  CHECK_GE(worst, 1e-6);  // it is another arithmetic
  CHECK_LE(sum, 0.05);
  CHECK_LE(worst, 0.5);
}

// A random pair: latents (2, LATENT) and tips (2, TIPS, 3, GROUP) in the caller's memory.
#define TIPS_SIZE (NSVCD__EXTREMES * 3 * NSVCD__GROUP)
static void random_pair(size_t n, int8_t (*z)[NSVCD__LATENT], int8_t (*tips)[TIPS_SIZE],
                        pair_data *pair) {
  float *normals[2] = {pair->normal1, pair->normal2};
  golden_latents(n, z[0], z[1]);
  for (size_t b = 0; b < 2; b++) {
    double square = 0;
    for (size_t k = 0; k < 3; k++) {
      normals[b][k] = network_uniform();
      square += (double)(normals[b][k] * normals[b][k]);
    }
    // every eighth is closed, and has none
    for (size_t k = 0; k < 3; k++) normals[b][k] *= n % 8 == b ? 0 : (float)(1 / sqrt(square));
    for (size_t k = 0; k < TIPS_SIZE; k++) tips[b][k] = (int8_t)(100 * network_uniform());
  }
  random_rotation(pair->rotation);
  for (size_t k = 0; k < 3; k++) {
    pair->p1[k] = 0.03f * network_uniform();
    pair->p2[k] = pair->p1[k] + 0.05f * network_uniform();
    pair->v[k] = n == 0 ? 0 : 0.04f * network_uniform();
    pair->w[k] = n < 2 ? 0 : 0.2f * network_uniform();
  }
  pair->r1 = 0.045f + 0.025f * network_uniform();
  pair->r2 = 0.045f + 0.025f * network_uniform();
  pair->flat1 = 0.5f + 0.5f * network_uniform();
  pair->flat2 = 0.5f + 0.5f * network_uniform();
  pair->z1 = z[0];
  pair->z2 = z[1];
  pair->tips1 = tips[0];
  pair->tips2 = tips[1];
}

static void inputs_are_invariant(void) {
  for (size_t n = 0; n < GOLDEN_PAIRS; n++) {
    int8_t z[2][NSVCD__LATENT], tips[2][TIPS_SIZE];
    pair_data pair, moved;
    float x[NSVCD__DECODER_IN], y[NSVCD__DECODER_IN];
    random_pair(n, z, tips, &pair);
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
    int8_t z[2][NSVCD__LATENT], tips[2][TIPS_SIZE];
    pair_data pair, other;
    float x[NSVCD__DECODER_IN], y[NSVCD__DECODER_IN];
    random_pair(n, z, tips, &pair);
    inputs_of(&pair, x);
    transpose33(pair.rotation, other.rotation);  // body 2 in the axes of body 1
    mul33_vec(other.rotation, pair.p2, other.p1);
    mul33_vec(other.rotation, pair.p1, other.p2);
    mul33_vec(other.rotation, pair.v, other.v);
    mul33_vec(other.rotation, pair.w, other.w);
    for (size_t k = 0; k < 3; k++) {
      other.v[k] = -other.v[k];
      other.w[k] = -other.w[k];
    }
    other.r1 = pair.r2;
    other.r2 = pair.r1;
    memcpy(other.normal1, pair.normal2, sizeof other.normal1);
    memcpy(other.normal2, pair.normal1, sizeof other.normal2);
    other.flat1 = pair.flat2;
    other.flat2 = pair.flat1;
    other.z1 = z[1];
    other.z2 = z[0];
    other.tips1 = tips[1];
    other.tips2 = tips[0];
    inputs_of(&other, y);
    // where the lean is short, its direction is rough
    CHECK_LE(largest_difference(x, y, NSVCD__DECODER_IN), 2e-4);
  }
}

static void degenerate_pairs_are_finite(void) {
  int8_t z[NSVCD__LATENT] = {0};
  int8_t other[NSVCD__LATENT];
  static int8_t tips[TIPS_SIZE];
  for (size_t k = 0; k < NSVCD__LATENT; k++) other[k] = (int8_t)(k % 100);
  for (int trial = 0; trial < 32; trial++) {
    pair_data pair;
    memset(&pair, 0, sizeof pair);
    random_rotation(pair.rotation);
    pair.z1 = trial & 1 ? z : other;
    pair.z2 = trial & 2 ? z : other;
    pair.tips1 = pair.tips2 = tips;
    pair.r1 = trial & 4 ? 0 : 0.1f;
    pair.r2 = 0;
    for (size_t k = 0; k < 3; k++) {
      pair.p1[k] = trial & 8 ? 0.01f * network_uniform() : 0;
      pair.v[k] = trial & 16 ? 2 * pair.p1[k] : 0;  // along the line
    }
    float x[NSVCD__DECODER_IN];
    inputs_of(&pair, x);
    for (size_t k = 0; k < NSVCD__DECODER_IN; k++) CHECK(nsvcd__is_finite(x[k]));
    for (size_t h = 0; h < 3; h++) {
      float said[NSVCD__DECODER_OUT];
      head_says(&nsvcd_w_decoders[h], x, 0, said);
      CHECK(nsvcd__is_finite(said[0]) && nsvcd__is_finite(said[1]));
    }
  }
}

void test_decoder(void) {
  RUN(poses_at_are_poses);
  RUN(half_rotation_vector);
  RUN(heads_match_the_trainer);
  RUN(int8_heads_follow_fp32);
  RUN(inputs_are_invariant);
  RUN(inputs_do_not_depend_on_who_moves);
  RUN(degenerate_pairs_are_finite);
}

CHECK_ALONE(test_decoder)
