// verify.c - certificates on a microcontroller: in flash what a PC has proven of a mug and a dish
// rack (bake_certificates.c), here the checker alone, which neither needs nor trusts the library.
//
// A line each says what a certificate proves, and how many of TWISTED changes to it are refused:
// bits are flipped, its last byte is missing, or it stands under the head of the one before it.
// What is accepted nevertheless has to be true. Lines that begin with # are measurements, by the
// board alone: of trees that are built, and of certificates of what is free and of what is hit.
#include "../verify/nsvcd_verify.h"

#include "board.h"
#include "print.h"

typedef struct scene {
  uint32_t number;  // the question's
  int free;         // 1: the bodies never meet
  float scale, clearance;
  uint32_t poses, a_count, b_count;  // the first of poses_body; so many of a, then of b
  uint32_t at, size;                 // the first byte of certificates_body; so many
} scene;

#include "bodies.h"  // meshes, scenes_body, poses_body, certificates_body, by bake_certificates.c

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define VERTICES(name) (COUNT(name##_positions_body) / 3)
#define TRIANGLES(name) (COUNT(name##_indices_body) / 3)
#define TREE_WORDS(name) (NSVCD_VERIFY_MESH_BYTES(VERTICES(name), TRIANGLES(name)) / 4)
#define FLIPS 8
#define TWISTED (FLIPS + 2)
#define HEAD 5  // bytes: of version, kind, and what it is about

static uint32_t mug_tree[TREE_WORDS(mug)], rack_tree[TREE_WORDS(rack)];
static double workspace[NSVCD_VERIFY_WORKSPACE_BYTES(2 * POSES) / sizeof(double)];
static nsvcd_verify_mesh mug, rack;

// ------------------------------------------------------------------------------------ measurements

typedef struct tally {
  uint64_t sum, most, bytes;
  uint32_t count;
} tally;

static void add(tally *t, uint64_t taken, uint64_t bytes) {
  t->sum += taken;
  if (taken > t->most) t->most = taken;
  t->bytes += bytes;
  t->count++;
}

static void print_tally(const char *name, const tally *t) {
  if (!board_measures()) return;
  print_measurement(name, "workspace", sizeof mug_tree + sizeof rack_tree + sizeof workspace);
  if (t->bytes > 0) print_measurement(name, "certificates", t->bytes);
  print_measurement(name, "stack", board_stack_used());
  print_measurement(name, "mean", t->sum / t->count);
  print_measurement(name, "worst", t->most);
}

// ------------------------------------------------------------------------------------ certificates

// Is a certificate about a scene accepted? Digests of the motions, too, are computed here.
static int check(const scene *s, const uint8_t *bytes, size_t size, nsvcd_verify_report *report) {
  const float *poses = poses_body + 7 * s->poses;
  const nsvcd_verify_path a_path = {poses, NULL, s->a_count};
  const nsvcd_verify_path b_path = {poses + 7 * s->a_count, NULL, s->b_count};
  nsvcd_verify_mover a, b;
  report->reason = nsvcd_verify_path_init(&mug, s->scale, &a_path, &a);
  if (!report->reason) report->reason = nsvcd_verify_path_init(&rack, 1, &b_path, &b);
  return !report->reason &&
         nsvcd_verify(&a, &b, s->clearance, bytes, size, workspace, sizeof workspace, report);
}

static int is_true(const scene *s, const nsvcd_verify_report *report) {
  return (report->kind == NSVCD_VERIFY_FREE) == s->free;
}

// How many of the changed certificates are refused? More than there are: one proves what is false.
static uint32_t refused(const scene *s) {
  static uint8_t twisted[LARGEST];
  const uint8_t *bytes = certificates_body + s->at;
  const scene *other = s == scenes_body ? scenes_body + COUNT(scenes_body) - 1 : s - 1;
  uint32_t seed = s->number;
  uint32_t count = 0;
  for (uint32_t k = 0; k < TWISTED; k++) {
    nsvcd_verify_report report;
    const scene *about = k > FLIPS ? other : s;
    const size_t size = k == FLIPS ? s->size - 1 : s->size;
    memcpy(twisted, bytes, s->size);
    seed = seed * 1664525u + 1013904223u;
    const uint32_t bit = (seed >> 8) % (8 * s->size);
    if (k < FLIPS) twisted[bit / 8] ^= (uint8_t)(1u << bit % 8);
    if (k > FLIPS) memcpy(twisted + 1, certificates_body + other->at + 1, HEAD - 1);
    if (!check(about, twisted, size, &report))
      count++;
    else if (!is_true(about, &report) || k == FLIPS)
      return TWISTED + 1;
  }
  return count;
}

static int verify(const scene *s, tally *t) {
  static const char *const kinds[] = {"", "free", "hit", "near", "inside"};
  nsvcd_verify_report report;
  const uint64_t before = board_instructions();
  const int accepted = check(s, certificates_body + s->at, s->size, &report);
  add(t, board_instructions() - before, s->size);
  print_number(s->number);
  board_print(" ");
  board_print(accepted ? kinds[report.kind] : report.reason);
  if (accepted && report.kind != NSVCD_VERIFY_FREE) {
    board_print(" of ");
    print_number(report.a);
    board_print(" and ");
    print_number(report.b);
    board_print(" at ppm ");
    print_number((uint64_t)(1e6 * report.time));
  }
  const uint32_t count = refused(s);
  board_print(", changed: ");
  print_number(count);
  board_print(" refused\n");
  return accepted && is_true(s, &report) && count <= TWISTED;
}

static int verify_all(const char *name, int free) {
  tally t = {0, 0, 0, 0};
  int good = 1;
  board_stack_paint();
  for (const scene *s = scenes_body; s < scenes_body + COUNT(scenes_body); s++)
    if (s->free == free) good &= verify(s, &t);
  print_tally(name, &t);
  return good;
}

static int build_trees(void) {
  tally t = {0, 0, 0, 0};
  board_stack_paint();
  const uint64_t first = board_instructions();
  const char *why = nsvcd_verify_mesh_init(mug_positions_body, VERTICES(mug), mug_indices_body,
                                           TRIANGLES(mug), mug_tree, &mug);
  const uint64_t second = board_instructions();
  if (!why)
    why = nsvcd_verify_mesh_init(rack_positions_body, VERTICES(rack), rack_indices_body,
                                 TRIANGLES(rack), rack_tree, &rack);
  add(&t, second - first, 0);
  add(&t, board_instructions() - second, 0);
  print_tally("trees", &t);
  return !why;
}

int main(void) {
  if (!build_trees()) {
    board_print("a mesh is refused\n");
    return 1;
  }
  const int good = verify_all("free", 1);
  return verify_all("hit", 0) && good ? 0 : 1;
}
