// Do weights.h and the header fit: shapes, the arrays' ends, the int8 copy, thresholds. What the
// numbers are worth is asked elsewhere: test_encoder.c, test_decoder.c, test_query.c.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/encoder/encoder.h"
#include "../src/network/decoder.h"

#include "check.h"

void test_weights(void);

#define WEIGHTS_OF(array) (sizeof(array) / sizeof *(array))

// -------------------------------------------------------------------------------------- decoders

static const size_t weights_widest[3] = {NSVCD__WIDEST_TINY, NSVCD__WIDEST_SMALL, NSVCD__WIDEST};

// From the inputs of a pair to one logit, in layers that fit the buffers.
static void weights_layers_fit(void) {
  size_t widest = 0;
  for (size_t h = 0; h < 3; h++) {
    const nsvcd__decoder *head = &nsvcd_w_decoders[h];
    CHECK(head->layers >= 2 && head->layers < WEIGHTS_OF(head->sizes));
    CHECK_EQ(head->sizes[0], NSVCD__DECODER_IN);
    CHECK_EQ(head->sizes[head->layers], 16);
    for (size_t l = 1; l <= head->layers; l++) {
      CHECK_EQ(head->sizes[l] % 16, 0);
      CHECK_LE(head->sizes[l], weights_widest[h]);
      widest = head->sizes[l] > widest ? head->sizes[l] : widest;
    }
  }
  CHECK_EQ(widest, NSVCD_W_WIDEST);
  CHECK(NSVCD__DECODER_IN >= NSVCD__INPUTS && NSVCD__DECODER_IN < NSVCD__INPUTS + 16);
}

// One decoder follows the other, and the last one ends where the arrays do.
static void weights_arrays_are_full(void) {
  size_t weights = 0;
  size_t outputs = 0;
  for (size_t h = 0; h < 3; h++) {
    const nsvcd__decoder *head = &nsvcd_w_decoders[h];
    CHECK_EQ(head->weights, weights);
    CHECK_EQ(head->outputs, outputs);
    for (size_t l = 0; l < head->layers; l++) {
      const nsvcd__layer layer = nsvcd__layer_of(head, l);
      CHECK_EQ(layer.weights, weights);
      CHECK_EQ(layer.first, outputs);
      CHECK_EQ(layer.relu, l + 1 < head->layers);
      weights += layer.inputs * layer.outputs;
      outputs += layer.outputs;
    }
  }
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_decoder), weights);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_decoder_int8), weights);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_decoder_bias), outputs);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_decoder_scale), outputs);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_decoder_sum), outputs);
}

// The weight from input i to output o, and its int8.
static float weights_float(const nsvcd__layer *layer, size_t i, size_t o) {
  return nsvcd_w_decoder[layer->weights + layer->outputs * i + o];
}
static int weights_int8(const nsvcd__layer *layer, size_t i, size_t o) {
  return nsvcd_w_decoder_int8[layer->weights + 4 * (layer->outputs * (i / 4) + o) + i % 4];
}

// Of each output the int8, times the scale, are the floats to half a step, use all of their range,
// and add up to what is stored.
static void weights_int8_are_the_floats(void) {
  double worst = 0;
  for (size_t h = 0; h < 3; h++) {
    for (size_t l = 0; l < nsvcd_w_decoders[h].layers; l++) {
      const nsvcd__layer layer = nsvcd__layer_of(&nsvcd_w_decoders[h], l);
      for (size_t o = 0; o < layer.outputs; o++) {
        const double scale = (double)nsvcd_w_decoder_scale[layer.first + o];
        int most = 0;
        int sum = 0;
        CHECK(scale > 0);
        for (size_t i = 0; i < layer.inputs; i++) {
          const int w = weights_int8(&layer, i, o);
          worst = fmax(worst, fabs((double)weights_float(&layer, i, o) / scale - w));
          most = abs(w) > most ? abs(w) : most;
          sum += w;
        }
        CHECK(most == 127 || most == 0);
        CHECK_EQ(nsvcd_w_decoder_sum[layer.first + o], sum);
      }
    }
  }
  printf("  int8: within %.4f of a step\n", worst);
  CHECK_LE(worst, 0.5 + 1e-3);  // scales and weights are written with seven digits
}

// What pads inputs and outputs to multiples of 16 takes no part.
static void weights_padding_is_zero(void) {
  for (size_t h = 0; h < 3; h++) {
    const nsvcd__decoder *head = &nsvcd_w_decoders[h];
    const nsvcd__layer first = nsvcd__layer_of(head, 0);
    const nsvcd__layer last = nsvcd__layer_of(head, head->layers - 1);
    for (size_t i = NSVCD__INPUTS; i < first.inputs; i++) {
      for (size_t o = 0; o < first.outputs; o++) CHECK_EQ(weights_float(&first, i, o), 0);
    }
    for (size_t o = NSVCD__DECODER_OUT; o < last.outputs; o++) {
      CHECK_EQ(nsvcd_w_decoder_bias[last.first + o], 0);
      for (size_t i = 0; i < last.inputs; i++) CHECK_EQ(weights_float(&last, i, o), 0);
    }
  }
}

// --------------------------------------------------------------------------------------- encoder

static void weights_encoder_has_its_shape(void) {
  const size_t hidden = NSVCD_W_POINT_HIDDEN;
  const size_t mix = NSVCD__WIDE * NSVCD_W_HIDDEN;
  const size_t out = NSVCD_W_HIDDEN * NSVCD_W_CHANNELS;
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_context1), 4 * NSVCD_W_CONTEXT);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_context2), 4 * NSVCD_W_CONTEXT);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_mix1), mix);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_mix2), mix);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_out1), out);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_out2), out);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_point0), NSVCD__INVARIANTS * hidden);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_point1), hidden * hidden);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_point2), hidden * NSVCD__GATES);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_point0_bias), hidden);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_point1_bias), hidden);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_point2_bias), NSVCD__GATES);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_patch0), NSVCD__PATCH_IN * NSVCD_W_PATCH_HIDDEN);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_patch1), NSVCD_W_PATCH_HIDDEN * NSVCD__PATCH_OUT);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_patch0_bias), NSVCD_W_PATCH_HIDDEN);
  CHECK_EQ(WEIGHTS_OF(nsvcd_w_patch1_bias), NSVCD__PATCH_OUT);
  CHECK(NSVCD_WEIGHTS_ID != 0);  // 0 is a body without latents
}

// --------------------------------------------------------------------------------------- numbers

// No NaN, nothing so large that products of a layer leave the range of floats, and not all zero.
static void weights_check_numbers(const char *name, const float *numbers, size_t count) {
  size_t bad = 0;
  size_t zeros = 0;
  for (size_t n = 0; n < count; n++) {
    bad += !(fabsf(numbers[n]) < 100);
    zeros += numbers[n] == 0;
  }
  if (bad > 0 || zeros == count) printf("  nsvcd_w_%s\n", name);
  CHECK_EQ(bad, 0);
  CHECK(zeros < count);
}

static void weights_are_numbers(void) {
#define NUMBERS(name) weights_check_numbers(#name, nsvcd_w_##name, WEIGHTS_OF(nsvcd_w_##name))
  NUMBERS(context1);
  NUMBERS(context2);
  NUMBERS(mix1);
  NUMBERS(mix2);
  NUMBERS(out1);
  NUMBERS(out2);
  NUMBERS(point0);
  NUMBERS(point0_bias);
  NUMBERS(point1);
  NUMBERS(point1_bias);
  NUMBERS(point2);
  NUMBERS(point2_bias);
  NUMBERS(patch0);
  NUMBERS(patch0_bias);
  NUMBERS(patch1);
  NUMBERS(patch1_bias);
  NUMBERS(decoder);
  NUMBERS(decoder_bias);
  NUMBERS(decoder_scale);
#undef NUMBERS
}

// ------------------------------------------------------------------------------------ thresholds

// The recalls that options.recall takes; the more collisions are to be found, the lower the
// threshold.
static void weights_thresholds_fall(void) {
  const float recalls[NSVCD_W_RECALLS] = {0, 0.99f, 0.999f, 0.9999f};
  for (size_t k = 0; k < NSVCD_W_RECALLS; k++) CHECK_EQ(nsvcd_w_recall[k], recalls[k]);
  for (size_t h = 0; h < 3; h++) {
    for (size_t n = 0; n < NSVCD_W_SIZES; n++) {
      const float *row = nsvcd_w_threshold[h][n];
      CHECK_LE(fabsf(row[0]), 1);  // balanced errors: about where the logit is 0
      for (size_t k = 1; k < NSVCD_W_RECALLS; k++)
        CHECK(row[k] <= row[k - 1] && row[k] > -NSVCD_LOGIT_CERTAIN);
      CHECK(row[NSVCD_W_RECALLS - 1] < row[0]);
    }
  }
}

void test_weights(void) {
  RUN(weights_layers_fit);
  RUN(weights_arrays_are_full);
  RUN(weights_int8_are_the_floats);
  RUN(weights_padding_is_zero);
  RUN(weights_encoder_has_its_shape);
  RUN(weights_are_numbers);
  RUN(weights_thresholds_fall);
}

CHECK_ALONE(test_weights)
