// level_scene.h - a level, bodies of 0.3 m, and motions of some frames near its surface: what the
// test and the benchmark of large bodies share. The oracle sees the same meshes.
#ifndef LEVEL_SCENE_H
#define LEVEL_SCENE_H

#include <stdio.h>
#include <stdlib.h>

#include "../examples/scenery/level.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "mesh_of.h"

// metres by which the local piece is larger than what the motion can reach
#define LEVEL_REACH 0.05
#define LEVEL_BODIES 6

enum { LEVEL_NEAR, LEVEL_SLIDE, LEVEL_DASH, LEVEL_SETS };

static void level_fail(const char *what) {
  fprintf(stderr, "level: %s\n", what);
  exit(2);
}

// ---- meshes

typedef struct level_solid {
  nsvcd_mesh mesh;
  oracle_mesh oracle;
  const nsvcd_body *body;
  double radius;  // from the origin
} level_solid;

// Takes the shape.
static void level_solid_init(level_solid *s, shapes_mesh *shape, double extent) {
  if (extent > 0) shapes_fit(shape, extent);
  memset(s, 0, sizeof *s);
  s->mesh = mesh_of(shape);
  for (size_t v = 0; v < shape->vertices; v++)
    s->radius = fmax(s->radius, oracle_length(shape->positions + 3 * v));
  if (!oracle_mesh_init(&s->oracle, shape->positions, shape->vertices, shape->indices,
                        shape->triangles, 1)) {
    level_fail("no memory");
  }
  shapes_free(shape);
}

static const nsvcd_encode_options level_both = {.latents = 1};

static void level_make_bodies(level_solid *bodies) {
  for (int k = 0; k < LEVEL_BODIES; k++) {
    shapes_mesh shape;
    memset(&shape, 0, sizeof shape);
    if (k == 0) shapes_mug(&shape, 0.1, 0.2, 0.01, 48);
    if (k == 1) shapes_box(&shape, 0.3, 0.2, 0.1, 6);
    if (k == 2) level_boulder(&shape, 0.15, 16, 1);
    if (k == 3) shapes_drawer(&shape, 0.3, 0.2, 0.1, 0.01);
    if (k == 4) level_arch(&shape, 0.12, 0.03, 24);
    if (k == 5) shapes_plate(&shape, 0.15, 0.03, 0.01, 48);
    level_solid_init(&bodies[k], &shape, 0.3);
    if (nsvcd_encode(&bodies[k].mesh, &level_both, NULL, NULL, 0, &bodies[k].body))
      level_fail("a body was refused");
  }
}

// ---- motions

// The least distance of a motion from the level, stopping early.
static double level_gap(const level_solid *body, const level_solid *level,
                        const oracle_pose *poses) {
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  oracle_options options = {1e-5, 0.1, 0, 1};
  return oracle_sweep(&body->oracle, poses, 2, &level->oracle, &origin, &options).distance;
}

// Two poses about a place above the level's surface. Returns 0 if the draw is of no use.
static int level_motion(shapes_rng *rng, int set, const level_solid *body, const level_solid *level,
                        oracle_pose *poses) {
  const oracle_triangle *t =
      &level->oracle.triangles[shapes_next(rng) % level->oracle.triangle_count];
  const double way = set == LEVEL_NEAR ? 0.1 : set == LEVEL_SLIDE ? 0.05 : 1;
  const double turn = shapes_uniform(rng, 0, set == LEVEL_SLIDE ? 0 : set == LEVEL_NEAR ? 0.15 : 1);
  double axis[3];
  double direction[3];
  double spin[4];
  double u = shapes_uniform(rng, 0, 1);
  double v = shapes_uniform(rng, 0, 1);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  shapes_quaternion(rng, poses[0].rotation);
  shapes_direction(rng, axis);
  shapes_direction(rng, direction);
  oracle_axis_angle(axis, turn, spin);
  oracle_quat_mul(spin, poses[0].rotation, poses[1].rotation);
  const double length = shapes_uniform(rng, 0, way);
  double up[3] = {0, 0, 1};
  if (set == LEVEL_SLIDE) direction[2] = 0;
  const double out = body->radius + shapes_uniform(rng, -0.1, 0.1);
  for (int k = 0; k < 3; k++) {
    const double place = t->v[0][k] + u * (t->v[1][k] - t->v[0][k]) + v * (t->v[2][k] - t->v[0][k]);
    poses[0].position[k] = place + out * t->normal[k];
    poses[1].position[k] = poses[0].position[k] + length * direction[k];
  }
  // below the ground, or by a triangle without a normal
  if (!(poses[0].position[2] > -0.5)) return 0;
  if (set != LEVEL_SLIDE) return 1;
  // Let down until it slides at the gap that is wanted, by the oracle.
  const double wanted = 1e-4 * pow(10, shapes_uniform(rng, 0.3, 2));
  for (int step = 0; step < 60; step++) {
    const double gap = level_gap(body, level, poses);
    if (gap <= 0) return 0;
    if (fabs(gap - wanted) < 0.1 * wanted) return 1;
    for (int n = 0; n < 2; n++) {
      for (int k = 0; k < 3; k++) poses[n].position[k] += (wanted - gap) * up[k];
    }
  }
  return 0;
}

// The piece of the level that a motion can reach.
static const nsvcd_body *level_piece(const level_solid *level, const level_solid *body,
                                     const nsvcd_pose *poses) {
  float low[3], high[3];
  nsvcd_mesh part;
  const nsvcd_body *piece;
  nsvcd_encode_options open;
  memset(&open, 0, sizeof open);
  open.open = 1;
  for (int k = 0; k < 3; k++) {
    const float reach = (float)(body->radius + LEVEL_REACH);
    low[k] = fminf(poses[0].position[k], poses[1].position[k]) - reach;
    high[k] = fmaxf(poses[0].position[k], poses[1].position[k]) + reach;
  }
  const nsvcd_result cut = nsvcd_mesh_cut(&level->mesh, low, high, NULL, &part);
  if (cut == NSVCD_ERROR_EMPTY) return NULL;
  if (cut || nsvcd_encode(&part, &open, NULL, NULL, 0, &piece)) level_fail("a piece was refused");
  nsvcd_mesh_free(&part, NULL);
  return piece;
}

static void level_free(level_solid *s) {
  oracle_mesh_free(&s->oracle);
  nsvcd_body_free(s->body, NULL);
  free(s->mesh.positions);
  free(s->mesh.indices);
}

// Two poses as the library is given them, and the same for the oracle.
typedef struct level_way {
  nsvcd_pose stored[2];
  oracle_pose poses[2];
  const level_solid *body;
} level_way;

// A motion of a set; the draw is repeated until one is of use.
static level_way level_draw(shapes_rng *rng, int set, const level_solid *bodies,
                            const level_solid *level) {
  level_way way;
  do {
    way.body = &bodies[shapes_pick(rng, LEVEL_BODIES)];
  } while (!level_motion(rng, set, way.body, level, way.poses));
  for (int n = 0; n < 2; n++) {
    way.stored[n] = pose_rounded(&way.poses[n]);
    way.poses[n] = pose_widened(&way.stored[n]);
  }
  return way;
}

static oracle_result level_label(const level_way *way, const level_solid *level) {
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  const oracle_options options = {2e-5, 1e-3, 0, 0};
  return oracle_sweep(&way->body->oracle, way->poses, 2, &level->oracle, &origin, &options);
}

#endif
