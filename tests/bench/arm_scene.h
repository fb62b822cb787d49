// arm_scene.h - an arm of six joints with a gripper of 100,000 triangles, among shelves, in a box, on
// and under a table, in a cage; and configurations at places in them. Include neuralsvcd.h first.
#ifndef NSVCD_TESTS_ARM_SCENE_H
#define NSVCD_TESTS_ARM_SCENE_H

#include "../../examples/scenery/oracle.h"
#include "../../examples/scenery/poses.h"
#include "../body_of.h"
#include "../placed.h"

#define ARM_JOINTS 6
#define ARM_PARTS 7
#define ARM_TOOL 6
#define ARM_MOST_PARTS 100
#define ARM_REACH 0.17  // from the last joint to between the fingers' tips

typedef enum arm_kind {
  ARM_SHELF_SMALL,
  ARM_SHELF_TALL,
  ARM_SHELF_THIN,
  ARM_BOX,
  ARM_ON_TABLE,
  ARM_UNDER_TABLE,
  ARM_CAGE,
  ARM_KINDS
} arm_kind;

static const char *const arm_kinds[ARM_KINDS] = {
    "shelf, small", "shelf, tall", "shelf, thin", "box", "on a table", "under it", "cage"};

typedef struct arm_scene {
  nsvcd_scene scene;
  nsvcd_joint joints[ARM_JOINTS];
  nsvcd_part parts[ARM_MOST_PARTS];
  oracle_mesh meshes[ARM_MOST_PARTS];
  nsvcd_body_pair pairs[ARM_MOST_PARTS * ARM_PARTS];
  size_t pair_count;
  void *memory;
  nsvcd_checker *checker;
} arm_scene;

// Adds a part; the mesh is freed.
static size_t arm_add(arm_scene *s, shapes_mesh *mesh, uint32_t link, double x, double y,
                      double z) {
  const size_t n = s->scene.part_count++;
  if (n >= ARM_MOST_PARTS) exit(1);
  nsvcd_part *part = &s->parts[n];
  memset(part, 0, sizeof *part);
  nsvcd_encode_options options;
  memset(&options, 0, sizeof options);
  options.balls = link ? 128 : 0;
  part->body = body_of(mesh, &options);
  if (!oracle_mesh_init(&s->meshes[n], mesh->positions, mesh->vertices, mesh->indices,
                        mesh->triangles, 1))
    exit(1);
  part->link = link;
  part->pose.rotation[3] = 1;
  part->pose.position[0] = (float)x;
  part->pose.position[1] = (float)y;
  part->pose.position[2] = (float)z;
  shapes_free(mesh);
  memset(mesh, 0, sizeof *mesh);
  return n;
}

static void arm_box(arm_scene *s, double x, double y, double z, double dx, double dy, double dz) {
  shapes_mesh mesh;
  memset(&mesh, 0, sizeof mesh);
  shapes_box(&mesh, dx, dy, dz, 1);
  arm_add(s, &mesh, 0, x, y, z);
}

// In the sizes of a common arm of 5 kg; the links are capsules, hollow nowhere.
static void arm_make(arm_scene *s) {
  static const double origins[ARM_JOINTS][3] = {{0, 0, 0.089}, {0, 0.136, 0}, {0, -0.12, 0.425},
                                                {0, 0, 0.392}, {0, 0.093, 0}, {0, 0, 0.095}};
  static const int axes[ARM_JOINTS] = {2, 1, 1, 1, 2, 1};
  // radius and straight length of the link's capsule, and its middle
  static const double links[ARM_JOINTS][5] = {
      {0.06, 0.1, 0, 0.03, 0},   {0.055, 0.425, 0, 0, 0.2125}, {0.045, 0.392, 0, 0, 0.196},
      {0.042, 0.06, 0, 0.05, 0}, {0.042, 0.06, 0, 0, 0.05},    {0, 0, 0, 0, 0}};
  shapes_mesh mesh;
  memset(s, 0, sizeof *s);
  memset(&mesh, 0, sizeof mesh);
  s->scene.joints = s->joints;
  s->scene.parts = s->parts;
  s->scene.pairs = s->pairs;
  s->scene.joint_count = ARM_JOINTS;
  for (uint32_t i = 0; i < ARM_JOINTS; i++) {
    nsvcd_joint *joint = &s->joints[i];
    joint->parent = i;
    joint->origin.rotation[3] = 1;
    for (int k = 0; k < 3; k++) joint->origin.position[k] = (float)origins[i][k];
    joint->axis[axes[i]] = 1;
    joint->low = i == 2 ? -3.1 : -6.28;
    joint->high = -joint->low;
    joint->speed = 3.14;
    joint->acceleration = 10;
    if (i + 1 == ARM_JOINTS) break;
    shapes_capsule(&mesh, links[i][0], links[i][1], 32);
    if (i == 0 || i == 3) {
      const double lie[4] = {-0.70710678118654757, 0, 0, 0.70710678118654757};
      shapes_place(&mesh, 0, lie, 0, 0, 0);
    }
    arm_add(s, &mesh, i + 1, links[i][2], links[i][3], links[i][4]);
  }
  // the base rests
  shapes_cylinder(&mesh, 0.075, 0.04, 32);
  arm_add(s, &mesh, 0, 0, 0, 0.02);
  s->scene.part_count--;
  {  // the tool before the base: parts 0 to 5 move
    const nsvcd_part base = s->parts[5];
    const oracle_mesh exact = s->meshes[5];
    // along y: a palm, two fingers
    const double lie[4] = {-0.70710678118654757, 0, 0, 0.70710678118654757};
    size_t first = mesh.vertices;
    shapes_capsule(&mesh, 0.038, 0.03, 256);
    shapes_place(&mesh, first, lie, 0, 0.06, 0);
    for (int side = -1; side <= 1; side += 2) {
      first = mesh.vertices;
      shapes_capsule(&mesh, 0.009, 0.06, 256);
      shapes_place(&mesh, first, lie, 0.03 * side, ARM_REACH - 0.045, 0);
    }
    arm_add(s, &mesh, ARM_JOINTS, 0, 0, 0);
    s->parts[6] = base;
    s->meshes[6] = exact;
    s->scene.part_count = ARM_PARTS;
  }
}

static void arm_shelf(arm_scene *s, double depth, double height, double x) {
  const double width = 0.9;
  for (int k = 0; k < 4; k++) arm_box(s, x + depth / 2, 0, 0.05 + k * height, depth, width, 0.02);
  for (int side = -1; side <= 1; side++)
    arm_box(s, x + depth / 2, side * width / 2, 0.05 + 1.5 * height, depth, 0.02, 3 * height);
  arm_box(s, x + depth, 0, 0.05 + 1.5 * height, 0.02, width, 3 * height);
}

static void arm_furnish(arm_scene *s, arm_kind kind) {
  if (kind != ARM_CAGE) arm_box(s, 0, 0, -0.02, 3, 3, 0.03);
  if (kind == ARM_SHELF_SMALL) arm_shelf(s, 0.25, 0.28, 0.5);
  if (kind == ARM_SHELF_TALL) arm_shelf(s, 0.3, 0.38, 0.5);
  if (kind == ARM_SHELF_THIN) arm_shelf(s, 0.4, 0.22, 0.45);
  if (kind == ARM_BOX) {
    arm_box(s, 0.5, 0.1, 0.02, 0.4, 0.3, 0.01);
    for (int side = -1; side <= 1; side += 2) {
      arm_box(s, 0.5 + side * 0.2, 0.1, 0.14, 0.01, 0.3, 0.24);
      arm_box(s, 0.5, 0.1 + side * 0.15, 0.14, 0.4, 0.01, 0.24);
    }
  }
  if (kind == ARM_ON_TABLE || kind == ARM_UNDER_TABLE) {
    shapes_rng rng = {5};
    const double top = kind == ARM_ON_TABLE ? 0 : 0.42;
    if (top > 0) arm_box(s, 0.6, 0, top - 0.015, 0.6, 1, 0.03);
    for (int leg = 0; leg < 4 && top > 0; leg++)
      arm_box(s, leg / 2 ? 0.87 : 0.33, leg % 2 ? 0.47 : -0.47, top / 2 - 0.02, 0.04, 0.04,
              top - 0.04);
    for (int n = 0; n < 16; n++) {
      shapes_mesh mesh;
      memset(&mesh, 0, sizeof mesh);
      const double high = shapes_uniform(&rng, 0.06, 0.25);
      const double wide = shapes_uniform(&rng, 0.03, 0.08);
      if (n % 2)
        shapes_cylinder(&mesh, wide / 2, high, 24);
      else
        shapes_box(&mesh, wide, wide, high, 1);
      arm_add(s, &mesh, 0, shapes_uniform(&rng, 0.35, 0.85), shapes_uniform(&rng, -0.45, 0.45),
              top + high / 2 + 0.001);
    }
  }
  if (kind == ARM_CAGE) {
    const double half = 0.5;
    const double high = 1;
    for (int n = 0; n < 40; n++) {
      const double along = -half + (n % 10) * 0.1 + 0.05;
      const int side = n / 10;
      if (side == 0 && fabs(along) < 0.15) continue;  // the door, 0.3 m to the bars' middles
      const double at[4][2] = {{half, along}, {-half, along}, {along, half}, {along, -half}};
      arm_box(s, at[side][0], at[side][1], high / 2, 0.02, 0.02, high);
    }
    for (int n = 0; n < 10; n++) arm_box(s, -half + n * 0.1 + 0.05, 0, high, 0.02, 2 * half, 0.02);
    arm_box(s, 0, 0, -0.02, 2 * half, 2 * half, 0.03);
    arm_box(s, half, 0, 0.72, 0.02, 0.3, 0.02);  // over the door
  }
}

// All pairs that can meet: the arm's parts with what rests, but the shoulder with what it stands on,
// and among themselves those that are two joints apart and more.
static void arm_open(arm_scene *s) {
  for (uint32_t a = 0; a < 6; a++) {
    for (uint32_t b = a + 1; b < s->scene.part_count; b++) {
      if (b < 6 && b < a + 2) continue;
      if (a == 3 && b == 5) continue;  // the wrist: they would touch
      if (b == 6 && a < 1) continue;
      s->pairs[s->scene.pair_count].a = a;
      s->pairs[s->scene.pair_count++].b = b;
    }
  }
  const size_t size = nsvcd_checker_size(&s->scene);
  s->memory = calloc(1, size);
  if (!size || !s->memory || nsvcd_checker_open(&s->scene, s->memory, size, &s->checker)) exit(1);
}

static void arm_close(arm_scene *s) {
  for (size_t n = 0; n < s->scene.part_count; n++) {
    nsvcd_body_free(s->parts[n].body, NULL);
    oracle_mesh_free(&s->meshes[n]);
  }
  free(s->memory);
}

// How near any pair comes at joints q, up to `limit`; less than 0 where one is inside of the other.
static double arm_apart(const arm_scene *s, const double *q, double limit) {
  oracle_pose poses[ARM_MOST_PARTS];
  double centres[ARM_MOST_PARTS][3];
  for (size_t n = 0; n < s->scene.part_count; n++) {
    const placed at = placed_part(&s->scene, n, q);
    poses[n] = oracle_of(&at);
    oracle_transform(&poses[n], s->meshes[n].center, centres[n]);
  }
  double least = limit;
  for (size_t p = 0; p < s->scene.pair_count; p++) {
    const size_t a = s->pairs[p].a;
    const size_t b = s->pairs[p].b;
    double off[3];
    oracle_search search;
    oracle_sub(centres[a], centres[b], off);
    if (oracle_length(off) > s->meshes[a].radius + s->meshes[b].radius + least) continue;
    oracle_search_begin(&search, &s->meshes[a], &s->meshes[b]);
    least = fmin(least, oracle_search_run(&search, &poses[a], &poses[b], least));
    if (oracle_inside(&s->meshes[a], &poses[a], &s->meshes[b], &poses[b]) > 0.5 ||
        oracle_inside(&s->meshes[b], &poses[b], &s->meshes[a], &poses[a]) > 0.5)
      return -1;
  }
  return least;
}

// What the tool is to do: be at a place, along a direction. (6): three of each, scaled.
static void arm_tool_at(const arm_scene *s, const double *q, double *out) {
  const double tip[3] = {0, ARM_REACH, 0};
  const double along[3] = {0, 0.3, 0};
  const placed at = placed_part(&s->scene, 5, q);
  placed_point(&at, 1, tip, out);
  oracle_rotate(at.m, along, out + 3);
}

// Joints at which the tool is there, from random ones, by damped least squares. Returns 0 if not.
static int arm_reach(const arm_scene *s, shapes_rng *rng, const double *place, const double *along,
                     double *q) {
  double want[6];
  for (int k = 0; k < 3; k++) {
    want[k] = place[k];
    want[3 + k] = 0.3 * along[k];
  }
  for (int j = 0; j < 6; j++) q[j] = shapes_uniform(rng, -3.1, 3.1);
  for (int turn = 0; turn < 40; turn++) {
    double is[6], a[6][7], by[6][6], error = 0;
    arm_tool_at(s, q, is);
    for (int j = 0; j < 6; j++) {
      double moved[6];
      const double was = q[j];
      q[j] += 1e-6;
      arm_tool_at(s, q, moved);
      q[j] = was;
      for (int k = 0; k < 6; k++) by[k][j] = (moved[k] - is[k]) / 1e-6;
    }
    for (int k = 0; k < 6; k++) error += (want[k] - is[k]) * (want[k] - is[k]);
    if (error < 1e-6) return 1;
    for (int i = 0; i < 6; i++) {
      a[i][6] = 0;
      for (int k = 0; k < 6; k++) a[i][6] += by[k][i] * (want[k] - is[k]);
      for (int j = 0; j < 6; j++) {
        a[i][j] = i == j ? 1e-3 : 0;
        for (int k = 0; k < 6; k++) a[i][j] += by[k][i] * by[k][j];
      }
    }
    for (int i = 0; i < 6; i++) {
      for (int r = i + 1; r < 6; r++) {
        const double f = a[r][i] / a[i][i];
        for (int c = i; c < 7; c++) a[r][c] -= f * a[i][c];
      }
    }
    for (int i = 5; i >= 0; i--) {
      for (int c = i + 1; c < 6; c++) a[i][6] -= a[i][c] * a[c][6];
      a[i][6] /= a[i][i];
      q[i] += fmax(-0.5, fmin(0.5, a[i][6]));
      if (fabs(q[i]) > 3.1) return 0;
    }
  }
  return 0;
}

// A place that is drawn for a kind, and how the tool points there. second: the goal's.
static void arm_target(shapes_rng *rng, arm_kind kind, int second, double *place, double *along) {
  const double heights[3] = {0.28, 0.38, 0.22};
  double lean[3];
  memset(along, 0, 3 * sizeof *along);
  along[2] = -1;
  place[0] = shapes_uniform(rng, 0.35, 0.85);
  place[1] = shapes_uniform(rng, -0.45, 0.45);
  place[2] = shapes_uniform(rng, 0.03, 0.2);
  if (kind <= ARM_SHELF_THIN) {
    const int board = second ? 1 + shapes_pick(rng, 2) : shapes_pick(rng, 2);
    place[0] = shapes_uniform(rng, 0.5, kind == ARM_SHELF_THIN ? 0.75 : 0.65);
    place[2] = 0.05 + heights[kind] * (board + shapes_uniform(rng, 0.15, 0.85));
    along[0] = 1;
    along[2] = 0;
  }
  if (kind == ARM_BOX && second) {
    place[0] = shapes_uniform(rng, 0.33, 0.67);
    place[1] = shapes_uniform(rng, -0.02, 0.22);
    place[2] = shapes_uniform(rng, 0.04, 0.15);
  }
  if (kind == ARM_UNDER_TABLE) {
    place[2] = second ? shapes_uniform(rng, 0.06, 0.36) : shapes_uniform(rng, 0.45, 0.7);
    if (second) {
      along[0] = 1;
      along[2] = 0;
    }
  }
  if (kind == ARM_CAGE) {
    const double far = shapes_uniform(rng, 0.55, 0.75);
    const double angle = shapes_uniform(rng, 0.8, 5.4);
    place[0] = second ? far : 0.35 * cos(angle);
    place[1] = second ? shapes_uniform(rng, -0.25, 0.25) : 0.35 * sin(angle);
    place[2] = shapes_uniform(rng, 0.15, 0.6);
    along[0] = second ? 1 : cos(angle);
    along[1] = second ? 0 : sin(angle);
    along[2] = 0;
  }
  shapes_direction(rng, lean);
  for (int k = 0; k < 3; k++) along[k] += 0.3 * lean[k];
  const double length = oracle_length(along);
  for (int k = 0; k < 3; k++) along[k] /= length;
}

// A start or a goal, with `room` metres at least about it.
static int arm_configuration(const arm_scene *s, shapes_rng *rng, arm_kind kind, int second,
                             double room, double *q) {
  for (int trial = 0; trial < 3000; trial++) {
    double place[3], along[3];
    nsvcd_check_options options;
    nsvcd_check_answer answer;
    const nsvcd_joint_motion still = {0, 0, q, NULL};
    memset(&options, 0, sizeof options);
    options.clearance = (float)room;
    arm_target(rng, kind, second, place, along);
    if (!arm_reach(s, rng, place, along, q)) continue;
    if (nsvcd_check(s->checker, &still, &options, &answer)) exit(1);
    if (answer.verdict == NSVCD_FREE) return 1;
  }
  return 0;
}

#endif
