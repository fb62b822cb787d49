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

// Whatever one byte becomes, the blob is refused: the checksum's steps are bijections. Cut short:
// refused.
static void body_corruption(void) {
  const nsvcd_body *body = random_body(9, 1, 0, &blob_a_memory);
  const nsvcd_body *loaded = NULL;
  size_t size = body_bytes(body);
  char *copy = aligned(&blob_b_memory);
  size_t tried = 0;
  size_t refused = 0;
  for (size_t at = 0; at < size; at++) {
    for (int flip = 1; flip < 256; flip++) {
      memcpy(copy, body, size);
      copy[at] = (char)(copy[at] ^ flip);
      tried++;
      const nsvcd_result result = nsvcd_body_load(copy, size, &loaded);
      refused += result == NSVCD_ERROR_BODY || result == NSVCD_ERROR_VERSION;
    }
  }
  CHECK_EQ(tried, refused);
  memcpy(copy, body, size);
  for (size_t cut = 0; cut < size; cut++)
    CHECK_EQ(nsvcd_body_load(copy, cut, &loaded), NSVCD_ERROR_BODY);
  CHECK(loaded == NULL);  // outputs untouched
  memmove(copy + 4, copy, size);
  CHECK_EQ(nsvcd_body_load(copy + 4, size, &loaded), NSVCD_ERROR_BODY);
  CHECK_EQ(nsvcd_body_load(NULL, size, &loaded), NSVCD_ERROR_ARGUMENT);
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

// What is looked for in a blob to the bit is a float to the last digit: where constants are reckoned
// in double (s390x; x87 as C99), another would not be what was stored.
#define TEXT_OF(macro) TEXT(macro)
#define TEXT(text) #text
static void body_padding_is_a_float(void) {
  const double written = strtod(&TEXT_OF(NSVCD__NOWHERE)[1], NULL);  // behind the bracket
  CHECK_LE(written, -1e14);
  CHECK_EQ((float)written, written);
}

static void body_scale(void) {
  const float scales[5] = {0.25f, 1, 3.7f, 1e-4f, 1e4f};
  for (size_t n = 0; n < 5; n++) {
    const nsvcd_body *body = random_body(77, 1, 0.5, &blob_a_memory);
    const nsvcd_body *scaled = NULL;
    const nsvcd_body *loaded = NULL;
    char *memory = aligned(&blob_b_memory);
    double s = (double)scales[n];
    CHECK_EQ(nsvcd_body_scale(body, scales[n], memory, blob_capacity, &scaled), NSVCD_OK);
    CHECK_EQ(nsvcd_body_load(memory, body_bytes(body), &loaded), NSVCD_OK);
    for (size_t i = 0; i < 77; i++) {
      CHECK_NEAR(nsvcd__body_patches(scaled).z[i], s * (double)nsvcd__body_patches(body).z[i],
                 1e-6 * s);
      CHECK_NEAR(nsvcd__body_r(scaled)[i], s * (double)nsvcd__body_r(body)[i], 1e-6 * s);
      CHECK_NEAR(nsvcd__body_areas(scaled)[i], s * s * (double)nsvcd__body_areas(body)[i],
                 1e-6 * s * s);
    }
    CHECK(memcmp(nsvcd__body_latents(scaled), nsvcd__body_latents(body), 77 * NSVCD__LATENT) == 0);
    CHECK_NEAR(scaled->radius, s * (double)body->radius, 1e-4 * s);
  }
  const nsvcd_body *body = random_body(20, 1, 0, &blob_a_memory);
  const nsvcd_body *scaled = NULL;
  char *memory = aligned(&blob_b_memory);
  CHECK_EQ(nsvcd_body_scale(body, 0, memory, blob_capacity, &scaled), NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_body_scale(body, -1, memory, blob_capacity, &scaled), NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_body_scale(body, (float)NAN, memory, blob_capacity, &scaled), NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_body_scale(NULL, 1, memory, blob_capacity, &scaled), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_body_scale(body, 1, NULL, blob_capacity, &scaled), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_body_scale(body, (float)INFINITY, memory, blob_capacity, &scaled),
           NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_body_scale(body, 1e30f, memory, blob_capacity, &scaled), NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_body_scale(body, 1, memory, body_bytes(body) - 1, &scaled), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_body_scale(body, 1, memory + 4, blob_capacity - 4, &scaled),
           NSVCD_ERROR_WORKSPACE);
  CHECK(scaled == NULL);
}

void test_body(void) {
  RUN(body_round_trip);
  RUN(body_order);
  RUN(body_corruption);
  RUN(body_malice);
  RUN(body_padding_is_a_float);
  RUN(body_scale);
}

CHECK_ALONE(test_body)
