// film.h - the quickstart's two motions as a film (scenery/gif.h): the mug is carried low as far as its
// first contact, goes back, is carried high, and goes back. A bar tells the time: green as far as the
// motion is proven free, red at the contact. No part of the library. Include picture.h first.
#ifndef NSVCD_EXAMPLES_FILM_H
#define NSVCD_EXAMPLES_FILM_H

#include "scenery/gif.h"

#define FILM_WIDTH 720
#define FILM_HEIGHT 430
#define FILM_WIDE (DRAW_SAMPLES * FILM_WIDTH)  // samples
#define FILM_TALL (DRAW_SAMPLES * FILM_HEIGHT)
#define FILM_STEPS 40  // steps of a whole motion, forth; half as many back
#define FILM_DELAY 4   // hundredths of a second that a frame stands
#define FILM_BAR 404   // pixels from the top to the bar
#define FILM_LEFT 40   // ... and from the side

static const draw_view film_view = {-0.42, 0.30,       {0, -0.1428, 0.1651},
                                    800,   FILM_WIDTH, FILM_HEIGHT};
static const uint8_t film_table[3] = {239, 231, 218};
static const uint8_t film_ink[3] = {70, 80, 94};
static const uint8_t film_pale[3] = {222, 226, 232};
static const uint8_t film_white[3] = {255, 255, 255};
static const uint8_t film_amber[3] = {255, 179, 0};
static const uint8_t film_green[3] = {18, 130, 76};
static const uint8_t film_red[3] = {179, 32, 44};

typedef struct film {
  const oracle_mesh *moving, *fixed;
  const picture_panel *panel;
  draw_raster raster;
  uint8_t *samples;  // (FILM_TALL, FILM_WIDE, 3)
  uint8_t *shadow;   // (FILM_TALL, FILM_WIDE)
  uint8_t *pixels;   // (FILM_HEIGHT, FILM_WIDTH, 3)
  gif_film gif;
} film;

// ----------------------------------------------------------------------------------------- shapes

typedef struct film_box {
  int low[2], high[2];  // samples; high: behind the last one
} film_box;

static film_box film_box_of(double x0, double y0, double x1, double y1, double edge) {
  const double low[2] = {fmin(x0, x1) - edge, fmin(y0, y1) - edge};
  const double high[2] = {fmax(x0, x1) + edge, fmax(y0, y1) + edge};
  const int size[2] = {FILM_WIDE, FILM_TALL};
  film_box box;
  for (int k = 0; k < 2; k++) {
    box.low[k] = (int)fmax(0, floor(DRAW_SAMPLES * low[k]));
    box.high[k] = (int)fmin(size[k], ceil(DRAW_SAMPLES * high[k]));
  }
  return box;
}

static void film_put(film *f, int x, int y, const uint8_t *colour) {
  memcpy(f->samples + 3 * ((size_t)y * FILM_WIDE + (size_t)x), colour, 3);
}

// A line with round ends; a disc where both ends are one point.
static void film_line(film *f, double x0, double y0, double x1, double y1, double width,
                      const uint8_t *colour) {
  const film_box box = film_box_of(x0, y0, x1, y1, width);
  const double dx = x1 - x0;
  const double dy = y1 - y0;
  const double square = dx * dx + dy * dy;
  for (int y = box.low[1]; y < box.high[1]; y++)
    for (int x = box.low[0]; x < box.high[0]; x++) {
      const double px = (x + 0.5) / DRAW_SAMPLES - x0;
      const double py = (y + 0.5) / DRAW_SAMPLES - y0;
      const double t = square > 0 ? fmax(0, fmin(1, (px * dx + py * dy) / square)) : 0;
      if (hypot(px - t * dx, py - t * dy) < width / 2) film_put(f, x, y, colour);
    }
}

static void film_ring(film *f, double x0, double y0, double radius, double width,
                      const uint8_t *colour) {
  const film_box box = film_box_of(x0, y0, x0, y0, radius + width);
  for (int y = box.low[1]; y < box.high[1]; y++)
    for (int x = box.low[0]; x < box.high[0]; x++) {
      const double px = (x + 0.5) / DRAW_SAMPLES - x0;
      const double py = (y + 0.5) / DRAW_SAMPLES - y0;
      if (fabs(hypot(px, py) - radius) < width / 2) film_put(f, x, y, colour);
    }
}

// A triangle, whichever way round.
static void film_triangle(film *f, const double (*p)[3], const uint8_t *colour, uint8_t *mask) {
  const double area = draw_area(p[0], p[1], p[2][0], p[2][1]);
  const film_box box =
      film_box_of(fmin(p[0][0], fmin(p[1][0], p[2][0])), fmin(p[0][1], fmin(p[1][1], p[2][1])),
                  fmax(p[0][0], fmax(p[1][0], p[2][0])), fmax(p[0][1], fmax(p[1][1], p[2][1])), 1);
  if (fabs(area) < 1e-9) return;
  for (int y = box.low[1]; y < box.high[1]; y++)
    for (int x = box.low[0]; x < box.high[0]; x++) {
      const double at[2] = {(x + 0.5) / DRAW_SAMPLES, (y + 0.5) / DRAW_SAMPLES};
      const double u = draw_area(p[1], p[2], at[0], at[1]) / area;
      const double v = draw_area(p[2], p[0], at[0], at[1]) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      if (mask)
        mask[(size_t)y * FILM_WIDE + (size_t)x] = 1;
      else
        film_put(f, x, y, colour);
    }
}

// ------------------------------------------------------------------------------------------ scene

static void film_table_top(film *f) {
  const double corners[4][3] = {
      {0.25, -0.62, 0}, {0.25, 0.30, 0}, {-0.27, 0.30, 0}, {-0.27, -0.62, 0}};
  for (int half = 0; half < 2; half++) {
    double p[3][3];
    draw_project(&film_view, corners[0], p[0]);
    draw_project(&film_view, corners[half + 1], p[1]);
    draw_project(&film_view, corners[half + 2], p[2]);
    film_triangle(f, (const double(*)[3])p, film_table, NULL);
  }
}

// Casts a mesh's shadow on the table, of light from straight above.
static void film_cast(film *f, const oracle_mesh *mesh, const oracle_pose *pose) {
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    double world[3], p[3][3];
    for (int k = 0; k < 3; k++) {
      oracle_transform(pose, mesh->triangles[i].v[k], world);
      world[2] = 0;
      draw_project(&film_view, world, p[k]);
    }
    film_triangle(f, (const double(*)[3])p, NULL, f->shadow);
  }
}
static void film_shadows(film *f, const oracle_pose *pose) {
  memset(f->shadow, 0, (size_t)FILM_WIDE * FILM_TALL);
  film_cast(f, f->fixed, &picture_origin);
  film_cast(f, f->moving, pose);
  for (size_t i = 0; i < (size_t)FILM_WIDE * FILM_TALL; i++)
    for (size_t k = 0; k < 3 && f->shadow[i]; k++)
      f->samples[3 * i + k] = (uint8_t)(f->samples[3 * i + k] * 0.88);
}

static void film_bodies(film *f, const oracle_pose *pose, const draw_colour *colour) {
  const size_t count = (size_t)FILM_WIDE * FILM_TALL;
  draw_list list = {&film_view, NULL, 0, 0, 0};
  draw_solid(&list, f->fixed, &picture_origin, &draw_steel, 1);
  draw_solid(&list, f->moving, pose, colour, 1);
  memset(f->raster.fills, 0, count * sizeof *f->raster.fills);
  for (size_t i = 0; i < count; i++) f->raster.depths[i] = -HUGE_VALF;
  for (size_t i = 0; i < list.count; i++) draw_fill_in(&f->raster, &list.triangles[i]);
  for (size_t i = 0; i < count; i++)
    for (size_t k = 0; k < 3 && f->raster.fills[i]; k++)
      f->samples[3 * i + k] = (uint8_t)(f->raster.fills[i] >> (16 - 8 * k));
  free(list.triangles);
}

// Dots along the way of the mug's middle, as many a centimetre everywhere.
static void film_way(film *f) {
  double before[3], gone = 0;
  for (int i = 0; i <= 400; i++) {
    const picture_panel *panel = f->panel;
    oracle_pose poses[PICTURE_MAX_POSES];
    double world[3], p[3];
    for (size_t n = 0; n < panel->count; n++) poses[n] = pose_widened(&panel->poses[n]);
    const oracle_pose pose = oracle_pose_at(poses, panel->count, i / 400.0);
    oracle_transform(&pose, f->moving->center, world);
    draw_project(&film_view, world, p);
    if (i) gone += hypot(p[0] - before[0], p[1] - before[1]);
    memcpy(before, p, sizeof before);
    if (i && gone < 9) continue;
    gone = 0;
    film_line(f, p[0], p[1], p[0], p[1], 3, film_ink);
  }
}

// shown: 0, nothing of the mark, to 1. The ring closes about the point, and the normal grows out of it.
static void film_mark(film *f, double shown) {
  const nsvcd_answer *a = &f->panel->answer;
  double world[3], tip[3], p[3], q[3];
  for (int k = 0; k < 3; k++) {
    world[k] = (double)a->nearest.point[k];
    tip[k] = world[k] + 0.12 * shown * (double)a->nearest.normal[k];
  }
  draw_project(&film_view, world, p);
  draw_project(&film_view, tip, q);
  const double length = hypot(q[0] - p[0], q[1] - p[1]) + 1e-9;
  const double ux = (q[0] - p[0]) / length;
  const double uy = (q[1] - p[1]) / length;
  const double head[3][3] = {{q[0] + 15 * ux, q[1] + 15 * uy, 0},
                             {q[0] - 8 * uy, q[1] + 8 * ux, 0},
                             {q[0] + 8 * uy, q[1] - 8 * ux, 0}};
  const double radius = 16 + 44 * (1 - shown) * (1 - shown);
  film_ring(f, p[0], p[1], radius, 8, film_white);
  film_ring(f, p[0], p[1], radius, 4.5, film_amber);
  film_line(f, p[0], p[1], q[0], q[1], 8, film_white);
  film_line(f, p[0], p[1], q[0], q[1], 4.5, film_amber);
  film_triangle(f, head, film_amber, NULL);
}

// Green as far as `time`; red from the contact on, once it is shown.
static void film_bar(film *f, double time, int is_hit) {
  const double wide = FILM_WIDTH - 2 * FILM_LEFT;
  const double at = FILM_LEFT + wide * time;
  film_line(f, FILM_LEFT, FILM_BAR, FILM_LEFT + wide, FILM_BAR, 10, film_pale);
  film_line(f, FILM_LEFT, FILM_BAR, at, FILM_BAR, 10, film_green);
  if (is_hit) film_line(f, at, FILM_BAR, at, FILM_BAR, 22, film_white);
  film_line(f, at, FILM_BAR, at, FILM_BAR, 17, is_hit ? film_red : film_green);
}

// Means of samples.
static void film_shrink(film *f) {
  for (size_t y = 0; y < FILM_HEIGHT; y++)
    for (size_t x = 0; x < FILM_WIDTH; x++)
      for (size_t k = 0; k < 3; k++) {
        unsigned sum = 0;
        for (size_t i = 0; i < DRAW_SAMPLES * DRAW_SAMPLES; i++) {
          const size_t sy = DRAW_SAMPLES * y + i / DRAW_SAMPLES;
          const size_t sx = DRAW_SAMPLES * x + i % DRAW_SAMPLES;
          sum += f->samples[3 * (sy * FILM_WIDE + sx) + k];
        }
        f->pixels[3 * (y * FILM_WIDTH + x) + k] = (uint8_t)(sum / (DRAW_SAMPLES * DRAW_SAMPLES));
      }
}

// The mug at a time of its motion. Returns 0 without memory.
static int film_frame(film *f, double time, const draw_colour *colour, double mark, int delay) {
  oracle_pose poses[PICTURE_MAX_POSES];
  for (size_t i = 0; i < f->panel->count; i++) poses[i] = pose_widened(&f->panel->poses[i]);
  const oracle_pose pose = oracle_pose_at(poses, f->panel->count, time);
  memset(f->samples, 255, (size_t)FILM_WIDE * FILM_TALL * 3);
  film_table_top(f);
  film_shadows(f, &pose);
  film_bodies(f, &pose, colour);
  film_way(f);
  if (mark > 0) film_mark(f, mark);
  film_bar(f, time, mark > 0);
  film_shrink(f);
  return gif_add(&f->gif, f->pixels, delay);
}

// Films a motion from the start to the contact or the end, a rest there, and the way back.
static int film_motion(film *f, const picture_panel *panel) {
  const int is_hit = panel->answer.verdict == NSVCD_HIT;
  const double end = is_hit ? (double)panel->answer.time.low : 1;
  const int steps = (int)(FILM_STEPS * end + 0.5);
  int good = 1;
  f->panel = panel;
  good = film_frame(f, 0, &draw_blue, 0, 40);
  for (int i = 1; i < steps && good; i++)
    good = film_frame(f, end * i / steps, &draw_blue, 0, FILM_DELAY);
  for (int i = 1; i <= 6 && good && is_hit; i++)
    good = film_frame(f, end, &draw_red, i / 6.0, i < 6 ? FILM_DELAY : 180);
  if (!is_hit && good) good = film_frame(f, end, &draw_green, 0, 150);
  for (int i = steps / 2; i > 0 && good; i--)
    good = film_frame(f, 2 * end * i / (steps + 2), &draw_blue, 0, FILM_DELAY);
  return good;
}

// Returns 1, or 0 after a message.
static int film_write(const char *path, const nsvcd_mesh *moving, const nsvcd_mesh *fixed,
                      const picture_panel *panels, int count) {
  const size_t samples = (size_t)FILM_WIDE * FILM_TALL;
  oracle_mesh a = picture_mesh(moving);
  oracle_mesh b = picture_mesh(fixed);
  film f;
  memset(&f, 0, sizeof f);
  f.moving = &a;
  f.fixed = &b;
  f.raster.width = FILM_WIDE;
  f.raster.height = FILM_TALL;
  f.raster.fills = (uint32_t *)malloc(samples * sizeof *f.raster.fills);
  f.raster.depths = (float *)malloc(samples * sizeof *f.raster.depths);
  f.samples = (uint8_t *)malloc(3 * samples);
  f.shadow = (uint8_t *)malloc(samples);
  f.pixels = (uint8_t *)malloc(3 * FILM_WIDTH * FILM_HEIGHT);
  f.gif.width = FILM_WIDTH;
  f.gif.height = FILM_HEIGHT;
  int good = f.raster.fills && f.raster.depths && f.samples && f.shadow && f.pixels;
  for (int i = 0; i < count && good; i++) good = film_motion(&f, &panels[i]);
  if (!good) fprintf(stderr, "%s: not enough memory\n", path);
  good = good && gif_write(&f.gif, path);
  gif_free(&f.gif);
  free(f.raster.fills);
  free(f.raster.depths);
  free(f.samples);
  free(f.shadow);
  free(f.pixels);
  oracle_mesh_free(&a);
  oracle_mesh_free(&b);
  return good;
}

#endif  // NSVCD_EXAMPLES_FILM_H
