// What src/interface/certificates.h promises: who has the two meshes and examples/verify, which
// shares nothing with the library, can check what is said of them. Here a test is both.
#include "scene.h"
#include "../../examples/verify/nsvcd_verify.h"

void promises_certificates(void);

#define FULL_TURN 6.283185307179586
#define ROOM 8192  // bytes of a certificate

// A body's mesh as the one who proves has it, and the one who checks.
typedef struct certified {
  nsvcd_mesh mesh;
  const nsvcd_tree *tree;
  nsvcd_verify_mesh checked;
  void *memory[2];
} certified;

static certified certified_box(float x, float y, float z) {
  certified c;
  memset(&c, 0, sizeof c);
  c.mesh = box_mesh(x, y, z);
  const size_t size = nsvcd_tree_size(&c.mesh);
  c.memory[0] = malloc(size);
  c.memory[1] = malloc(NSVCD_VERIFY_MESH_BYTES(c.mesh.vertex_count, c.mesh.triangle_count));
  CHECK_EQ(nsvcd_tree_build(&c.mesh, c.memory[0], size, &c.tree), NSVCD_OK);
  CHECK(!nsvcd_verify_mesh_init(c.mesh.positions, c.mesh.vertex_count, c.mesh.indices,
                                c.mesh.triangle_count, c.memory[1], &c.checked));
  return c;
}
static void certified_free(certified *c) {
  nsvcd_mesh_free(&c->mesh, NULL);
  free(c->memory[0]);
  free(c->memory[1]);
}

static nsvcd_certificate certify(const nsvcd_question *question, const certified *a,
                                 const certified *b, uint8_t *bytes) {
  const size_t size = nsvcd_certify_workspace_size(question, a->tree, b->tree);
  void *workspace = malloc(size);
  nsvcd_certificate made;
  memset(&made, 0, sizeof made);
  CHECK_EQ(nsvcd_certify(question, a->tree, b->tree, NULL, workspace, size, bytes, ROOM, &made),
           NSVCD_OK);
  CHECK_LE(made.size, ROOM);
  free(workspace);
  return made;
}

// What the checker says these bytes prove.
static nsvcd_verify_kind proven(const nsvcd_question *question, const certified *a,
                                const certified *b, const uint8_t *bytes, size_t size) {
  static const nsvcd_pose still = {{0, 0, 0}, {0, 0, 0, 1}};
  static double workspace[NSVCD_VERIFY_WORKSPACE_BYTES(16) / sizeof(double)];
  const nsvcd_verify_path paths[2] = {{question->a.poses->position, NULL, question->a.count},
                                      {still.position, NULL, 1}};
  nsvcd_verify_mover movers[2];
  nsvcd_verify_report report;
  CHECK(!nsvcd_verify_path_init(&a->checked, 1, &paths[0], &movers[0]));
  CHECK(!nsvcd_verify_path_init(&b->checked, 1, &paths[1], &movers[1]));
  nsvcd_verify(&movers[0], &movers[1], question->clearance, bytes, size, workspace,
               sizeof workspace, &report);
  return report.kind;
}

static void a_certificate_is_accepted_by_a_checker_that_shares_nothing(void) {
  certified cart = certified_box(1, 0.6f, 0.4f), post = certified_box(0.1f, 0.1f, 2);
  const nsvcd_pose past[2] = {at(-3, 0.4f, 0), at(3, 0.4f, 0)};
  const nsvcd_pose into[2] = {at(-3, 0.3f, 0), at(3, 0.3f, 0)};
  uint8_t bytes[ROOM];
  nsvcd_question question = question_about(NULL, past, 2, NULL);
  nsvcd_certificate made = certify(&question, &cart, &post, bytes);
  CHECK_EQ(made.verdict, NSVCD_FREE);
  CHECK_EQ(proven(&question, &cart, &post, bytes, made.size), NSVCD_VERIFY_FREE);
  question.clearance = 0.04f;
  made = certify(&question, &cart, &post, bytes);
  CHECK_EQ(made.verdict, NSVCD_FREE);
  CHECK_EQ(proven(&question, &cart, &post, bytes, made.size), NSVCD_VERIFY_FREE);
  question.clearance = 0;
  question.a.poses = into;
  made = certify(&question, &cart, &post, bytes);
  CHECK(made.verdict == NSVCD_HIT && made.time > 0 && made.time < 1);
  CHECK_EQ(proven(&question, &cart, &post, bytes, made.size), NSVCD_VERIFY_HIT);
  certified_free(&cart);
  certified_free(&post);
}

static void a_certificate_of_something_else_is_refused(void) {
  certified cart = certified_box(1, 0.6f, 0.4f), post = certified_box(0.1f, 0.1f, 2);
  certified thick = certified_box(0.3f, 0.3f, 2);
  const nsvcd_pose past[2] = {at(-3, 0.4f, 0), at(3, 0.4f, 0)};
  const nsvcd_pose nearer[2] = {at(-3, 0.38f, 0), at(3, 0.38f, 0)};
  uint8_t bytes[ROOM];
  nsvcd_question question = question_about(NULL, past, 2, NULL);
  const nsvcd_certificate made = certify(&question, &cart, &post, bytes);
  CHECK_EQ(proven(&question, &cart, &thick, bytes, made.size), NSVCD_VERIFY_NOTHING);
  CHECK_EQ(proven(&question, &post, &cart, bytes, made.size), NSVCD_VERIFY_NOTHING);
  CHECK_EQ(proven(&question, &cart, &post, bytes, made.size - 1), NSVCD_VERIFY_NOTHING);
  question.clearance = 0.01f;
  CHECK_EQ(proven(&question, &cart, &post, bytes, made.size), NSVCD_VERIFY_NOTHING);
  question.clearance = 0;
  question.a.poses = nearer;
  CHECK_EQ(proven(&question, &cart, &post, bytes, made.size), NSVCD_VERIFY_NOTHING);
  certified_free(&cart);
  certified_free(&post);
  certified_free(&thick);
}

// Of a motion that hits, whatever bytes are shown: those of a free one with each bit changed.
static void no_bytes_prove_what_is_not_so(void) {
  certified cart = certified_box(1, 0.6f, 0.4f), post = certified_box(0.1f, 0.1f, 2);
  const nsvcd_pose past[2] = {at(-3, 0.4f, 0), at(3, 0.4f, 0)};
  const nsvcd_pose into[2] = {at(-3, 0.3f, 0), at(3, 0.3f, 0)};
  uint8_t bytes[ROOM], hit[ROOM];
  nsvcd_question question = question_about(NULL, past, 2, NULL);
  const nsvcd_certificate made = certify(&question, &cart, &post, bytes);
  question.a.poses = into;
  certify(&question, &cart, &post, hit);
  memcpy(bytes + 1, hit + 1, 4);  // the digests of meshes and motion, which guard against mix-ups
  for (size_t bit = 0; bit < 8 * made.size; bit++) {
    bytes[bit / 8] ^= (uint8_t)(1 << bit % 8);
    CHECK(proven(&question, &cart, &post, bytes, made.size) != NSVCD_VERIFY_FREE);
    bytes[bit / 8] ^= (uint8_t)(1 << bit % 8);
  }
  certified_free(&cart);
  certified_free(&post);
}

static void a_certificate_is_refused_by_the_field_at_fault(void) {
  certified cart = certified_box(1, 0.6f, 0.4f);
  const nsvcd_pose past[2] = {at(-3, 0.4f, 0), at(3, 0.4f, 0)};
  uint8_t bytes[ROOM], workspace[8];
  nsvcd_certificate made;
  nsvcd_question question = question_about(NULL, past, 2, NULL);
  CHECK_EQ(nsvcd_certify(&question, cart.tree, cart.tree, NULL, workspace, 0, bytes, ROOM, &made),
           NSVCD_ERROR_WORKSPACE);
  question.slop = 0.01f;
  CHECK_EQ(nsvcd_certify(&question, cart.tree, cart.tree, NULL, workspace, 0, bytes, ROOM, &made),
           NSVCD_ERROR_SLOP);
  question.slop = 0;
  question.a.pivot[1] = 0.1f;
  CHECK_EQ(nsvcd_certify(&question, cart.tree, cart.tree, NULL, workspace, 0, bytes, ROOM, &made),
           NSVCD_ERROR_PIVOT);
  CHECK_EQ(nsvcd_certify(&question, NULL, cart.tree, NULL, workspace, 0, bytes, ROOM, &made),
           NSVCD_ERROR_ARGUMENT);
  certified_free(&cart);
}

// Of a mesh, of a motion, of a scale or of a clearance: by what it is called, and nothing is proven.
static void the_checker_refuses_what_is_no_number(void) {
  static const float bad[4] = {NAN, HUGE_VALF, -HUGE_VALF, 2e6f};
  certified cart = certified_box(1, 0.6f, 0.4f), post = certified_box(0.1f, 0.1f, 2);
  const nsvcd_pose past[2] = {at(-3, 0.4f, 0), at(3, 0.4f, 0)};
  uint8_t bytes[ROOM];
  nsvcd_question question = question_about(NULL, past, 2, NULL);
  const nsvcd_certificate made = certify(&question, &cart, &post, bytes);
  for (int k = 0; k < 4; k++) {
    nsvcd_verify_mesh mesh;
    nsvcd_verify_mover mover;
    nsvcd_pose wild[2] = {past[0], past[1]};
    const nsvcd_verify_path path = {wild->position, NULL, 2};
    CHECK(nsvcd_verify_path_init(&cart.checked, bad[k], &path, &mover) != NULL);
    for (int i = 0; i < 7; i++) {
      float *number = i < 3 ? &wild[1].position[i] : &wild[1].rotation[i - 3];
      const float kept = *number;
      *number = bad[k];
      CHECK(nsvcd_verify_path_init(&cart.checked, 1, &path, &mover) != NULL);
      *number = kept;
    }
    question.clearance = bad[k];
    CHECK_EQ(proven(&question, &cart, &post, bytes, made.size), NSVCD_VERIFY_NOTHING);
    const float kept = cart.mesh.positions[5];
    cart.mesh.positions[5] = bad[k];
    CHECK(nsvcd_verify_mesh_init(cart.mesh.positions, BOX_CORNERS, cart.mesh.indices, 12,
                                 cart.memory[1], &mesh) != NULL);
    cart.mesh.positions[5] = kept;
    CHECK(!nsvcd_verify_mesh_init(cart.mesh.positions, BOX_CORNERS, cart.mesh.indices, 12,
                                  cart.memory[1], &cart.checked));
  }
  question.clearance = 0;
  CHECK_EQ(proven(&question, &cart, &post, bytes, made.size), NSVCD_VERIFY_FREE);
  certified_free(&cart);
  certified_free(&post);
}

// A motion that no poses are: a mesh swings over another, and back, as sin(2 pi t). A chord of it is off
// by no more than an eighth of its second derivative. Each time that is told is a corner.
typedef struct swing {
  double height, way;
  size_t keyframes;
} swing;

static nsvcd_pose64 swing_place(const void *motion, double t) {
  const swing *s = (const swing *)motion;
  const nsvcd_pose64 out = {{s->way * sin(FULL_TURN * t), 0, s->height}, {0, 0, 0, 1}};
  return out;
}
static double swing_next(const void *motion, double t) {
  const double count = (double)((const swing *)motion)->keyframes - 1;
  return (floor(t * count + 1e-9) + 1) / count;
}
static nsvcd_deviation swing_deviation(const void *motion, double t0, double t1) {
  const double turn = FULL_TURN * (t1 - t0);
  const nsvcd_deviation out = {((const swing *)motion)->way * turn * turn / 8, 0, 0, {0, 0, 0}};
  return out;
}

// FREE over it, never through it, nor where there are more keyframes than there is room for.
static void any_motion_that_says_where_it_is_can_be_certified(void) {
  certified cart = certified_box(1, 1, 1), post = certified_box(1, 1, 1);
  uint8_t bytes[ROOM];
  for (int n = 0; n < 6; n++) {
    const swing still = {0, 0, 2};
    const swing past = {n < 3 ? 1.1 : 0.25, 1.5, n % 3 == 2 ? 60 : 9};
    const nsvcd_motion_model models[2] = {
        {1, swing_place, swing_next, swing_deviation, &past, 0, 1},
        {1, swing_place, swing_next, swing_deviation, &still, 0, 2}};
    nsvcd_certificate made;
    const size_t size = nsvcd_certify_models_workspace_size(11, cart.tree, post.tree);
    void *workspace = malloc(size);
    CHECK_EQ(nsvcd_certify_models(models, 11, 0, cart.tree, post.tree, NULL, workspace, size, bytes,
                                  sizeof bytes, &made),
             NSVCD_OK);
    CHECK_EQ(made.verdict == NSVCD_FREE, n < 2);
    if (n % 3 == 2) CHECK_EQ(made.visits, 1);  // more keyframes than there is room for
    CHECK_EQ(nsvcd_certify_models(models, 11, 0, cart.tree, post.tree, NULL, workspace, size - 8,
                                  bytes, sizeof bytes, &made),
             NSVCD_ERROR_WORKSPACE);
    CHECK_EQ(nsvcd_certify_models(NULL, 11, 0, cart.tree, post.tree, NULL, workspace, size, bytes,
                                  sizeof bytes, &made),
             NSVCD_ERROR_ARGUMENT);
    free(workspace);
  }
  certified_free(&cart);
  certified_free(&post);
}

void promises_certificates(void) {
  RUN(a_certificate_is_accepted_by_a_checker_that_shares_nothing);
  RUN(a_certificate_of_something_else_is_refused);
  RUN(no_bytes_prove_what_is_not_so);
  RUN(a_certificate_is_refused_by_the_field_at_fault);
  RUN(the_checker_refuses_what_is_no_number);
  RUN(any_motion_that_says_where_it_is_can_be_certified);
}

CHECK_ALONE(promises_certificates)
