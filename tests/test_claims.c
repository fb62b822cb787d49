// The claims of certificates: SHA-256 against published sums, the bytes that are hashed against a
// second writer of them, here; and that whatever is proven of changes the claim.
#include "../examples/verify/nsvcd_verify_claim.h"
#include "check.h"

void test_claims(void);

static void hash_of(const void *bytes, size_t size, size_t step, char *hex) {
  nsvcd_verify_sha sha;
  uint8_t hash[32];
  nsvcd_verify_sha_begin(&sha);
  for (size_t at = 0; at < size; at += step)
    nsvcd_verify_sha_add(&sha, (const char *)bytes + at, step < size - at ? step : size - at);
  nsvcd_verify_sha_end(&sha, hash);
  for (int k = 0; k < 32; k++) snprintf(hex + 2 * k, 3, "%02x", hash[k]);
}

// Of FIPS 180-4's examples, and of nothing.
static void sums_are_as_published(void) {
  static const char *const all[][2] = {
      {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
      {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
      {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
       "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"}};
  static char million[1000000];
  char hex[65];
  for (size_t k = 0; k < 3; k++) {
    for (size_t step = 1; step < 70; step += 17) {
      hash_of(all[k][0], strlen(all[k][0]), step, hex);
      CHECK(strcmp(hex, all[k][1]) == 0);
    }
  }
  memset(million, 'a', sizeof million);
  hash_of(million, sizeof million, 997, hex);
  CHECK(strcmp(hex, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0") == 0);
}

// ---- scenes

typedef struct scene {
  float positions[2][12];
  uint32_t indices[2][12];
  uint32_t memory[2][80];
  nsvcd_verify_mesh meshes[2];
  float scales[2], clearance;
  // paths
  float poses[2][21], times[3];
  nsvcd_verify_path paths[2];
  // a robot of three joints: two turn, and one, on the first, slides
  nsvcd_verify_joint joints[3];
  double points[15], seconds[3];
  nsvcd_verify_motion motion;
  nsvcd_verify_part parts[2];
} scene;

static void scene_of(scene *s) {
  static const uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  memset(s, 0, sizeof *s);
  for (int n = 0; n < 2; n++) {
    for (int k = 0; k < 3; k++) s->positions[n][3 * (k + 1) + k] = 1 + (float)n;
    memcpy(s->indices[n], faces, sizeof faces);
    s->scales[n] = 0.5f + (float)n;
    for (int k = 0; k < 3; k++) {
      s->poses[n][7 * k] = 5 * (float)n + 0.25f * (float)k;
      s->poses[n][7 * k + 6] = 1;
    }
    s->paths[n].poses = s->poses[n];
    s->paths[n].count = n ? 1 : 3;
    s->parts[n].motion = &s->motion;
    s->parts[n].link = n ? 3 : 2;
    s->parts[n].pose[n] = 0.125f;
    s->parts[n].pose[6] = 1;
  }
  s->clearance = 0.01f;
  s->times[1] = 0.375f;
  s->times[2] = 1;
  s->paths[0].times = s->times;
  for (uint32_t j = 0; j < 3; j++) {
    s->joints[j].slides = j == 2;
    s->joints[j].parent = j > 0;
    s->joints[j].origin[j] = 1.5f;
    s->joints[j].origin[6] = 1;
    s->joints[j].axis[2 - j] = 1;
    for (int k = 0; k < 5; k++)
      s->points[3 * k + (int)j] = 0.1 * (double)j + 0.01 * (double)(k * k);
  }
  s->seconds[1] = 0.75;
  s->seconds[2] = 2;
  s->motion.joints = s->joints;
  s->motion.joint_count = 3;
  s->motion.pieces = 2;
  s->motion.degree = 2;
  s->motion.points = s->points;
  s->motion.times = s->seconds;
}

static void claim_of(scene *s, int robot, int swaps, uint8_t *claim) {
  nsvcd_verify_mover movers[2];
  for (int n = 0; n < 2; n++) {
    nsvcd_verify_mesh *mesh = &s->meshes[n];
    CHECK_LE(NSVCD_VERIFY_MESH_BYTES(4, 4), sizeof s->memory[n]);
    CHECK(!nsvcd_verify_mesh_init(s->positions[n], 4, s->indices[n], 4, s->memory[n], mesh));
    if (robot) CHECK(!nsvcd_verify_part_init(mesh, s->scales[n], &s->parts[n], &movers[n]));
    if (!robot) CHECK(!nsvcd_verify_path_init(mesh, s->scales[n], &s->paths[n], &movers[n]));
  }
  CHECK(nsvcd_verify_claim(&movers[swaps], &movers[!swaps], s->clearance, claim));
}

// ---- the bytes, written again

typedef struct text {
  uint8_t bytes[1024];
  size_t size;
} text;

static void write_number(text *t, uint64_t bits, int size) {
  for (int k = 0; k < size; k++) t->bytes[t->size++] = (uint8_t)(bits >> 8 * k);
}
static void write_float(text *t, float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  write_number(t, bits, 4);
}
static void write_double(text *t, double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  write_number(t, bits, 8);
}
static void write_floats(text *t, const float *x, size_t count) {
  for (size_t k = 0; k < count; k++) write_float(t, x[k]);
}
static void write_hash(const text *from, uint8_t *hash) {
  nsvcd_verify_sha sha;
  nsvcd_verify_sha_begin(&sha);
  nsvcd_verify_sha_add(&sha, from->bytes, from->size);
  nsvcd_verify_sha_end(&sha, hash);
}

static void expected_claim(const scene *s, int robot, uint8_t *claim) {
  text all, mesh;
  memcpy(all.bytes, "nsvcd claim 1", 13);
  all.size = 13;
  write_float(&all, s->clearance);
  for (int n = 0; n < 2; n++) {
    memcpy(mesh.bytes, "nsvcd mesh 1", 12);
    mesh.size = 12;
    write_number(&mesh, 4, 4);
    write_number(&mesh, 4, 4);
    write_floats(&mesh, s->positions[n], 12);
    for (int k = 0; k < 12; k++) write_number(&mesh, s->indices[n][k], 4);
    write_hash(&mesh, all.bytes + all.size);
    all.size += 32;
    write_float(&all, s->scales[n]);
    if (!robot) {
      write_number(&all, 1, 1);
      write_number(&all, n ? 1 : 3, 4);
      write_number(&all, n ? 0 : 1, 1);
      write_floats(&all, s->poses[n], n ? 7 : 21);
      if (!n) write_floats(&all, s->times, 3);
      continue;
    }
    write_number(&all, 2, 1);
    write_number(&all, 0, 4);
    write_floats(&all, s->parts[n].pose, 7);
    for (int j = n ? 2 : 1; j >= 0; j = j > 0 ? 0 : -1) {  // link 2 or 3, then link 1
      write_number(&all, 1, 1);
      write_number(&all, j == 2, 4);
      write_floats(&all, s->joints[j].origin, 7);
      write_floats(&all, s->joints[j].axis, 3);
      for (int k = 0; k < 5; k++) write_double(&all, s->points[3 * k + j]);
    }
    write_number(&all, 0, 1);
    write_number(&all, 2, 4);
    write_number(&all, 2, 4);
    for (int k = 0; k < 3; k++) write_double(&all, s->seconds[k]);
  }
  CHECK_LE(all.size, sizeof all.bytes);
  write_hash(&all, claim);
}

static void bytes_are_as_described(void) {
  scene s;
  uint8_t claim[32], expected[32];
  scene_of(&s);
  for (int robot = 0; robot < 2; robot++) {
    claim_of(&s, robot, 0, claim);
    expected_claim(&s, robot, expected);
    CHECK(memcmp(claim, expected, sizeof claim) == 0);
  }
}

// Whatever a certificate proves something of changes its claim.
static void all_that_is_proven_of_counts(void) {
  enum { CHANGES = 17, ALL = 2 * CHANGES };
  static scene s;
  static uint8_t claims[ALL][32];
  for (int n = 0; n < ALL; n++) {
    const int robot = n / CHANGES;
    const int change = n % CHANGES;
    int swaps = 0;
    scene_of(&s);
    switch (change) {
      case 0:
        break;
      case 1:
        s.clearance = 0;
        break;
      case 2:
        s.positions[0][3] = nextafterf(1, 2);
        break;
      case 3:
        s.positions[1][11] = 1;
        break;
      case 4:
        memcpy(s.indices[0] + 9, s.indices[0] + 6, 3 * sizeof(uint32_t));
        break;
      case 5:
        s.scales[1] = 2;
        break;
      case 6:
        swaps = 1;
        break;
      case 7:
        (robot ? s.parts[0].pose : s.poses[0])[0] = -1;
        break;
      case 8:
        (robot ? s.parts[1].pose : s.poses[1])[1] = -1;
        break;
      case 9:
        robot ? (void)(s.seconds[1] = 1) : (void)(s.times[1] = 0.5f);
        break;
      case 10:
        robot ? (void)(s.motion.degree = 4, s.motion.pieces = 1) : (void)(s.paths[0].times = NULL);
        break;
      case 11:
        robot ? (void)(s.parts[0].link = 1) : (void)(s.paths[0].count = 2, s.times[1] = 1);
        break;
      case 12:
        robot ? (void)(s.joints[2].slides = 0) : (void)(s.poses[0][14] = 9);
        break;
      case 13:
        robot ? (void)(s.joints[1].parent = 0) : (void)(s.paths[1].count = 2);
        break;
      case 14:
        robot ? (void)(s.joints[0].origin[1] = 1) : (void)(s.paths[1].count = 3);
        break;
      case 15:
        robot ? (void)(s.joints[1].axis[0] = 1) : (void)(s.poses[1][2] = 1);
        break;
      default:
        robot ? (void)(s.points[7] = 3) : (void)(s.poses[0][9] = 1);
        break;
    }
    claim_of(&s, robot, swaps, claims[n]);
    for (int k = 0; k < n; k++) CHECK(memcmp(claims[n], claims[k], 32) != 0);
  }
}

static void place_nowhere(const void *motion, double t, nsvcd_verify_place *place) {
  (void)motion;
  (void)t;
  memset(place, 0, sizeof *place);
}
static void a_motion_of_ones_own_has_no_claim(void) {
  static scene s;
  nsvcd_verify_mover movers[2];
  uint8_t claim[32];
  scene_of(&s);
  claim_of(&s, 0, 0, claim);
  for (int n = 0; n < 2; n++)
    CHECK(!nsvcd_verify_path_init(&s.meshes[n], 1, &s.paths[n], &movers[n]));
  movers[1].place = place_nowhere;
  CHECK(!nsvcd_verify_claim(&movers[0], &movers[1], 0, claim));
  CHECK(!nsvcd_verify_claim(&movers[1], &movers[0], 0, claim));
}

void test_claims(void) {
  RUN(sums_are_as_published);
  RUN(bytes_are_as_described);
  RUN(all_that_is_proven_of_counts);
  RUN(a_motion_of_ones_own_has_no_claim);
}
CHECK_ALONE(test_claims)
