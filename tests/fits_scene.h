// fits_scene.h - what moves in a close fit: shafts in bores, a nut on its bolt, gears, a piston, a
// hinge, a drawer. Each is free by construction, and `gap` says by how much: surfaces never come
// nearer than that, whatever the facets are. Metres. After neuralsvcd.h (or its rooms), shapes.h,
// oracle.h and poses.h.
#ifndef NSVCD_TESTS_FITS_SCENE_H
#define NSVCD_TESTS_FITS_SCENE_H

#define FITS_POSES 33
#define FITS_MM 1e-3

typedef struct fits_case {
  char name[48];
  shapes_mesh a, b;
  nsvcd_pose poses_a[FITS_POSES], poses_b[FITS_POSES];
  size_t count_a, count_b;
  double gap;
} fits_case;

// Poses that turn about z by an angle while they go from a place to another.
static void fits_move(nsvcd_pose *poses, size_t count, double from, double turn,
                      const double *start, const double *end) {
  for (size_t k = 0; k < count; k++) {
    const double s = count > 1 ? (double)k / (double)(count - 1) : 0;
    const double half = 0.5 * (from + s * turn);
    oracle_pose pose = {{0, 0, 0}, {0, 0, sin(half), cos(half)}};
    for (int i = 0; i < 3; i++) pose.position[i] = start[i] + s * (end[i] - start[i]);
    poses[k] = pose_rounded(&pose);
  }
}

static const double fits_origin[3] = {0, 0, 0};

// ---- round things

// A prism about z. Its corners are at the radius.
static void fits_shaft(shapes_mesh *m, double radius, double low, double high, int facets) {
  double(*ring)[2] = (double(*)[2])calloc((size_t)facets, sizeof *ring);
  const size_t first = m->vertices;
  for (int k = 0; k < facets; k++) {
    const double angle = 2 * SHAPES_PI * k / facets;
    ring[k][0] = radius * cos(angle);
    ring[k][1] = radius * sin(angle);
  }
  shapes_extrude(m, (const double(*)[2])ring, facets, high - low);
  shapes_place(m, first, NULL, 0, 0, 0.5 * (low + high));
  free(ring);
}

// A ring about z. Its wall is nowhere nearer to the axis than the radius: that is of the circle in
// it.
static void fits_bore(shapes_mesh *m, double radius, double outer, double low, double high,
                      int facets) {
  const double corner = radius / cos(SHAPES_PI / facets);
  const uint32_t first = (uint32_t)m->vertices;
  for (int k = 0; k < facets; k++) {
    const double x = cos(2 * SHAPES_PI * k / facets);
    const double y = sin(2 * SHAPES_PI * k / facets);
    shapes_vertex(m, corner * x, corner * y, low);
    shapes_vertex(m, corner * x, corner * y, high);
    shapes_vertex(m, outer * x, outer * y, low);
    shapes_vertex(m, outer * x, outer * y, high);
  }
  for (int k = 0; k < facets; k++) {
    const uint32_t a = first + 4 * (uint32_t)k;
    const uint32_t b = first + 4 * (uint32_t)((k + 1) % facets);
    shapes_quad(m, a, a + 1, b + 1, b);
    shapes_quad(m, a + 2, b + 2, b + 3, a + 3);
    shapes_quad(m, a, b, b + 2, a + 2);
    shapes_quad(m, a + 1, a + 3, b + 3, b + 1);
  }
}

// ---- threads

#define FITS_PITCH (2 * FITS_MM)
#define FITS_SLOPE (1.2 / 0.7)  // of a flank: radius by length

// The radius of a thread where it is so many pitches along: crest, flank, root, flank.
static double fits_thread(double s) {
  const double off = fabs(s - floor(s) - 0.5);  // 0: the middle of the crest; half: of the root
  const double down = fmin(fmax(off - 0.0625, 0), 0.35);
  return 8 * FITS_MM - down * FITS_SLOPE * FITS_PITCH;
}

// A thread of so many columns a turn and rows a pitch, grown by `more`: flat ends, closed by a ring
// of radius `outer`, or, where that is 0, by points on the axis. Facets run along the helix. What is
// about a thread (outer) is nowhere nearer to the axis than that and `more`, what is not nowhere
// farther, but for FITS_BLUNT: a facet's points are a little beside the helix of its corners.
#define FITS_BLUNT (2 * FITS_SLOPE * 1e-6)
static void fits_helix(shapes_mesh *m, double more, double outer, double low, int pitches,
                       int columns) {
  const uint32_t rows = (uint32_t)(pitches * columns) + 1;
  const uint32_t first = (uint32_t)m->vertices;
  const double wider = outer > 0 ? 1 / cos(SHAPES_PI / columns) : 1;
  for (int c = 0; c < columns; c++) {
    const double angle = 2 * SHAPES_PI * c / columns;
    for (uint32_t r = 0; r < rows; r++) {
      const double s = ((double)r - (double)c) / columns;
      const double radius = wider * (fits_thread(s) + more);
      shapes_vertex(m, radius * cos(angle), radius * sin(angle), low + FITS_PITCH * r / columns);
    }
  }
  const uint32_t rim = (uint32_t)m->vertices;
  for (int c = 0; c < columns || (outer <= 0 && c == 0); c++) {
    const double angle = 2 * SHAPES_PI * c / columns;
    for (int top = 0; top < 2; top++)
      shapes_vertex(m, outer * cos(angle), outer * sin(angle), low + top * FITS_PITCH * pitches);
  }
  const size_t triangle = m->triangles;
  for (uint32_t c = 0; c < (uint32_t)columns; c++) {
    const uint32_t next = (c + 1) % (uint32_t)columns;
    const uint32_t a = first + c * rows;
    const uint32_t b = first + next * rows;
    for (uint32_t r = 0; r + 1 < rows; r++) shapes_quad(m, a + r, b + r, b + r + 1, a + r + 1);
    const uint32_t here = rim + 2 * c;
    const uint32_t there = rim + 2 * next;
    shapes_quad(m, a, here, there, b);
    shapes_quad(m, a + rows - 1, b + rows - 1, there + 1, here + 1);
    if (outer > 0) shapes_quad(m, here, here + 1, there + 1, there);
  }
  if (outer > 0) shapes_flip(m, triangle);
}

// ---- gears

// An involute gear of module 2 mm, 20 degrees, with a hole; its teeth are thinner by `thinner` at
// the pitch circle. Between the corners of a flank it is within the true one.
#define FITS_MODULE (2 * FITS_MM)
static void fits_gear(shapes_mesh *m, int teeth, double thinner, double turned, double height) {
  enum { FLANK = 5 };
  const double pitch = 0.5 * FITS_MODULE * teeth;
  const double slant = 20 * SHAPES_PI / 180;
  const double base = pitch * cos(slant);
  const double root = pitch - 1.25 * FITS_MODULE;
  const double tip = pitch + FITS_MODULE;
  const double foot = fmax(base, root);
  const uint32_t first = (uint32_t)m->vertices;
  const uint32_t count = (uint32_t)teeth * 2 * (FLANK + 1);
  for (uint32_t k = 0; k < count; k++) {
    const int at = (int)(k % (2 * (FLANK + 1)));
    const int up = at <= FLANK ? at : 2 * FLANK + 1 - at;  // 0: the root, then along the flank
    const double radius = up == 0 ? root : foot + (tip - foot) * (up - 1) / (FLANK - 1);
    const double turn = acos(fmin(base / fmax(radius, base), 1));
    const double half =
        0.5 * SHAPES_PI / teeth - 0.5 * thinner / pitch + (tan(slant) - slant) - (tan(turn) - turn);
    const double middle = turned + 2 * SHAPES_PI * (k / (2 * (FLANK + 1))) / teeth;
    const double angle = at <= FLANK ? middle - half : middle + half;
    for (int top = 0; top < 2; top++) {
      const double z = (top - 0.5) * height;
      shapes_vertex(m, radius * cos(angle), radius * sin(angle), z);
      shapes_vertex(m, 0.3 * pitch * cos(angle), 0.3 * pitch * sin(angle), z);
    }
  }
  for (uint32_t k = 0; k < count; k++) {
    const uint32_t a = first + 4 * k;
    const uint32_t b = first + 4 * ((k + 1) % count);
    shapes_quad(m, a, b, b + 2, a + 2);
    shapes_quad(m, a + 1, a + 3, b + 3, b + 1);
    shapes_quad(m, a + 1, b + 1, b, a);
    shapes_quad(m, a + 3, a + 2, b + 2, b + 3);
  }
}

// ---- fits

// A shaft of radius 10 mm and length 60 mm in a bore of length 20 mm.
static void fits_shaft_in_bore(fits_case *f, int facets, double gap, int slides) {
  const double from[3] = {0, 0, slides ? 60 * FITS_MM : 0};
  const double to[3] = {0, 0, slides ? 10 * FITS_MM : 0};
  snprintf(f->name, sizeof f->name, "shaft of %d, %.0f um, %s", facets, 1e6 * gap,
           slides ? "slides in 2 turns" : "a quarter turn");
  fits_shaft(&f->a, 10 * FITS_MM, -30 * FITS_MM, 30 * FITS_MM, facets);
  fits_bore(&f->b, 10 * FITS_MM + gap, 20 * FITS_MM, -10 * FITS_MM, 10 * FITS_MM, facets);
  f->count_a = slides ? 17 : 2;
  fits_move(f->poses_a, f->count_a, 0, (slides ? 4 : 0.5) * SHAPES_PI, from, to);
  f->gap = gap;
}

// A nut on its bolt goes up as the thread does.
static void fits_nut_on_bolt(fits_case *f, int columns, double room, double turns) {
  const double to[3] = {0, 0, FITS_PITCH * turns};
  snprintf(f->name, sizeof f->name, "nut of %d, %.0f um, %g turns", columns, 1e6 * room, turns);
  fits_helix(&f->a, room, 14 * FITS_MM, -4 * FITS_MM, 4, columns);
  fits_helix(&f->b, 0, 0, -8 * FITS_MM, 8, columns);
  f->count_a = turns < 1 ? 3 : 9;
  fits_move(f->poses_a, f->count_a, 0, 2 * SHAPES_PI * turns, fits_origin, to);
  f->gap = (room - FITS_BLUNT) / sqrt(1 + FITS_SLOPE * FITS_SLOPE);
}

// A whole turn of the one; the other turns back as their teeth say.
static void fits_gears(fits_case *f, int teeth, int others, double gap) {
  const double thinner = gap / cos(20 * SHAPES_PI / 180);
  const double apart[3] = {0.5 * FITS_MODULE * (teeth + others), 0, 0};
  snprintf(f->name, sizeof f->name, "gears of %d and %d, %.0f um, a whole turn", teeth, others,
           1e6 * gap);
  fits_gear(&f->a, teeth, thinner, 0, 10 * FITS_MM);
  fits_gear(&f->b, others, thinner, others % 2 ? 0 : SHAPES_PI / others, 12 * FITS_MM);
  f->count_a = f->count_b = 9;
  fits_move(f->poses_a, 9, 0, 2 * SHAPES_PI, fits_origin, fits_origin);
  fits_move(f->poses_b, 9, 0, -2 * SHAPES_PI * teeth / others, apart, apart);
  f->gap = gap;
}

// Up and down, as a crank takes it.
static void fits_piston(fits_case *f, double gap) {
  snprintf(f->name, sizeof f->name, "piston, %.0f um", 1e6 * gap);
  fits_shaft(&f->a, 40 * FITS_MM, -30 * FITS_MM, 30 * FITS_MM, 64);
  fits_bore(&f->b, 40 * FITS_MM + gap, 50 * FITS_MM, -80 * FITS_MM, 80 * FITS_MM, 64);
  f->count_a = 33;
  for (int k = 0; k < 33; k++) {
    const double z[3] = {0, 0, 40 * FITS_MM * sin(2 * SHAPES_PI * k / 32)};
    fits_move(&f->poses_a[k], 1, 0, 0, z, z);
  }
  f->gap = gap;
}

// A leaf with a knuckle about the other's pin, between the other's knuckles.
static void fits_hinge(fits_case *f, double gap) {
  const double far_end = 10 * FITS_MM + gap;
  snprintf(f->name, sizeof f->name, "hinge, %.0f um, 100 degrees", 1e6 * gap);
  fits_bore(&f->a, 4 * FITS_MM + gap, 8 * FITS_MM, -10 * FITS_MM, 10 * FITS_MM, 32);
  shapes_box_at(&f->a, 27 * FITS_MM, 0, 0, 40 * FITS_MM, 3 * FITS_MM, 20 * FITS_MM);
  fits_shaft(&f->b, 4 * FITS_MM, -30 * FITS_MM, 30 * FITS_MM, 32);
  fits_bore(&f->b, 3 * FITS_MM, 8 * FITS_MM, far_end, 30 * FITS_MM, 32);
  fits_bore(&f->b, 3 * FITS_MM, 8 * FITS_MM, -30 * FITS_MM, -far_end, 32);
  for (int side = -1; side < 2; side += 2) {
    shapes_box_at(&f->b, -27 * FITS_MM, 0, side * (far_end + 10 * FITS_MM), 40 * FITS_MM,
                  3 * FITS_MM, 20 * FITS_MM);
  }
  shapes_box_at(&f->b, -30 * FITS_MM, 0, 0, 30 * FITS_MM, 3 * FITS_MM, 50 * FITS_MM);
  f->count_a = 3;
  fits_move(f->poses_a, 3, 0, 100 * SHAPES_PI / 180, fits_origin, fits_origin);
  f->gap = gap;
}

// A drawer of 400 x 300 x 100 mm is pushed into its cabinet, which it does not touch.
static void fits_drawer(fits_case *f, double gap) {
  const double from[3] = {-0.35, 0, 0};
  const double to[3] = {0.001, 0, 0};
  const double half[2] = {0.15, 0.05};
  const double wall = 0.012;
  snprintf(f->name, sizeof f->name, "drawer, %.0f um", 1e6 * gap);
  for (int side = -1; side < 2; side += 2) {
    const double y = side * (half[0] - 0.5 * wall);
    const double out = side * (half[0] + gap + 0.5 * wall);
    shapes_box_at(&f->a, 0, y, 0, 0.4, wall, 2 * half[1]);
    shapes_box_at(&f->a, side * (0.2 - 0.5 * wall), 0, 0, wall, 2 * half[0], 2 * half[1]);
    shapes_box_at(&f->b, 0, out, 0, 0.42, wall, 0.14);
    shapes_box_at(&f->b, 0, 0, side * (half[1] + gap + 0.5 * wall), 0.42, 0.33, wall);
  }
  shapes_box_at(&f->a, 0, 0, -half[1] + 0.5 * wall, 0.4, 2 * half[0], wall);
  shapes_box_at(&f->b, 0.21 + 0.5 * wall, 0, 0, wall, 0.33, 0.14);
  f->count_a = 2;
  fits_move(f->poses_a, 2, 0, 0, from, to);
  f->gap = gap;
}

#define FITS_CASES 34
// Number n of them; 0: there are no more. Its meshes are the caller's to free.
static int fits_make(size_t n, fits_case *f) {
  static const int facets[4] = {24, 32, 48, 128};
  static const double gaps[3] = {200e-6, 50e-6, 20e-6};
  memset(f, 0, sizeof *f);
  if (n < 24) {
    fits_shaft_in_bore(f, facets[n / 6], gaps[n / 2 % 3], n % 2);
  } else {
    switch (n) {
      case 24:
        fits_nut_on_bolt(f, 16, 200e-6, 0.25);
        break;
      case 25:
        fits_nut_on_bolt(f, 32, 200e-6, 0.25);
        break;
      case 26:
        fits_nut_on_bolt(f, 32, 100e-6, 0.25);
        break;
      case 27:
        fits_nut_on_bolt(f, 32, 200e-6, 1);
        break;
      case 28:
        fits_gears(f, 20, 20, 200e-6);
        break;
      case 29:
        fits_gears(f, 20, 31, 20e-6);
        break;
      case 30:
        fits_piston(f, 50e-6);
        break;
      case 31:
        fits_hinge(f, 100e-6);
        break;
      case 32:
        fits_drawer(f, 200e-6);
        break;
      case 33:
        fits_drawer(f, 20e-6);
        break;
      default:
        return 0;
    }
  }
  if (f->count_b == 0) {
    f->count_b = 1;
    fits_move(f->poses_b, 1, 0, 0, fits_origin, fits_origin);
  }
  return !f->a.failed && !f->b.failed;
}

#endif
