// robot_scene.h - robots for tests: random trees of joints, and an arm among boxes, whose parts are
// bodies and, for the oracle, meshes. Include neuralsvcd.h, shapes.h, oracle.h, poses.h and check.h
// before it.
#ifndef NSVCD_TESTS_ROBOT_SCENE_H
#define NSVCD_TESTS_ROBOT_SCENE_H

#include "body_of.h"
#include "placed.h"

#define SHAPES 7
#define FAR_SHAPE 6  // 1 m from its origin
#define MOST_PARTS 160
#define SMALL 0.3f  // scale of an arm's small parts
#ifndef ROBOT_BALLS
#define ROBOT_BALLS 0  // of each shape
#endif

// Meshes, as bodies and for the oracle; made once.
typedef struct robot_shape {
  const nsvcd_body *body;
  oracle_mesh exact;
  double *points;
  size_t count;
} robot_shape;

static robot_shape shape_of(shapes_mesh *mesh) {
  robot_shape out;
  nsvcd_encode_options options;
  memset(&out, 0, sizeof out);
  memset(&options, 0, sizeof options);
  options.balls = ROBOT_BALLS;
  out.body = body_of(mesh, &options);
  out.points = mesh->positions;
  out.count = mesh->vertices;
  if (!oracle_mesh_init(&out.exact, out.points, out.count, mesh->indices, mesh->triangles, 1))
    exit(1);
  free(mesh->indices);
  return out;
}

static inline void free_shape(robot_shape *shape) {
  nsvcd_body_free(shape->body, NULL);
  oracle_mesh_free(&shape->exact);
  free(shape->points);
}

static robot_shape *robot_shapes(void) {
  static robot_shape made[SHAPES];
  if (made[0].body) return made;
  for (int n = 0; n < SHAPES; n++) {
    shapes_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    if (n == 0) shapes_box(&mesh, 0.1, 0.1, 0.1, 1);
    if (n == 1) shapes_capsule(&mesh, 0.04, 0.4, 12);
    if (n == 2) shapes_box(&mesh, 0.3, 0.3, 0.02, 1);
    if (n == 3) shapes_torus(&mesh, 0.12, 0.03, 16, 8);
    if (n == 4) shapes_l_bracket(&mesh, 0.2, 0.15, 0.03, 0.05);
    if (n == 5) shapes_bowl(&mesh, 0.1, 0.07, 0.01, 16);
    if (n == FAR_SHAPE) shapes_box_at(&mesh, 1, 0, 0, 0.05, 0.05, 0.05);
    made[n] = shape_of(&mesh);
  }
  return made;
}

typedef struct robot {
  nsvcd_scene scene;
  nsvcd_joint joints[NSVCD_MAX_JOINTS];
  nsvcd_part parts[MOST_PARTS];
  int shape[MOST_PARTS];
  nsvcd_body_pair pairs[MOST_PARTS * MOST_PARTS];
  void *memory;
  nsvcd_checker *checker;
} robot;

static nsvcd_pose robot_pose(shapes_rng *rng, double reach) {
  oracle_pose pose;
  shapes_quaternion(rng, pose.rotation);
  shapes_direction(rng, pose.position);
  for (int k = 0; k < 3; k++) pose.position[k] *= reach;
  return pose_rounded(&pose);
}

static void robot_open(robot *r) {
  r->scene.joints = r->joints;
  r->scene.parts = r->parts;
  r->scene.pairs = r->pairs;
  const size_t size = nsvcd_checker_size(&r->scene);
  r->memory = calloc(1, size);
  if (!size || !r->memory) exit(1);
  CHECK_EQ(nsvcd_checker_open(&r->scene, r->memory, size, &r->checker), NSVCD_OK);
}

// Joints of one kind, each on the link before it, at its place and without an axis; and parts of no
// body there, of which the first is asked about with each other one.
static void robot_bare(robot *r, nsvcd_joint_kind kind, uint32_t joints, uint32_t parts,
                       double limit) {
  memset(r, 0, sizeof *r);
  r->scene.joint_count = joints;
  r->scene.part_count = parts;
  r->scene.pair_count = parts - 1;
  for (uint32_t j = 0; j < joints; j++) {
    r->joints[j].kind = kind;
    r->joints[j].parent = j;
    r->joints[j].origin.rotation[3] = 1;
    r->joints[j].low = -limit;
    r->joints[j].high = limit;
  }
  for (uint32_t n = 0; n < parts; n++) {
    r->parts[n].pose.rotation[3] = 1;
    if (n) r->pairs[n - 1].b = n;
  }
}

// A tree of joints of all kinds, with a body on each link, anywhere in it.
static void robot_random_of(robot *r, shapes_rng *rng, size_t joints) {
  memset(r, 0, sizeof *r);
  r->scene.joints = r->joints;
  r->scene.parts = r->parts;
  r->scene.joint_count = joints;
  r->scene.part_count = r->scene.joint_count;
  const int is_chain = shapes_pick(rng, 2);
  for (size_t i = 0; i < r->scene.joint_count; i++) {
    nsvcd_joint *joint = &r->joints[i];
    const int kind = shapes_pick(rng, 4);
    joint->kind = kind == 3 ? NSVCD_JOINT_REVOLUTE : (nsvcd_joint_kind)kind;
    joint->parent = is_chain ? (uint32_t)i : (uint32_t)shapes_pick(rng, (int)i + 1);
    joint->origin = robot_pose(rng, shapes_uniform(rng, 0, 0.5));
    double axis[3];
    shapes_direction(rng, axis);
    for (int k = 0; k < 3; k++) joint->axis[k] = (float)(axis[k] * (1 + kind));
    joint->low = -3;
    joint->high = 3;
    r->shape[i] = shapes_pick(rng, SHAPES);
    r->parts[i].body = robot_shapes()[r->shape[i]].body;
    r->parts[i].link = (uint32_t)i + 1;
    r->parts[i].pose = robot_pose(rng, shapes_uniform(rng, 0, 0.4));
    r->parts[i].scale = shapes_pick(rng, 2) ? 0 : (float)shapes_uniform(rng, 0.5, 2);
    // far from its origin, and near to the joint
    if (r->shape[i] != FAR_SHAPE) continue;
    r->parts[i].scale = 1;
    const oracle_pose at = pose_widened(&r->parts[i].pose);
    const double centre[3] = {1, 0, 0};
    double m[9], off[3];
    oracle_matrix(at.rotation, m);
    oracle_rotate(m, centre, off);
    for (int k = 0; k < 3; k++) r->parts[i].pose.position[k] = (float)-off[k];
  }
}

static void robot_random(robot *r, shapes_rng *rng) {
  robot_random_of(r, rng, 1 + (size_t)shapes_pick(rng, 8));
}

static double scale_of_part(const nsvcd_part *part) {
  return part->scale > 0 ? (double)part->scale : 1;
}

// An arm of six joints like many that are sold, a tool, and boxes about it.
static void robot_arm(robot *r, shapes_rng *rng, size_t boxes) {
  static const double reach[6] = {0.1, 0.15, 0.4, 0.35, 0.1, 0.1};
  memset(r, 0, sizeof *r);
  r->scene.joint_count = 6;
  for (size_t i = 0; i < 6; i++) {
    nsvcd_joint *joint = &r->joints[i];
    joint->parent = (uint32_t)i;
    joint->origin.rotation[3] = 1;
    joint->origin.position[2] = (float)reach[i];
    // about z, then y, y, y, z, y
    joint->axis[i == 0 || i == 4 ? 2 : 1] = 1;
    joint->low = -3.1;
    joint->high = 3.1;
    nsvcd_part *part = &r->parts[r->scene.part_count];
    r->shape[r->scene.part_count++] = i == 5 ? 4 : 1;
    part->link = (uint32_t)i + 1;
    part->pose.rotation[3] = 1;
    part->pose.position[2] = i == 1 ? 0.2f : i == 2 ? 0.17f : 0.05f;
    part->scale = i == 1 || i == 2 ? 1 : SMALL;
  }
  for (size_t n = 0; n < boxes; n++) {
    double place[3];
    nsvcd_part *part = &r->parts[r->scene.part_count];
    r->shape[r->scene.part_count++] = shapes_pick(rng, SHAPES);
    part->pose = robot_pose(rng, 0);
    shapes_direction(rng, place);
    for (int k = 0; k < 3; k++)
      part->pose.position[k] = (float)(shapes_uniform(rng, 0.4, 1.1) * place[k] + (k == 2) * 0.4);
  }
  for (uint32_t a = 0; a < r->scene.part_count; a++) {
    r->parts[a].body = robot_shapes()[r->shape[a]].body;
    for (uint32_t b = a + 1; b < r->scene.part_count; b++) {
      // neighbours overlap
      if (a >= 6 || (b < 6 && b < a + 3)) continue;
      const nsvcd_body_pair pair = {a, b};
      r->pairs[r->scene.pair_count++] = pair;
    }
  }
  robot_open(r);
}

// A shape for the oracle in the scale of small parts, made once, or in its own.
static const oracle_mesh *robot_exact(int shape, const nsvcd_part *part) {
  static oracle_mesh small[SHAPES];
  robot_shape *own = &robot_shapes()[shape];
  if (!(part->scale > 0 && part->scale < 1)) return &own->exact;
  if (!small[shape].triangle_count) {
    // corners of all triangles, as a mesh of its own: what is welded stays so, for they are equal
    const size_t count = own->exact.triangle_count;
    double *corners = (double *)calloc(9 * count, sizeof(double));
    uint32_t *indices = (uint32_t *)calloc(3 * count, sizeof(uint32_t));
    if (!corners || !indices) exit(1);
    for (size_t i = 0; i < 9 * count; i++)
      corners[i] = (double)SMALL * own->exact.triangles[i / 9].v[i / 3 % 3][i % 3];
    for (size_t i = 0; i < 3 * count; i++) indices[i] = (uint32_t)i;
    if (!oracle_mesh_init(&small[shape], corners, 3 * count, indices, count, 1)) exit(1);
    free(corners);
    free(indices);
  }
  return &small[shape];
}

// How near a pair comes in a configuration, up to `limit`; less than 0 where one is inside of the
// other.
static double robot_apart(const robot *r, const nsvcd_body_pair *pair, const double *q,
                          double limit) {
  const size_t parts[2] = {pair->a, pair->b};
  const oracle_mesh *meshes[2];
  oracle_pose poses[2];
  oracle_search search;
  for (int n = 0; n < 2; n++) {
    const placed at = placed_part(&r->scene, parts[n], q);
    poses[n] = oracle_of(&at);
    meshes[n] = robot_exact(r->shape[parts[n]], &r->parts[parts[n]]);
  }
  double centres[2][3], off[3];
  for (int n = 0; n < 2; n++) oracle_transform(&poses[n], meshes[n]->center, centres[n]);
  oracle_sub(centres[0], centres[1], off);
  if (oracle_length(off) > meshes[0]->radius + meshes[1]->radius + limit) return limit;
  oracle_search_begin(&search, meshes[0], meshes[1]);
  const double apart = oracle_search_run(&search, &poses[0], &poses[1], limit);
  const int inside = oracle_inside(meshes[0], &poses[0], meshes[1], &poses[1]) > 0.5 ||
                     oracle_inside(meshes[1], &poses[1], meshes[0], &poses[0]) > 0.5;
  return inside ? -1 : apart;
}

#endif
