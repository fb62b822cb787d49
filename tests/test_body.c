// Body blobs of the network: what they hold, in which order, and what is refused.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/body/trust.h"

#include "check.h"
#include "random_bodies.h"

void test_body(void);

static void body_round_trip(void) {
  CHECK_EQ(sizeof(struct nsvcd_body), 64);
  CHECK_EQ(nsvcd_body_size(0), 0);
  CHECK_EQ(nsvcd_body_size(NSVCD_MAX_PATCHES + 1), 0);
  CHECK_LE(nsvcd_body_size(512), 65535);
  for (size_t points = 1; points <= 512; points += points < 20 ? 1 : 41) {
    const nsvcd_body *body = random_body(points, 1, 0.3, &blob_a_memory);
    const nsvcd_body *loaded = NULL;
    memcpy(aligned(&blob_b_memory), body, body_bytes(body));
    CHECK_EQ(nsvcd_body_load(aligned(&blob_b_memory), body_bytes(body), &loaded), NSVCD_OK);
    CHECK((const void *)loaded == (const void *)aligned(&blob_b_memory));
    // The same patches, in another order: sums over patches of invariants of (x, r, area, latent)
    // agree.
    double want = 0;
    double got = 0;
    for (size_t i = 0; i < points; i++) {
      want += (double)(centres[3 * i] * areas[3 * i + 2] * radii[i]) *
              latents[NSVCD__LATENT * (i + 1) - 1];
      got += (double)(nsvcd__body_patches(body).x[i] *
                      nsvcd__body_areas(body)[2 * body->padded + i] * nsvcd__body_r(body)[i]) *
             nsvcd__body_latents(body)[NSVCD__LATENT * (i + 1) - 1];
    }
    CHECK_NEAR(want, got, 1e-9 * (fabs(want) + 1));
    for (size_t i = points; i < body->padded; i++) CHECK(nsvcd__body_r(body)[i] <= -1e14f);
  }
}

// The order visits every patch once, and neighbours end up together: groups are much smaller than
// the body.
static void body_order(void) {
  uint16_t order[NSVCD_SMALL_PATCHES];
  for (size_t points = 1; points <= 512; points += 37) {
    const nsvcd_body *body = random_body(points, 1, 0, &blob_a_memory);
    int seen[NSVCD_SMALL_PATCHES] = {0};
    put_in_order(points, order);
    for (size_t i = 0; i < points; i++) seen[order[i]]++;
    for (size_t i = 0; i < points; i++) CHECK_EQ(seen[i], 1);
    size_t groups = nsvcd__body_groups(body);
    for (size_t g = 0; g < groups; g++) {
      for (size_t i = NSVCD__GROUP * g; i < NSVCD__GROUP * (g + 1) && i < points; i++) {
        double dx = (double)nsvcd__body_patches(body).x[i] - (double)nsvcd__groups_of(body).x[g];
        double dy = (double)nsvcd__body_patches(body).y[i] - (double)nsvcd__groups_of(body).y[g];
        double dz = (double)nsvcd__body_patches(body).z[i] - (double)nsvcd__groups_of(body).z[g];
        double far = sqrt(dx * dx + dy * dy + dz * dz) + (double)nsvcd__body_r(body)[i];
        CHECK_LE(far, nsvcd__groups_of(body).r[g]);
      }
    }
    double sum = 0;
    for (size_t g = 0; g < groups; g++) sum += (double)nsvcd__groups_of(body).r[g];
    if (points > 256) CHECK_LE(sum / (double)groups, 0.45 * (double)body->radius);
  }
}

// With a valid checksum, every float replaced by a harmful one in turn: refused, or harmless (an
// area vector).
static void body_malice(void) {
  // NaN, inf, -inf, 1.7e38
  const uint32_t bad[4] = {0x7fc00000u, 0x7f800000u, 0xff800000u, 0x7f000000u};
  const nsvcd_body *body = random_body(9, 1, 0, &blob_a_memory);
  const nsvcd_body *loaded = NULL;
  size_t size = body_bytes(body);
  size_t floats_end = size - 9 * NSVCD__LATENT - 16 * 3 * NSVCD__EXTREMES;
  char *copy = aligned(&blob_b_memory);
  for (size_t at = offsetof(struct nsvcd_body, centre); at + 4 <= floats_end; at += 4) {
    if (at >= offsetof(struct nsvcd_body, open) && at < sizeof *body) continue;
    // the zeros at the end shift the latents' start by up to 15 bytes
    if (at + 16 > floats_end) continue;
    for (size_t n = 0; n < 4; n++) {
      memcpy(copy, body, size);
      memcpy(copy + at, &bad[n], 4);
      nsvcd_body *evil = (nsvcd_body *)(void *)copy;
      evil->checksum = nsvcd__body_checksum(evil);
      CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
    }
  }
  memcpy(copy, body, size);  // group and bounding spheres that do not cover
  nsvcd_body *evil = (nsvcd_body *)(void *)copy;
  float *group_r =
      (float *)(void *)(copy + ((const char *)nsvcd__groups_of(body).r - (const char *)body));
  group_r[0] *= 0.99f;
  evil->checksum = nsvcd__body_checksum(evil);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
  memcpy(copy, body, size);
  evil->radius *= 0.99f;
  evil->checksum = nsvcd__body_checksum(evil);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
  memcpy(copy, body, size);
  evil->extent *= 0.99f;
  evil->checksum = nsvcd__body_checksum(evil);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
  memcpy(copy, body, size);
  evil->weights_id++;
  evil->checksum = nsvcd__body_checksum(evil);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_VERSION);
}

// What is looked for in a blob to the bit is a float to the last digit: where constants are computed
// in double (s390x; x87 as C99), another would not be what was stored.
#define TEXT_OF(macro) TEXT(macro)
#define TEXT(text) #text
static void body_padding_is_a_float(void) {
  const double written = strtod(&TEXT_OF(NSVCD__NOWHERE)[1], NULL);  // behind the bracket
  CHECK_LE(written, -1e14);
  CHECK_EQ((float)written, written);
}

void test_body(void) {
  RUN(body_round_trip);
  RUN(body_order);
  RUN(body_malice);
  RUN(body_padding_is_a_float);
}

CHECK_ALONE(test_body)
