// In: weights.h, which train/ generates. Out: its arrays. Matrices are (inputs, outputs).
#pragma once
#include "../ground/compiler.h"

#ifndef NSVCD_NO_NETWORK
// A decoder: linear layers with ReLU between them. Offsets instead of pointers need no relocation,
// so that all of it stays in read-only memory.
typedef struct nsvcd__decoder {
  size_t layers;  // 0: compiled out
  // (layers + 1): of the inputs, a multiple of 4, and of the outputs of each layer, multiples of 16
  size_t sizes[6];
  // where its matrices begin: per layer (sizes[l], sizes[l + 1]) floats in nsvcd_w_decoder, and the
  // same numbers over the output's scale in nsvcd_w_decoder_int8, (sizes[l] / 4, sizes[l + 1], 4)
  size_t weights;
  // where numbers of its outputs begin: per layer (sizes[l + 1]) in nsvcd_w_decoder_bias, _scale
  // and _sum (of the int8)
  size_t outputs;
} nsvcd__decoder;

#include "weights.h"

#define NSVCD__LATENT (8 * NSVCD_W_CHANNELS + NSVCD_W_SCALARS)
#endif  // NSVCD_NO_NETWORK
