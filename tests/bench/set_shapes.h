// set_shapes.h - meshes that only the sets of problems.c ask for: floors to put things down on,
// bodies of several parts, needles, triangle soup, single triangles. Made of the parts of
// scenery/shapes.h.
//
// A draw has a statement of its own: C leaves the order of a call's arguments open.
#ifndef NSVCD_BENCH_SET_SHAPES_H
#define NSVCD_BENCH_SET_SHAPES_H

#include "../../examples/scenery/shapes.h"

#define SET_EXTENT 0.3  // metres, as of the other procedural meshes

// ------------------------------------------------------------------------------------ rest: bodies

// A part with flat faces that a saw or a press makes: the same outline all along z.
SHAPES_DEF void set_extruded(shapes_mesh *mesh, shapes_rng *rng) {
  const double thick = shapes_uniform(rng, 0.1, 0.3);
  const double height = shapes_uniform(rng, 0.1, 0.8);
  switch (shapes_pick(rng, 4)) {
    case 0:
      shapes_l_bracket(mesh, 1, 0.7, thick, height);
      break;
    case 1:
      shapes_slot(mesh, 1, 0.8, height, 0.4, thick);
      break;
    case 2:
      shapes_gear(mesh, 0.5, 0.08, height, 12);
      break;
    default:
      shapes_slab(mesh, rng, 0.5, height);
      break;
  }
}
// A plate: a flat disc, or one with a foot and a rim.
SHAPES_DEF void set_plate(shapes_mesh *mesh, shapes_rng *rng, int rim) {
  const double height = shapes_uniform(rng, 0.01, 0.02);
  const double wall = shapes_uniform(rng, 0.004, 0.008);
  if (rim)
    shapes_plate(mesh, 0.15, 2 * height, wall, 28);
  else
    shapes_cylinder(mesh, 0.15, height, 28);
}
#define SET_RESTING 8
// What stands about on tables; each has flat faces. kind in [0, SET_RESTING).
SHAPES_DEF void set_resting(shapes_mesh *mesh, shapes_rng *rng, int kind) {
  const double u = shapes_uniform(rng, 0.3, 1);
  const double v = shapes_uniform(rng, 0.1, 1);
  const int segments = 16 + 2 * shapes_pick(rng, 6);
  switch (kind) {
    case 0:
      shapes_box(mesh, 1, u, v, 1 + shapes_pick(rng, 3));
      break;
    case 1:
      shapes_cylinder(mesh, u / 2, v, segments);
      break;
    case 2:
      shapes_prism(mesh, u / 2, v, 3 + shapes_pick(rng, 6));
      break;
    case 3:
      shapes_cone(mesh, u / 2, v * u / 2, 1, segments);
      break;
    case 4:
      set_extruded(mesh, rng);
      break;
    case 5:
      shapes_cup(mesh, 0.4 * u, 0.8, 0.05 * u, 0.9 + 0.4 * v, segments);
      break;
    case 6:
      shapes_bottle(mesh, 0.3 * u, 1, segments);
      break;
    default:
      shapes_random_solid(mesh, rng, SET_EXTENT);
      break;
  }
  shapes_fit(mesh, SET_EXTENT);
}

// ------------------------------------------------------------------------------------ rest: floors

// What a maker of floors says of its mesh, z up, in the mesh's units.
typedef struct set_floor {
  double height;     // z of the flat surface
  double thickness;  // of the material below it
  double half[2];    // the flat part reaches so far from the z axis, along x and y
  int walled;        // something stands up around it
  int plate;
} set_floor;

// A top on four legs that end within it. The legs stand in a little: no faces share a plane.
SHAPES_DEF void set_table(shapes_mesh *mesh, double x, double y, double top, double leg) {
  const double length = 0.25;
  shapes_box_at(mesh, 0, 0, -top / 2, x, y, top);
  for (int i = 0; i < 4; i++) {
    const double at_x = (i % 2 ? 0.5 : -0.5) * (x - 1.5 * leg);
    const double at_y = (i / 2 ? 0.5 : -0.5) * (y - 1.5 * leg);
    shapes_box_at(mesh, at_x, at_y, -top / 2 - length / 2, leg, leg, length);
  }
}
#define SET_FLOORS 5
// kind in [0, SET_FLOORS): a tile, a table, a crate, a flat plate, a plate with a rim.
SHAPES_DEF set_floor set_make_floor(shapes_mesh *mesh, shapes_rng *rng, int kind) {
  const double x = shapes_uniform(rng, 0.25, 0.35);
  const double y = shapes_uniform(rng, 0.25, 0.35);
  const double thick = shapes_uniform(rng, 0.015, 0.03);
  set_floor floor = {0, thick, {x / 2, y / 2}, 0, 0};
  if (kind == 0) {
    shapes_box_at(mesh, 0, 0, -thick / 2, x, y, thick);
  } else if (kind == 1) {
    set_table(mesh, x, y, thick, 0.03);
  } else if (kind == 2) {
    const double wall = shapes_uniform(rng, 0.006, 0.02);
    shapes_drawer(mesh, x, y, shapes_uniform(rng, 0.05, 0.15), wall);
    const set_floor crate = {wall, wall, {x / 2 - wall, y / 2 - wall}, 1, 0};
    floor = crate;
  } else {
    set_plate(mesh, rng, kind == 4);
    // The floor is the highest point near the axis: of a plate with a rim, the last two rings of
    // the profile.
    const double height = mesh->positions[3 * (mesh->vertices - 1) + 2];
    const double below = mesh->positions[2];
    const double half = kind == 4 ? 0.4 * 0.15 : 0.7 * 0.15;
    const set_floor plate = {height, height - below, {half, half}, kind == 4, 1};
    floor = plate;
  }
  return floor;
}

// ------------------------------------------------------------------------------------------ nested

// Two or three closed parts, far from each other: where one is inside a body of their distance, the
// others are not.
SHAPES_DEF void set_group(shapes_mesh *mesh, shapes_rng *rng) {
  const int parts = 2 + shapes_pick(rng, 2);
  for (int i = 0; i < parts; i++) {
    const size_t first = mesh->vertices;
    const double size = shapes_uniform(rng, 0.05, 0.13);
    const double angle = 2 * SHAPES_PI * (i + shapes_uniform(rng, -0.1, 0.1)) / parts;
    const double z = shapes_uniform(rng, -0.2, 0.2);
    double turn[4];
    shapes_random_part(mesh, rng, size, shapes_pick(rng, 2));
    shapes_quaternion(rng, turn);
    shapes_place(mesh, first, turn, cos(angle), sin(angle), z);
  }
  shapes_fit(mesh, SET_EXTENT);
}
// A solid with much room inside.
SHAPES_DEF void set_bulky(shapes_mesh *mesh, shapes_rng *rng) {
  const double u = shapes_uniform(rng, 0.6, 1);
  const double v = shapes_uniform(rng, 0.6, 1);
  switch (shapes_pick(rng, 4)) {
    case 0:
      shapes_box(mesh, 1, u, v, 1 + shapes_pick(rng, 2));
      break;
    case 1:
      shapes_cylinder(mesh, 0.5 * u, v, 24);
      break;
    case 2:
      shapes_ellipsoid(mesh, 0.5, 0.5 * u, 0.5 * v, 24);
      break;
    default:
      shapes_random_solid(mesh, rng, 1);
      break;
  }
}
// What a part may be inside of: a bulky solid, or a closed shell with a thick wall about a cavity.
SHAPES_DEF void set_host(shapes_mesh *mesh, shapes_rng *rng, int shell) {
  if (shell) {
    const double wall = shapes_uniform(rng, 0.08, 0.2);
    const double y = shapes_uniform(rng, 0.7, 1);
    const double z = shapes_uniform(rng, 0.7, 1);
    shapes_shell(mesh, 1, y, z, wall, shapes_pick(rng, 2), 24);
  } else {
    set_bulky(mesh, rng);
  }
  shapes_fit(mesh, SET_EXTENT);
}

// ----------------------------------------------------------------------------------------- slivers

#define SET_MAX_OUTLINE 256

typedef struct set_outline {
  double corner[SET_MAX_OUTLINE][2];  // counter-clockwise about the origin
  int count;
} set_outline;

// A rectangle, its edges cut. Every other piece is `hair` long, in halves of an edge.
SHAPES_DEF set_outline set_rectangle(double x, double y, int pairs, double hair) {
  set_outline out;
  out.count = 8 * pairs;
  for (int i = 0; i < out.count; i++) {
    const int side = i / (2 * pairs);
    const int step = i / 2 % pairs;
    // From one corner of the rectangle (-1) to the next (1), the first included.
    const double along = 2.0 * step / pairs - 1 + (i % 2 ? hair : 0);
    const double u = side == 0 ? along : side == 1 ? 1 : side == 2 ? -along : -1;
    const double v = side == 0 ? -1 : side == 1 ? along : side == 2 ? 1 : -along;
    out.corner[i][0] = u * x / 2;
    out.corner[i][1] = v * y / 2;
  }
  return out;
}
// A regular polygon, or every other edge `hair` times the radius long.
SHAPES_DEF set_outline set_circle(double radius, int count, double hair) {
  set_outline out;
  out.count = count;
  for (int i = 0; i < count; i++) {
    const int pair = i - i % 2;
    const double even = 2 * SHAPES_PI * i / count;
    const double angle = hair > 0 ? 2 * SHAPES_PI * pair / count + i % 2 * hair : even;
    out.corner[i][0] = radius * cos(angle);
    out.corner[i][1] = radius * sin(angle);
  }
  return out;
}
// The outline from z = 0 to 1, with a fan about the centre of each end; pointed: an apex for the
// upper end.
SHAPES_DEF void set_fan_solid(shapes_mesh *mesh, const set_outline *outline, int pointed) {
  const uint32_t bottom = shapes_vertex(mesh, 0, 0, 0);
  const uint32_t top = shapes_vertex(mesh, 0, 0, 1);
  const uint32_t ring = (uint32_t)mesh->vertices;
  const uint32_t stride = pointed ? 1 : 2;
  for (int i = 0; i < outline->count; i++) {
    const double *p = outline->corner[i];
    shapes_vertex(mesh, p[0], p[1], 0);
    if (!pointed) shapes_vertex(mesh, p[0], p[1], 1);
  }
  for (int i = 0; i < outline->count; i++) {
    const uint32_t a = ring + stride * (uint32_t)i;
    const uint32_t b = ring + stride * (uint32_t)((i + 1) % outline->count);
    shapes_triangle(mesh, bottom, b, a);
    if (pointed) {
      shapes_triangle(mesh, top, a, b);
    } else {
      shapes_triangle(mesh, top, a + 1, b + 1);
      shapes_quad(mesh, a, b, b + 1, a + 1);
    }
  }
}
// Cuts every triangle into three, by a point so near the middle of an edge that one of the three is
// a needle.
SHAPES_DEF void set_cut_needles(shapes_mesh *mesh, shapes_rng *rng, double near_edge) {
  const size_t count = mesh->triangles;
  for (size_t i = 0; i < count; i++) {
    uint32_t t[3];
    double place[3];
    const int first = shapes_pick(rng, 3);
    for (int k = 0; k < 3; k++) t[k] = mesh->indices[3 * i + (size_t)((first + k) % 3)];
    for (int k = 0; k < 3; k++) {
      const double a = mesh->positions[3 * t[0] + (size_t)k];
      const double b = mesh->positions[3 * t[1] + (size_t)k];
      const double c = mesh->positions[3 * t[2] + (size_t)k];
      place[k] = (1 - near_edge) * (a + b) / 2 + near_edge * c;
    }
    const uint32_t cut = shapes_vertex(mesh, place[0], place[1], place[2]);
    mesh->indices[3 * i] = t[0];
    mesh->indices[3 * i + 1] = t[1];
    mesh->indices[3 * i + 2] = cut;
    shapes_triangle(mesh, t[1], t[2], cut);
    shapes_triangle(mesh, t[2], t[0], cut);
  }
}
// A column, cone or block full of needles. Where each edge of the outline makes needles, it has to
// be slender to do with 200 of them. That costs: they lie across each other's boxes, and the oracle
// tries most pairs.
SHAPES_DEF void set_needle_solid(shapes_mesh *mesh, shapes_rng *rng, int kind) {
  const double radius = shapes_uniform(rng, 0.1, 0.4);
  const double slender = shapes_uniform(rng, 0.016, 0.032);
  const double x = shapes_uniform(rng, 0.3, 1);
  const double y = shapes_uniform(rng, 0.3, 1);
  const int pairs = 6 + shapes_pick(rng, 18);
  const int all = shapes_pick(rng, 4) == 0;
  const int edges = 5 + (int)(1000 * 2 * SHAPES_PI * slender);  // of 1/1000 each, at height 1
  set_outline outline;
  if (kind == 2)
    outline = set_rectangle(x, y, pairs, 1e-4);
  else if (all)
    outline = set_circle(slender, edges, 0);
  else
    outline = set_circle(radius, 4 * pairs, 1e-4);
  set_fan_solid(mesh, &outline, kind == 1);
}
#define SET_SLIVERS 4
// kind in [0, SET_SLIVERS): a column, a cone, a block, a random solid; needles of 1 to 1000 and
// worse.
SHAPES_DEF void set_slivers(shapes_mesh *mesh, shapes_rng *rng, int kind) {
  if (kind < 3) {
    set_needle_solid(mesh, rng, kind);
  } else {
    shapes_random_solid(mesh, rng, SET_EXTENT);
    set_cut_needles(mesh, rng, 5e-4);
  }
  shapes_fit(mesh, SET_EXTENT);
}

// -------------------------------------------------------------------------------------------- soup

// Some triangles once or twice more, the second time with another corner first.
SHAPES_DEF void set_duplicate(shapes_mesh *mesh, shapes_rng *rng, int count) {
  const int triangles = (int)mesh->triangles;
  for (int i = 0; i < count; i++) {
    const size_t at = (size_t)shapes_pick(rng, triangles);
    const int copies = 1 + shapes_pick(rng, 2);
    for (int k = 0; k < copies; k++) {
      const uint32_t *t = mesh->indices + 3 * at;
      const uint32_t corner[3] = {t[0], t[1], t[2]};
      shapes_triangle(mesh, corner[k % 3], corner[(k + 1) % 3], corner[(k + 2) % 3]);
    }
  }
}
// Triangles without area on edges of the mesh: they add nothing to its surface.
SHAPES_DEF void set_degenerate(shapes_mesh *mesh, shapes_rng *rng, int count) {
  const int triangles = (int)mesh->triangles;
  for (int i = 0; i < count; i++) {
    const size_t at = 3 * (size_t)shapes_pick(rng, triangles);
    const uint32_t a = mesh->indices[at];
    const uint32_t b = mesh->indices[at + 1];
    const double *p = mesh->positions + 3 * a;
    const double *q = mesh->positions + 3 * b;
    const double middle[3] = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
    if (i % 3 == 0) shapes_triangle(mesh, a, a, b);
    if (i % 3 == 1) shapes_triangle(mesh, a, a, a);
    if (i % 3 == 2)
      shapes_triangle(mesh, a, shapes_vertex(mesh, middle[0], middle[1], middle[2]), b);
  }
}
// Vertices that no triangle uses, some of them outside the bounds of those that are used.
SHAPES_DEF void set_unreferenced(shapes_mesh *mesh, shapes_rng *rng, int count) {
  for (int i = 0; i < count; i++) {
    const double x = shapes_uniform(rng, -0.7, 0.7) * SET_EXTENT;
    const double y = shapes_uniform(rng, -0.7, 0.7) * SET_EXTENT;
    const double z = shapes_uniform(rng, -0.7, 0.7) * SET_EXTENT;
    shapes_vertex(mesh, x, y, z);
  }
}
SHAPES_DEF void set_shuffle(shapes_mesh *mesh, shapes_rng *rng) {
  for (size_t i = mesh->triangles; i > 1; i--) {
    uint32_t *a = mesh->indices + 3 * (i - 1);
    uint32_t *b = mesh->indices + 3 * (shapes_next(rng) % i);
    for (int k = 0; k < 3; k++) {
      const uint32_t swap = a[k];
      a[k] = b[k];
      b[k] = swap;
    }
  }
}
// A standard solid as careless programs write them.
SHAPES_DEF void set_soup(shapes_mesh *mesh, shapes_rng *rng) {
  shapes_random_solid(mesh, rng, SET_EXTENT);
  const int some = 3 + (int)mesh->triangles / 10;
  set_duplicate(mesh, rng, some);
  set_degenerate(mesh, rng, some);
  set_unreferenced(mesh, rng, 1 + shapes_pick(rng, 20));
  set_shuffle(mesh, rng);
}

// --------------------------------------------------------------------------------------------- one

// One triangle; every fourth is a needle.
SHAPES_DEF void set_triangle(shapes_mesh *mesh, shapes_rng *rng, int needle) {
  const double x = shapes_uniform(rng, -0.2, 1.2);
  const double y = needle ? 1e-3 : shapes_uniform(rng, 0.1, 1);
  const uint32_t a = shapes_vertex(mesh, 0, 0, 0);
  const uint32_t b = shapes_vertex(mesh, 1, 0, 0);
  const uint32_t c = shapes_vertex(mesh, x, y, 0);
  double turn[4];
  shapes_quaternion(rng, turn);
  shapes_place(mesh, 0, turn, 0, 0, 0);
  shapes_triangle(mesh, a, b, c);
  shapes_fit(mesh, SET_EXTENT);
}

#endif
