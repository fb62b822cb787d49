// SPDX-License-Identifier: MIT
// nsvcd_verify_claim.h - beside nsvcd_verify.h: a name of 32 bytes for what a certificate is about, by
// which a log of proofs can be held against what a robot is told to do. No proof rests on it.
//
// A claim is the SHA-256 (FIPS 180-4) of these bytes, numbers little-endian, floats by their bits:
//   nsvcd claim 1            13 characters
//   clearance                32-bit float, metres
//   and of both movers, a and b:
//   mesh                     32 bytes: the SHA-256 of `nsvcd mesh 1`, numbers of vertices and of
//                            triangles (32 bits each), positions (32-bit floats), indices (32 bits)
//   scale                    32-bit float
//   a path                   1 (a byte), number of poses (32 bits), 1 if it has times (a byte), poses
//                            (7 32-bit floats each), times (32-bit floats)
//   or a part of a robot     2 (a byte), base (32 bits), pose (7 32-bit floats); of each joint, from its
//                            link to the base: 1 (a byte), slides (32 bits), origin, axis (10 32-bit
//                            floats), points (64-bit floats); 0 (a byte); numbers of pieces and
//                            degree (32 bits each), times (64-bit floats)
// So two scenes have one claim only if all that is proven of them is the same, but for what nobody
// finds: another scene with the same SHA-256.
#ifndef NSVCD_VERIFY_CLAIM_H
#define NSVCD_VERIFY_CLAIM_H
#include "nsvcd_verify_robot.h"

typedef struct nsvcd_verify_sha {
  uint32_t state[8];
  uint64_t size;  // bytes taken
  uint8_t block[64];
} nsvcd_verify_sha;

static inline uint32_t verify__turned(uint32_t x, int by) {
  return x >> by | x << (32 - by);
}

static inline void verify__sha_block(uint32_t *state, const uint8_t *block) {
  static const uint32_t keys[64] = {
      0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4,
      0xab1c5ed5, 0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe,
      0x9bdc06a7, 0xc19bf174, 0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f,
      0x4a7484aa, 0x5cb0a9dc, 0x76f988da, 0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7,
      0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967, 0x27b70a85, 0x2e1b2138, 0x4d2c6dfc,
      0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85, 0xa2bfe8a1, 0xa81a664b,
      0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070, 0x19a4c116,
      0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
      0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7,
      0xc67178f2};
  uint32_t w[64], s[8];
  memcpy(s, state, sizeof s);
  for (int i = 0; i < 64; i++) {
    const uint8_t *four = block + 4 * (i % 16);
    w[i] = (uint32_t)four[0] << 24 | (uint32_t)four[1] << 16 | (uint32_t)four[2] << 8 | four[3];
    if (i >= 16) {
      const uint32_t x = w[i - 15];
      const uint32_t y = w[i - 2];
      w[i] = w[i - 16] + (verify__turned(x, 7) ^ verify__turned(x, 18) ^ x >> 3) + w[i - 7] +
             (verify__turned(y, 17) ^ verify__turned(y, 19) ^ y >> 10);
    }
    const uint32_t e = s[4];
    const uint32_t a = s[0];
    const uint32_t mixed = s[7] + keys[i] + w[i] + ((e & s[5]) ^ (~e & s[6])) +
                           (verify__turned(e, 6) ^ verify__turned(e, 11) ^ verify__turned(e, 25));
    const uint32_t added = ((a & s[1]) ^ (a & s[2]) ^ (s[1] & s[2])) +
                           (verify__turned(a, 2) ^ verify__turned(a, 13) ^ verify__turned(a, 22));
    memmove(s + 1, s, 7 * sizeof *s);
    s[4] += mixed;
    s[0] = mixed + added;
  }
  for (int i = 0; i < 8; i++) state[i] += s[i];
}

static inline void nsvcd_verify_sha_begin(nsvcd_verify_sha *sha) {
  static const uint32_t first[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                    0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  memcpy(sha->state, first, sizeof first);
  sha->size = 0;
}

static inline void nsvcd_verify_sha_add(nsvcd_verify_sha *sha, const void *bytes, size_t size) {
  for (size_t i = 0; i < size; i++) {
    sha->block[sha->size++ % 64] = ((const uint8_t *)bytes)[i];
    if (sha->size % 64 == 0) verify__sha_block(sha->state, sha->block);
  }
}

static inline void nsvcd_verify_sha_end(nsvcd_verify_sha *sha, uint8_t hash[32]) {
  const uint64_t bits = 8 * sha->size;
  uint8_t byte = 0x80;
  do {
    nsvcd_verify_sha_add(sha, &byte, 1);
    byte = 0;
  } while (sha->size % 64 != 56);
  for (int i = 0; i < 8; i++) {
    byte = (uint8_t)(bits >> (56 - 8 * i));
    nsvcd_verify_sha_add(sha, &byte, 1);
  }
  for (int i = 0; i < 32; i++) hash[i] = (uint8_t)(sha->state[i / 4] >> (24 - 8 * (i % 4)));
}

// Adds (count) words of 32 or 64 bits, little-endian.
static inline void verify__tell(nsvcd_verify_sha *sha, const void *words, size_t count,
                                size_t size) {
  for (size_t i = 0; i < count; i++) {
    uint8_t bytes[8];
    uint64_t word;
    uint32_t half;
    memcpy(&half, (const char *)words + size * i, 4);
    word = half;
    if (size == 8) memcpy(&word, (const char *)words + size * i, 8);
    for (size_t k = 0; k < size; k++) bytes[k] = (uint8_t)(word >> 8 * k);
    nsvcd_verify_sha_add(sha, bytes, size);
  }
}

static inline void verify__tell_number(nsvcd_verify_sha *sha, size_t number) {
  const uint32_t word = (uint32_t)number;
  verify__tell(sha, &word, 1, 4);
}

static inline void verify__tell_mesh(nsvcd_verify_sha *all, const nsvcd_verify_mesh *m) {
  nsvcd_verify_sha sha;
  uint8_t hash[32];
  nsvcd_verify_sha_begin(&sha);
  nsvcd_verify_sha_add(&sha, "nsvcd mesh 1", 12);
  verify__tell_number(&sha, m->vertices);
  verify__tell_number(&sha, m->triangles);
  verify__tell(&sha, m->positions, 3 * m->vertices, 4);
  verify__tell(&sha, m->indices, 3 * m->triangles, 4);
  nsvcd_verify_sha_end(&sha, hash);
  nsvcd_verify_sha_add(all, hash, 32);
}

static inline void verify__tell_path(nsvcd_verify_sha *sha, const nsvcd_verify_path *p) {
  const uint8_t timed = p->times && p->count > 1;
  nsvcd_verify_sha_add(sha, "\1", 1);
  verify__tell_number(sha, p->count);
  nsvcd_verify_sha_add(sha, &timed, 1);
  verify__tell(sha, p->poses, 7 * p->count, 4);
  if (timed) verify__tell(sha, p->times, p->count, 4);
}

static inline void verify__tell_part(nsvcd_verify_sha *sha, const nsvcd_verify_part *part) {
  const nsvcd_verify_motion *m = part->motion;
  nsvcd_verify_sha_add(sha, "\2", 1);
  verify__tell_number(sha, part->base);
  verify__tell(sha, part->pose, 7, 4);
  for (uint32_t link = part->link; link != part->base; link = m->joints[link - 1].parent) {
    const nsvcd_verify_joint *joint = &m->joints[link - 1];
    nsvcd_verify_sha_add(sha, "\1", 1);
    verify__tell_number(sha, joint->slides);
    verify__tell(sha, joint->origin, 7, 4);
    verify__tell(sha, joint->axis, 3, 4);
    for (size_t i = 0; i <= m->pieces * m->degree; i++)
      verify__tell(sha, &m->points[i * m->joint_count + link - 1], 1, 8);
  }
  nsvcd_verify_sha_add(sha, "\0", 1);
  verify__tell_number(sha, m->pieces);
  verify__tell_number(sha, m->degree);
  verify__tell(sha, m->times, m->pieces + 1, 8);
}

// Writes the claim of two movers, of nsvcd_verify_path_init or nsvcd_verify_part_init, and a clearance in
// metres. 0: a motion of your own has none.
static inline int nsvcd_verify_claim(const nsvcd_verify_mover *a, const nsvcd_verify_mover *b,
                                     float clearance, uint8_t claim[32]) {
  const nsvcd_verify_mover *movers[2] = {a, b};
  nsvcd_verify_sha sha;
  nsvcd_verify_sha_begin(&sha);
  nsvcd_verify_sha_add(&sha, "nsvcd claim 1", 13);
  verify__tell(&sha, &clearance, 1, 4);
  for (int k = 0; k < 2; k++) {
    const float scale = (float)movers[k]->scale;
    const int is_path = movers[k]->place == verify__path_place;
    if (!is_path && movers[k]->place != verify__part_place) return 0;
    verify__tell_mesh(&sha, movers[k]->mesh);
    verify__tell(&sha, &scale, 1, 4);
    if (is_path) verify__tell_path(&sha, (const nsvcd_verify_path *)movers[k]->motion);
    if (!is_path) verify__tell_part(&sha, (const nsvcd_verify_part *)movers[k]->motion);
  }
  nsvcd_verify_sha_end(&sha, claim);
  return 1;
}
#endif  // NSVCD_VERIFY_CLAIM_H
