// In: invariants of pairs (n, DECODER_IN). Out: a logit each, and the pair's least distance. Pairs
// come in batches of up to 16, and their invariants go through the layers some rows at a time.
#pragma once
#include "invariants.h"

#ifndef NSVCD_NO_NETWORK
#define NSVCD__BATCH NSVCD__LANES
// Rows of inputs at a time, and how many of them layers of floats take together. A machine without
// vectors may have no stack for more; without floats, more than one row at a time gains nothing.
#if NSVCD__SLICE > 1
#define NSVCD__ROWS NSVCD__BATCH
#define NSVCD__ROW_STEP 4
#elif !defined(NSVCD_NO_FLOAT)
#define NSVCD__ROWS 4
#define NSVCD__ROW_STEP 4
#else
#define NSVCD__ROWS 1
#define NSVCD__ROW_STEP 1
#endif
// Most outputs of a layer in the decoders that are compiled. The tests compare them to weights.h.
#define NSVCD__WIDEST_TINY 32
#define NSVCD__WIDEST_SMALL 96
#ifndef NSVCD_NO_BASE
#define NSVCD__WIDEST NSVCD_W_WIDEST
#elif !defined(NSVCD_NO_SMALL)
#define NSVCD__WIDEST NSVCD__WIDEST_SMALL
#else
#define NSVCD__WIDEST NSVCD__WIDEST_TINY
#endif
#define NSVCD__MOST_INPUTS \
  (NSVCD__WIDEST > NSVCD__DECODER_IN ? NSVCD__WIDEST : NSVCD__DECODER_IN)

// What a decoder makes of a pair.
enum {
  NSVCD__OUT_LOGIT,
  NSVCD__OUT_DISTANCE,  // the least distance, or minus the depth, in tenths of r1 + r2
  NSVCD__DECODER_OUT
};

// A layer, y = w^T x + bias, and where its numbers begin.
typedef struct nsvcd__layer {
  size_t inputs, outputs;  // multiples of 4, and of 16
  size_t weights;          // (inputs, outputs) in nsvcd_w_decoder, and in nsvcd_w_decoder_int8
  size_t first;            // (outputs) in nsvcd_w_decoder_bias, _scale and _sum
  int relu;                // of all layers but the last
} nsvcd__layer;

// The n-th layer of a decoder.
static nsvcd__layer nsvcd__layer_of(const nsvcd__decoder *decoder, size_t n) {
  const size_t *sizes = decoder->sizes;
  nsvcd__layer out;
  out.inputs = sizes[n];
  out.outputs = sizes[n + 1];
  out.weights = decoder->weights;
  out.first = decoder->outputs;
  out.relu = n + 1 < decoder->layers;
  for (size_t k = 0; k < n; k++) {
    out.weights += sizes[k] * sizes[k + 1];
    out.first += sizes[k + 1];
  }
  return out;
}

#ifndef NSVCD_NO_FLOAT
// Outputs o .. o + tiles * SLICE - 1 of a layer for so many rows: x, a row every `pitch` floats,
// and y (rows, WIDEST). rows * tiles sums must fit into the registers.
NSVCD__INLINE void nsvcd__layer_tile(const nsvcd__layer *layer, size_t o, const float *x,
                                     size_t pitch, float *y, size_t rows, size_t tiles) {
  const size_t inputs = layer->inputs;
  const size_t outputs = layer->outputs;
  const int relu = layer->relu;
  const float *w = nsvcd_w_decoder + layer->weights + o;
  const float *bias = nsvcd_w_decoder_bias + layer->first + o;
  nsvcd__v sum[8][4], column[4];
  NSVCD__UNROLL
  for (size_t p = 0; p < rows; p++) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) sum[p][t] = nsvcd__v_load(bias + NSVCD__SLICE * t);
  }
  for (size_t i = 0; i < inputs; i++, w += outputs) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) column[t] = nsvcd__v_load(w + NSVCD__SLICE * t);
    NSVCD__UNROLL
    for (size_t p = 0; p < rows; p++) {
      const nsvcd__v input = nsvcd__v_set(x[pitch * p + i]);
      NSVCD__UNROLL
      for (size_t t = 0; t < tiles; t++) sum[p][t] = nsvcd__v_fma(input, column[t], sum[p][t]);
    }
  }
  NSVCD__UNROLL
  for (size_t p = 0; p < rows; p++) {
    float *row = y + NSVCD__WIDEST * p + o;
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) {
      const nsvcd__v value = relu ? nsvcd__v_max(sum[p][t], nsvcd__v_set(0)) : sum[p][t];
      nsvcd__v_store(row + NSVCD__SLICE * t, value);
    }
  }
}

// A layer in fp32, for `count` rows, a multiple of ROW_STEP: x, a row every `pitch` floats, and y
// (count, WIDEST). The weights of the largest decoder do not fit into the first cache, so that more
// rows at a time are faster: 8 by 2 or 4 by 4 sums in 32 registers; in fewer, 4 rows by 16 outputs,
// or by 4 slices if that is less.
#define NSVCD__TILES (NSVCD__LANES / NSVCD__SLICE < 4 ? NSVCD__LANES / NSVCD__SLICE : 4)
static NSVCD__NOINLINE void nsvcd__layer_by_floats(const nsvcd__layer *layer, const float *x,
                                                   size_t pitch, size_t count, float *y) {
  const size_t outputs = layer->outputs;
  size_t p = 0;
  size_t o;
#if NSVCD__SLICE == 16
  for (; p + 8 <= count; p += 8, x += 8 * pitch, y += 8 * NSVCD__WIDEST) {
    for (o = 0; o + 32 <= outputs; o += 32) nsvcd__layer_tile(layer, o, x, pitch, y, 8, 2);
    if (o < outputs) nsvcd__layer_tile(layer, o, x, pitch, y, 8, 1);
  }
#endif
  for (; p < count; p += 4, x += 4 * pitch, y += 4 * NSVCD__WIDEST) {
#if NSVCD__SLICE == 16
    for (o = 0; o + 64 <= outputs; o += 64) nsvcd__layer_tile(layer, o, x, pitch, y, 4, 4);
    for (; o + 32 <= outputs; o += 32) nsvcd__layer_tile(layer, o, x, pitch, y, 4, 2);
    if (o < outputs) nsvcd__layer_tile(layer, o, x, pitch, y, 4, 1);
#else
    for (o = 0; o < outputs; o += NSVCD__TILES * NSVCD__SLICE)
      nsvcd__layer_tile(layer, o, x, pitch, y, 4, NSVCD__TILES);
#endif
  }
}
#endif  // NSVCD_NO_FLOAT

#ifndef NSVCD_NO_INT8
// nsvcd__layer_by_bytes is a layer in integers, for BYTE_ROWS rows, which share the weights that
// are loaded: x, a row every `pitch` floats, and y (BYTE_ROWS, WIDEST), which may be x. Inputs are
// divided by the largest, and become bytes in [1, 255] about 128: processors multiply unsigned by
// signed bytes. Weights are (inputs / 4, outputs, 4). Sums are exact in int32, and too large by 128
// times the sum of the weights.
#ifdef NSVCD__VNNI
#define NSVCD__BYTE_ROWS 4
// Outputs o .. o + 16 tiles - 1 of bytes (4, inputs): dot (4, outputs).
NSVCD__INLINE void nsvcd__dot_tile(const nsvcd__layer *layer, size_t o, const uint8_t *bytes,
                                   int32_t *dot, size_t tiles) {
  const size_t inputs = layer->inputs;
  const size_t outputs = layer->outputs;
  const int8_t *w = nsvcd_w_decoder_int8 + layer->weights + 4 * o;
  __m512i sum[4][4];
  NSVCD__UNROLL
  for (size_t p = 0; p < 4; p++) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) sum[p][t] = _mm512_setzero_si512();
  }
  for (size_t i = 0; i < inputs; i += 4, w += 4 * outputs) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) {
      const __m512i column = _mm512_loadu_si512((const void *)(w + 64 * t));
      NSVCD__UNROLL
      for (size_t p = 0; p < 4; p++) {
        int32_t word;
        memcpy(&word, bytes + inputs * p + i, sizeof word);
        sum[p][t] = _mm512_dpbusd_epi32(sum[p][t], _mm512_set1_epi32(word), column);
      }
    }
  }
  NSVCD__UNROLL
  for (size_t p = 0; p < 4; p++) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++)
      _mm512_storeu_si512((void *)(dot + outputs * p + o + 16 * t), sum[p][t]);
  }
}
static void nsvcd__layer_by_bytes(const nsvcd__layer *layer, const float *x, size_t pitch,
                                  float *y) {
  const size_t outputs = layer->outputs;
  const float *weights = nsvcd_w_decoder_sum + layer->first;
  const float *scale = nsvcd_w_decoder_scale + layer->first;
  const float *bias = nsvcd_w_decoder_bias + layer->first;
  uint8_t bytes[NSVCD__BYTE_ROWS * NSVCD__MOST_INPUTS];
  int32_t dot[NSVCD__BYTE_ROWS * NSVCD__WIDEST];
  float step[NSVCD__BYTE_ROWS];
  for (size_t p = 0; p < NSVCD__BYTE_ROWS; p++) {
    const float *row = x + pitch * p;
    uint8_t *to = bytes + layer->inputs * p;
    __m512 most = _mm512_set1_ps(1e-20f);
    for (size_t i = 0; i < layer->inputs; i += 16)
      most = nsvcd__v_max(most, _mm512_abs_ps(_mm512_loadu_ps(row + i)));
    const float largest = 0 - nsvcd__v_least(nsvcd__v_sub(nsvcd__v_set(0), most));
    const __m512 inverse = _mm512_set1_ps(127 / largest);
    const __m512 middle = _mm512_set1_ps(128.5f);
    for (size_t i = 0; i < layer->inputs; i += 16) {
      const __m512 scaled = _mm512_fmadd_ps(_mm512_loadu_ps(row + i), inverse, middle);
      const __m512i value = _mm512_maskz_cvttps_epi32(NSVCD__ALL, scaled);
      const __m128i narrow = _mm512_maskz_cvtepi32_epi8(NSVCD__ALL, value);
      _mm_storeu_si128((__m128i *)(void *)(to + i), narrow);
    }
    step[p] = largest / 127;
  }
  size_t o = 0;
  for (; o + 64 <= outputs; o += 64) nsvcd__dot_tile(layer, o, bytes, dot, 4);
  for (; o + 32 <= outputs; o += 32) nsvcd__dot_tile(layer, o, bytes, dot, 2);
  if (o < outputs) nsvcd__dot_tile(layer, o, bytes, dot, 1);
  const __m512 least = _mm512_set1_ps(layer->relu ? 0 : -1e30f);
  const __m512 middle = _mm512_set1_ps(-128);
  for (size_t p = 0; p < NSVCD__BYTE_ROWS; p++) {
    const __m512 steps = _mm512_set1_ps(step[p]);
    for (o = 0; o < outputs; o += 16) {
      const __m512i whole = _mm512_loadu_si512((const void *)(dot + outputs * p + o));
      const __m512 value = _mm512_maskz_cvtepi32_ps(NSVCD__ALL, whole);
      const __m512 exact = _mm512_fmadd_ps(_mm512_loadu_ps(weights + o), middle, value);
      const __m512 factor = _mm512_mul_ps(steps, _mm512_loadu_ps(scale + o));
      const __m512 out = _mm512_fmadd_ps(exact, factor, _mm512_loadu_ps(bias + o));
      _mm512_storeu_ps(y + NSVCD__WIDEST * p + o, nsvcd__v_max(least, out));
    }
  }
}
#else
#define NSVCD__BYTE_ROWS 1
static void nsvcd__layer_by_bytes(const nsvcd__layer *layer, const float *x, size_t pitch,
                                  float *y) {
  const size_t inputs = layer->inputs;
  const size_t outputs = layer->outputs;
  const int8_t *w = nsvcd_w_decoder_int8 + layer->weights;
  const float *weights = nsvcd_w_decoder_sum + layer->first;
  const float *scale = nsvcd_w_decoder_scale + layer->first;
  const float *bias = nsvcd_w_decoder_bias + layer->first;
  uint8_t bytes[NSVCD__MOST_INPUTS];
  int32_t dot[NSVCD__WIDEST];
  float most = 1e-20f;
  (void)pitch;
  for (size_t i = 0; i < inputs; i++) most = fabsf(x[i]) > most ? fabsf(x[i]) : most;
  const float inverse = 127 / most;
  const float step = most / 127;
  for (size_t i = 0; i < inputs; i++) bytes[i] = (uint8_t)(int32_t)(x[i] * inverse + 128.5f);
  memset(dot, 0, outputs * sizeof *dot);
  for (size_t i = 0; i < inputs; i += 4, w += 4 * outputs) {
    const int32_t x0 = bytes[i];
    const int32_t x1 = bytes[i + 1];
    const int32_t x2 = bytes[i + 2];
    const int32_t x3 = bytes[i + 3];
    for (size_t o = 0; o < outputs; o++) {
      dot[o] += (x0 * w[4 * o] + x1 * w[4 * o + 1]) + (x2 * w[4 * o + 2] + x3 * w[4 * o + 3]);
    }
  }
  for (size_t o = 0; o < outputs; o++) {
    const float exact = (float)dot[o] - 128 * weights[o];
    const float value = bias[o] + exact * (step * scale[o]);
    y[o] = layer->relu && value < 0 ? 0 : value;
  }
}
#endif
#endif  // NSVCD_NO_INT8

// x (ROWS, DECODER_IN) -> out (count, DECODER_OUT), of the first `count` pairs, in fp32 or int8
// arithmetic. x must hold numbers up to a multiple of ROW_STEP rows.
static NSVCD__NOINLINE void nsvcd__decoder_run(const nsvcd__decoder *decoder, const float *x,
                                               size_t count, int int8,
                                               float (*out)[NSVCD__DECODER_OUT]) {
  float a[NSVCD__ROWS * NSVCD__WIDEST];
#ifndef NSVCD_NO_FLOAT
  float b[NSVCD__ROWS * NSVCD__WIDEST];
#else
  float *const b = a;  // layers in integers need no second array
#endif
  float *y = a;
  size_t pitch = NSVCD__DECODER_IN;
  for (size_t n = 0; n < decoder->layers; n++) {
    const nsvcd__layer layer = nsvcd__layer_of(decoder, n);
#ifndef NSVCD_NO_INT8
    for (size_t p = 0; p < count && int8; p += NSVCD__BYTE_ROWS)
      nsvcd__layer_by_bytes(&layer, x + pitch * p, pitch, y + NSVCD__WIDEST * p);
#endif
#ifndef NSVCD_NO_FLOAT
    const size_t rows = nsvcd__round_up(count, NSVCD__ROW_STEP);
    if (!int8) nsvcd__layer_by_floats(&layer, x, pitch, rows, y);
#endif
    x = y;
    pitch = NSVCD__WIDEST;
    y = y == a ? b : a;
  }
  for (size_t p = 0; p < count; p++) memcpy(out[p], x + pitch * p, sizeof out[p]);
}
#endif  // NSVCD_NO_NETWORK
