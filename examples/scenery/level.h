// level.h - a level of a game made by a few lines of code: hilly ground, and on it walls with
// doors, pillars, boulders, crates, arches and basins, each a closed part. For the demo, the tests
// and the benchmark of large bodies. Deterministic: the same arguments give the same mesh.
#ifndef NSVCD_SCENERY_LEVEL_H
#define NSVCD_SCENERY_LEVEL_H

#include "shapes.h"

// Metres: where the ground is.
SHAPES_DEF double level_height(double x, double y) {
  return 0.25 * sin(0.55 * x + 0.4) * cos(0.47 * y) + 0.08 * sin(2.1 * x) * sin(1.7 * y + 1) +
         0.02 * sin(7.3 * x + 2 * sin(3.1 * y));
}

// A slab of side x side metres about the origin, cut into cells x cells on top and below.
SHAPES_DEF void level_ground(shapes_mesh *mesh, double side, uint32_t cells) {
  const uint32_t row = cells + 1;
  const uint32_t top = (uint32_t)mesh->vertices;
  const uint32_t bottom = top + row * row;
  for (int layer = 0; layer < 2; layer++) {
    for (uint32_t j = 0; j < row; j++) {
      for (uint32_t i = 0; i < row; i++) {
        const double x = side * ((double)i / cells - 0.5);
        const double y = side * ((double)j / cells - 0.5);
        shapes_vertex(mesh, x, y, layer == 0 ? level_height(x, y) : -1);
      }
    }
  }
  for (uint32_t j = 0; j < cells; j++) {
    for (uint32_t i = 0; i < cells; i++) {
      const uint32_t a = j * row + i;
      shapes_quad(mesh, top + a, top + a + 1, top + a + row + 1, top + a + row);
      shapes_quad(mesh, bottom + a, bottom + a + row, bottom + a + row + 1, bottom + a + 1);
    }
  }
  for (uint32_t i = 0; i < cells; i++) {  // the four sides
    const uint32_t edges[4][2] = {{i, i + 1},
                                  {i * row + cells, (i + 1) * row + cells},
                                  {cells * row + i + 1, cells * row + i},
                                  {(i + 1) * row, i * row}};
    for (size_t k = 0; k < 4; k++) {
      shapes_quad(mesh, bottom + edges[k][0], bottom + edges[k][1], top + edges[k][1],
                  top + edges[k][0]);
    }
  }
}

// A boulder: a sphere with bumps. rings x 2 rings cells.
SHAPES_DEF void level_boulder(shapes_mesh *mesh, double radius, int rings, double phase) {
  const size_t first = mesh->vertices;
  double profile[513][2];
  if (rings > 512) rings = 512;
  for (int i = 0; i <= rings; i++) {
    const double angle = SHAPES_PI * i / rings;
    profile[i][0] = i == 0 || i == rings ? 0 : radius * sin(angle);
    profile[i][1] = -radius * cos(angle);
  }
  shapes_lathe(mesh, (const double(*)[2])profile, rings + 1, 2 * rings, 0);
  for (size_t v = first; v < mesh->vertices; v++) {
    double *p = mesh->positions + 3 * v;
    const double bump = 0.12 * sin(4 * p[0] / radius + phase) * sin(3 * p[1] / radius) *
                        cos(4 * p[2] / radius + phase);
    for (size_t k = 0; k < 3; k++) p[k] *= 1 + bump;
  }
}

// A pillar with rings about it: cells x cells.
SHAPES_DEF void level_pillar(shapes_mesh *mesh, double radius, double height, int cells) {
  double profile[515][2];
  if (cells > 512) cells = 512;
  for (int i = 0; i <= cells; i++) {
    const double fraction = (double)i / cells;
    profile[i + 1][0] = radius * (1 + 0.1 * sin(12 * fraction));
    profile[i + 1][1] = height * fraction;
  }
  profile[0][0] = profile[cells + 2][0] = 0;
  profile[0][1] = 0;
  profile[cells + 2][1] = height;
  shapes_lathe(mesh, (const double(*)[2])profile, cells + 3, cells, 0);
}

// An arch: half a ring, its ends in the ground.
SHAPES_DEF void level_arch(shapes_mesh *mesh, double radius, double thickness, int cells) {
  double path[513][3];
  if (cells > 512) cells = 512;
  for (int i = 0; i <= cells; i++) {
    const double angle = SHAPES_PI * (1.2 * i / cells - 0.1);
    path[i][0] = radius * cos(angle);
    path[i][1] = 0;
    path[i][2] = radius * sin(angle);
  }
  shapes_tube(mesh, (const double(*)[3])path, cells + 1, thickness, cells / 2 > 3 ? cells / 2 : 3,
              0);
}

// Stairs up along x from the origin, a landing as long as four of them, and a ramp of two in five
// down to the ground again: all in one, its foot a metre below.
SHAPES_DEF void level_stairs(shapes_mesh *mesh, double width, double run, double rise, int steps) {
  const double upright[4] = {sqrt(0.5), 0, 0, sqrt(0.5)};
  const size_t first = mesh->vertices;
  const double top = rise * steps;
  const double landing = run * (steps + 4);
  double p[SHAPES_MAX_POLYGON][2] = {{0, -1}, {landing + 2.5 * (top + 0.5), -1}};
  int count = 2;
  if (steps > 60) steps = 60;
  p[count][0] = landing + 2.5 * (top + 0.5);
  p[count++][1] = -0.5;
  p[count][0] = landing;
  p[count++][1] = top;
  for (int k = steps; k-- > 0;) {
    p[count][0] = run * k;
    p[count++][1] = rise * (k + 1);
    if (k == 0) break;
    p[count][0] = run * k;
    p[count++][1] = rise * k;
  }
  shapes_extrude(mesh, (const double(*)[2])p, count, width);
  shapes_place(mesh, first, upright, 0, 0, 0);
}

// A thing of about this many triangles, standing on the ground at the origin.
SHAPES_DEF void level_thing(shapes_mesh *mesh, int kind, size_t triangles, shapes_rng *rng) {
  const double n = (double)triangles;
  const size_t first = mesh->vertices;
  const double size = shapes_uniform(rng, 0.5, 1);
  switch (kind) {
    case 0:  // a crate
      shapes_box(mesh, 0.8 * size, 0.8 * size, 0.8 * size, (int)fmax(1, sqrt(n / 12)));
      shapes_place(mesh, first, NULL, 0, 0, 0.35 * size);
      break;
    case 1:
      level_pillar(mesh, 0.3 * size, 2.5, (int)fmax(4, sqrt(n / 2)));
      break;
    case 2:
      level_boulder(mesh, 0.8 * size, (int)fmax(3, sqrt(n / 4)), shapes_uniform(rng, 0, 6));
      break;
    case 3:
      level_arch(mesh, size, 0.15, (int)fmax(4, sqrt(n)));
      break;
    case 4:  // a wall with a door: two posts and a lintel
      for (int part = 0; part < 3; part++) {
        const size_t own = mesh->vertices;
        shapes_box(mesh, part == 2 ? 1 : 0.6, 0.15, part == 2 ? 0.4 : 2,
                   (int)fmax(1, sqrt(n / 36)));
        shapes_place(mesh, own, NULL,
                     part == 2   ? 0
                     : part == 0 ? -0.75
                                 : 0.75,
                     0, part == 2 ? 1.75 : 0.95);
      }
      break;
    default:  // a basin
      shapes_cup(mesh, 0.6 * size, 0.5, 0.06, 1.3, (int)fmax(6, n / 10));
      break;
  }
}

// Things of about so many triangles in all, a thing or so for each 4 square metres.
SHAPES_DEF void level_things(shapes_mesh *mesh, double side, size_t triangles, uint64_t seed) {
  shapes_rng rng = {seed};
  const int pitches = (int)fmax(1, side / 2);
  const size_t each = triangles / (size_t)(pitches * pitches);
  for (int j = 0; j < pitches; j++) {
    for (int i = 0; i < pitches; i++) {
      const size_t first = mesh->vertices;
      const double x = side * ((i + 0.5) / pitches - 0.5) + shapes_uniform(&rng, -0.4, 0.4);
      const double y = side * ((j + 0.5) / pitches - 0.5) + shapes_uniform(&rng, -0.4, 0.4);
      const double turn = shapes_uniform(&rng, 0, SHAPES_PI);
      const double q[4] = {0, 0, sin(0.5 * turn), cos(0.5 * turn)};
      level_thing(mesh, shapes_pick(&rng, 6), each, &rng);
      shapes_place(mesh, first, q, x, y, level_height(x, y) - 0.05);
    }
  }
}

// A level of side x side metres and about so many triangles, half of them ground, half things. With
// other numbers of triangles the same things stand in the same places.
SHAPES_DEF void level_make(shapes_mesh *mesh, double side, size_t triangles, uint64_t seed) {
  level_ground(mesh, side, (uint32_t)fmax(1, sqrt((double)triangles / 8)));
  level_things(mesh, side, triangles / 2, seed);
}

// The level of examples/game: ground of 16 x 16 metres, things on it, and, where all happens, stairs
// and a pit. parts: (4) triangles before each of these three, and all.
SHAPES_DEF void level_with_pit(shapes_mesh *mesh, size_t *parts) {
  shapes_rng rng = {5};
  level_ground(mesh, 16, 100);
  parts[0] = 0;
  parts[1] = mesh->triangles;
  for (int n = 0; n < 64; n++) {
    const size_t first = mesh->vertices;
    const double turn = shapes_uniform(&rng, 0, SHAPES_PI);
    const double q[4] = {0, 0, sin(0.5 * turn), cos(0.5 * turn)};
    const double x = 2 * (n % 8) - 7;
    const double y = 2 * (n / 8) - 7;
    if (fabs(x) < 6 && y > -4 && y < 4) continue;
    level_thing(mesh, shapes_pick(&rng, 6), 2500, &rng);
    shapes_place(mesh, first, q, x, y, level_height(x, y) - 0.05);
  }
  parts[2] = mesh->triangles;
  const size_t stairs = mesh->vertices;
  level_stairs(mesh, 1.4, 0.28, 0.17, 7);
  shapes_place(mesh, stairs, NULL, -3, -2, level_height(-3, -2));
  for (int k = 0; k < 4; k++) {  // a pit
    const size_t wall = mesh->vertices;
    shapes_box(mesh, k < 2 ? 2.4 : 0.15, k < 2 ? 0.15 : 2.55, 1, 8);
    shapes_place(mesh, wall, NULL, k < 2 ? 0 : 2.4 * k - 6, k < 2 ? 2.4 * k - 0.1 : 1.1, 0.1);
  }
  parts[3] = mesh->triangles;
}

// Twelve things that fall into it, most of them concave; n: how fine round ones are.
#define LEVEL_PROPS 12
SHAPES_DEF void level_props(shapes_mesh *s, int n) {
  shapes_mug(&s[0], 0.06, 0.13, 0.008, n);
  shapes_bowl(&s[1], 0.16, 0.09, 0.012, n);
  shapes_torus(&s[2], 0.12, 0.04, n, n / 2);
  shapes_box(&s[3], 0.24, 0.18, 0.2, 1);
  shapes_chair(&s[4], 0.24, 0.5, 0.03);
  shapes_bottle(&s[5], 0.06, 0.28, n);
  shapes_gear(&s[6], 0.14, 0.03, 0.06, 20);
  shapes_drawer(&s[7], 0.3, 0.2, 0.12, 0.015);
  shapes_knot(&s[8], 0.09, 0.03, 2 * n, n / 4);
  level_boulder(&s[9], 0.14, n / 2, 1);
  shapes_l_bracket(&s[10], 0.24, 0.3, 0.06, 0.12);
  shapes_slot(&s[11], 0.26, 0.2, 0.14, 0.1, 0.1);
}

#endif
