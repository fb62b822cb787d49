// random_bodies.h - bodies without a mesh: spheres strewn in a box or over a ball, as blobs of the
// network. After the implementation and check.h.
#ifndef NSVCD_TESTS_RANDOM_BODIES_H
#define NSVCD_TESTS_RANDOM_BODIES_H

#include "random_numbers.h"

#define BLOB 65536

typedef union blob {
  uint64_t align[BLOB / 8];
  char bytes[BLOB];
} blob;

static blob blob_a_memory, blob_b_memory;

static char *aligned(blob *b) {
  return b->bytes + (16 - (uintptr_t)b->bytes % 16) % 16;
}
static const size_t blob_capacity = BLOB - 16;

static float centres[3 * NSVCD_SMALL_PATCHES], radii[NSVCD_SMALL_PATCHES],
    areas[3 * NSVCD_SMALL_PATCHES];

static int8_t latents[NSVCD_SMALL_PATCHES * NSVCD__LATENT];
static int8_t tips[NSVCD_SMALL_PATCHES * 3 * NSVCD__EXTREMES];
static int random_tips;

// Puts the patches of `centres` in order (points).
static void put_in_order(size_t points, uint16_t *order) {
  uint16_t spare[NSVCD_SMALL_PATCHES];
  const nsvcd__f3 *at = (const nsvcd__f3 *)(const void *)centres;
  for (size_t i = 0; i < points; i++) order[i] = (uint16_t)i;
  nsvcd__body_order(at, order, spare, points);
}

static const nsvcd_body *build(size_t points, blob *memory) {
  uint16_t order[NSVCD_SMALL_PATCHES];
  nsvcd__latents source;
  put_in_order(points, order);
  for (size_t k = 0; k < sizeof tips; k++) {
    // of a cube about the ball: what it parts, the ball does too; or within the ball
    tips[k] = k / 3 >> k % 3 & 1 ? 127 : -127;
    if (random_tips) tips[k] = (int8_t)((int)pick(0, 146) - 73);
  }
  source.count = points;
  source.centres = (nsvcd__f3 *)(void *)centres;
  source.radii = radii;
  source.areas = (nsvcd__f3 *)(void *)areas;
  source.extremes = tips;
  source.latents = latents;
  source.order = order;
  source.open = 0;
  CHECK_LE(nsvcd_body_size(points), blob_capacity);
  CHECK_EQ(nsvcd__body_build(&source, aligned(memory)), NSVCD_OK);
  return (const nsvcd_body *)(const void *)aligned(memory);
}

// Spheres strewn in a box of the given size whose middle is `offset` away from the body's origin.
static const nsvcd_body *random_body(size_t points, double size, double offset, blob *memory) {
  for (size_t i = 0; i < points; i++) {
    for (size_t k = 0; k < 3; k++) {
      centres[3 * i + k] = (float)(uniform(-0.5, 0.5) * size + (k == 1 ? offset : 0));
      areas[3 * i + k] = (float)(uniform(-1, 1) * size * size);
    }
    radii[i] = (float)(size * uniform(0, 1.0 / cbrt((double)points)) * 0.3);
    for (size_t k = 0; k < NSVCD__LATENT; k++)
      latents[NSVCD__LATENT * i + k] = (int8_t)pick(0, 200);
  }
  return build(points, memory);
}

// Points spread evenly over a sphere (spiral), as closed patches that cover it; the radius covers
// the patch.
static const nsvcd_body *shell_body(size_t points, double radius, blob *memory) {
  double area = 4 * 3.14159265358979 * radius * radius / (double)points;
  for (size_t i = 0; i < points; i++) {
    double z = 1 - (2.0 * (double)i + 1) / (double)points;
    double s = sqrt(1 - z * z);
    double angle = 2.39996322973 * (double)i;
    double n[3] = {s * cos(angle), s * sin(angle), z};
    for (size_t k = 0; k < 3; k++) {
      centres[3 * i + k] = (float)(radius * n[k]);
      areas[3 * i + k] = (float)(area * n[k]);
    }
    radii[i] = (float)(1.3 * sqrt(area / 3.14159265358979));
  }
  memset(latents, 1, sizeof latents);
  return build(points, memory);
}

static size_t body_bytes(const nsvcd_body *body) {
  return nsvcd_body_size(body->patches);
}

#endif
