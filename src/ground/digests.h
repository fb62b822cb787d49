// In: words of 32 bits. Out: a digest of them.
#pragma once
#include "compiler.h"

// Continues a digest over (count) words of 32 bits.
static uint32_t nsvcd__digest(uint32_t digest, const void *words, size_t count) {
  for (size_t i = 0; i < count; i++) {
    uint32_t word;
    memcpy(&word, (const char *)words + 4 * i, 4);
    digest = (digest ^ word) * 0x9e3779b1u;
    digest ^= digest >> 15;
  }
  return digest;
}
