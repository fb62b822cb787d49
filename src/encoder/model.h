// In: weights.h, which train/ generates. Out: its arrays: matrices are (inputs, outputs).
#pragma once
#include "../ground/compiler.h"

#ifndef NSVCD_NO_NETWORK
// A decoder: `layers` linear layers with ReLU between them, sizes multiples of 4 and, but for the
// inputs, of 16. Offsets instead of pointers: nothing needs relocation, so that all of it stays in
// read-only memory.
typedef struct nsvcd__decoder {
  // 0: compiled out
  size_t layers;
  // (layers + 1)
  size_t sizes[6];
  // of its matrices: per layer (sizes[l], sizes[l + 1]) floats in nsvcd_w_decoder, and the same
  // numbers in nsvcd_w_decoder_int8 as (sizes[l] / 4, sizes[l + 1], 4), over the output's scale
  size_t weights;
  // of its outputs: per layer (sizes[l + 1]) in nsvcd_w_decoder_bias, _scale and _sum (of the int8)
  size_t outputs;
} nsvcd__decoder;

#include "weights.h"

#define NSVCD__LATENT (8 * NSVCD_W_CHANNELS + NSVCD_W_SCALARS)
#endif  // NSVCD_NO_NETWORK
