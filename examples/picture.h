// picture.h - draws what the quickstart asked about, as SVG: the fixed mesh and the moving one
// along its motion, light to dark, the place of contact marked. No part of the library. Include
// neuralsvcd.h first.
//
// In: meshes (metres), motions, answers. Out: one panel per motion. A parallel projection; nearer
// things cover farther ones, where the fixed mesh is sorted triangle by triangle and each drawing
// of the moving one counts as one thing.
#ifndef NSVCD_EXAMPLES_PICTURE_H
#define NSVCD_EXAMPLES_PICTURE_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PICTURE_MAX_POSES 128
#define PICTURE_WIDTH 664  // of a panel, pixels
#define PICTURE_HEIGHT 520
#define PICTURE_TOP 84  // of the panels
#define PICTURE_GHOSTS 9
#define PICTURE_SCALE 860.0  // pixels per metre

typedef struct picture_panel {
  const char *name;
  nsvcd_pose poses[PICTURE_MAX_POSES];
  size_t count;
  nsvcd_answer answer;
  double microseconds;
} picture_panel;

static void picture_take(picture_panel *panel, const char *name, const nsvcd_pose *poses,
                         size_t count, const nsvcd_answer *answer, double microseconds) {
  panel->name = name;
  panel->count = count < PICTURE_MAX_POSES ? count : PICTURE_MAX_POSES;
  memcpy(panel->poses, poses, panel->count * sizeof *poses);
  panel->answer = *answer;
  panel->microseconds = microseconds;
}

// -------------------------------------------------------------------------------------- projection

// World to the panel: x to the right and y down in pixels, z towards the viewer in metres. The
// camera stands at +x, 24 degrees towards -y, and looks down by 17 degrees.
static void picture_project(const double *p, double *out) {
  const double azimuth = -0.42;
  const double elevation = 0.30;
  double ca = cos(azimuth);
  double sa = sin(azimuth);
  double ce = cos(elevation);
  double se = sin(elevation);
  out[0] = 452 + PICTURE_SCALE * (-sa * p[0] + ca * p[1]);
  out[1] = 356 - PICTURE_SCALE * (-se * ca * p[0] - se * sa * p[1] + ce * p[2]);
  out[2] = ce * ca * p[0] + ce * sa * p[1] + se * p[2];
}
static void picture_place(const nsvcd_pose *pose, const float *v, double *out) {
  const float *q = pose->rotation;
  double c[3] = {(double)(q[1] * v[2] - q[2] * v[1] + q[3] * v[0]),
                 (double)(q[2] * v[0] - q[0] * v[2] + q[3] * v[1]),
                 (double)(q[0] * v[1] - q[1] * v[0] + q[3] * v[2])};
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3;
    int j = (k + 2) % 3;
    out[k] =
        (double)v[k] + 2 * ((double)q[i] * c[j] - (double)q[j] * c[i]) + (double)pose->position[k];
  }
}

typedef struct picture_triangle {
  double corners[3][3];  // in the panel
  double depth;          // of the middle; greater is nearer
  double top;            // highest z in world axes
  double light;          // 0 dark to 1 bright
  double facing;         // > 0: seen from outside
} picture_triangle;

static picture_triangle picture_look(const nsvcd_mesh *mesh, size_t index, const nsvcd_pose *pose) {
  const double to_light[3] = {0.45, -0.45, 0.77};
  picture_triangle t;
  double world[3][3], n[3], length;
  for (int c = 0; c < 3; c++) {
    picture_place(pose, mesh->positions + 3 * (size_t)mesh->indices[3 * index + (size_t)c],
                  world[c]);
    picture_project(world[c], t.corners[c]);
  }
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3;
    int j = (k + 2) % 3;
    n[k] = (world[1][i] - world[0][i]) * (world[2][j] - world[0][j]) -
           (world[1][j] - world[0][j]) * (world[2][i] - world[0][i]);
  }
  length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  t.light =
      length > 0
          ? 0.5 + 0.5 * (n[0] * to_light[0] + n[1] * to_light[1] + n[2] * to_light[2]) / length
          : 0.5;
  t.top = fmax(world[0][2], fmax(world[1][2], world[2][2]));
  t.depth = (t.corners[0][2] + t.corners[1][2] + t.corners[2][2]) / 3;
  t.facing = -((t.corners[1][0] - t.corners[0][0]) * (t.corners[2][1] - t.corners[0][1]) -
               (t.corners[1][1] - t.corners[0][1]) * (t.corners[2][0] - t.corners[0][0]));
  return t;
}
static int picture_compare(const void *a, const void *b) {
  double x = ((const picture_triangle *)a)->depth;
  double y = ((const picture_triangle *)b)->depth;
  return (x > y) - (x < y);
}
// All triangles that face the viewer, the farthest first. NULL without memory; the caller frees.
static picture_triangle *picture_sort(const nsvcd_mesh *mesh, const nsvcd_pose *pose,
                                      size_t *count) {
  picture_triangle *triangles =
      (picture_triangle *)malloc((mesh->triangle_count + 1) * sizeof *triangles);
  *count = 0;
  if (!triangles)
    return NULL;
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    triangles[*count] = picture_look(mesh, i, pose);
    if (triangles[*count].facing > 0)
      ++*count;
  }
  qsort(triangles, *count, sizeof *triangles, picture_compare);
  return triangles;
}

// ----------------------------------------------------------------------------------------- drawing

typedef struct picture_colour {
  double dark[3], bright[3];
} picture_colour;

static const picture_colour picture_steel = {{84, 98, 116}, {214, 222, 232}};
static const picture_colour picture_red = {{132, 14, 22}, {255, 128, 116}};
static const picture_colour picture_green = {{10, 92, 52}, {116, 222, 150}};

static void picture_corner_list(FILE *svg, const picture_triangle *t) {
  fprintf(svg, "M%.1f %.1fL%.1f %.1fL%.1f %.1fZ", t->corners[0][0], t->corners[0][1],
          t->corners[1][0], t->corners[1][1], t->corners[2][0], t->corners[2][1]);
}
static void picture_rgb(FILE *svg, const picture_colour *colour, double light) {
  fprintf(svg, "rgb(%.0f,%.0f,%.0f)",
          colour->dark[0] + light * (colour->bright[0] - colour->dark[0]),
          colour->dark[1] + light * (colour->bright[1] - colour->dark[1]),
          colour->dark[2] + light * (colour->bright[2] - colour->dark[2]));
}
// The thin edge of the same colour hides the seams between triangles.
static void picture_shaded(FILE *svg, const picture_triangle *t, const picture_colour *colour) {
  fprintf(svg, "<path d=\"");
  picture_corner_list(svg, t);
  fprintf(svg, "\" stroke-width=\".6\" fill=\"");
  picture_rgb(svg, colour, t->light);
  fprintf(svg, "\" stroke=\"");
  picture_rgb(svg, colour, t->light);
  fprintf(svg, "\"/>\n");
}
// One moving body: shaded if `solid`, else a silhouette. `light`: from 1, early, to 0, late.
static void picture_moving(FILE *svg, const nsvcd_mesh *mesh, const nsvcd_pose *pose,
                           const picture_colour *colour, double light, int solid) {
  size_t count;
  picture_triangle *triangles = picture_sort(mesh, pose, &count);
  if (!triangles)
    return;
  if (solid) {
    for (size_t i = 0; i < count; i++)
      picture_shaded(svg, &triangles[i], colour);
  } else {
    fprintf(svg, "<path fill-opacity=\"%.2f\" fill=\"", 0.16 + 0.30 * (1 - light));
    picture_rgb(svg, colour, 0.25 + 0.75 * light);
    fprintf(svg, "\" d=\"");
    for (size_t i = 0; i < count; i++)
      picture_corner_list(svg, &triangles[i]);
    fprintf(svg, "\"/>\n");
  }
  free(triangles);
}
// The shadow on the table: light from straight above.
static void picture_shadow(FILE *svg, const nsvcd_mesh *mesh, const nsvcd_pose *pose) {
  fprintf(svg, "<path fill=\"#1b2430\" fill-opacity=\".13\" d=\"");
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    picture_triangle t;
    for (int c = 0; c < 3; c++) {
      double p[3];
      picture_place(pose, mesh->positions + 3 * (size_t)mesh->indices[3 * i + (size_t)c], p);
      p[2] = 0;
      picture_project(p, t.corners[c]);
    }
    double turn = (t.corners[1][0] - t.corners[0][0]) * (t.corners[2][1] - t.corners[0][1]) -
                  (t.corners[1][1] - t.corners[0][1]) * (t.corners[2][0] - t.corners[0][0]);
    if (turn < -0.05)
      picture_corner_list(svg, &t);
  }
  fprintf(svg, "\"/>\n");
}
static void picture_table(FILE *svg) {
  const double corners[4][3] = {
      {0.25, -0.60, 0}, {0.25, 0.26, 0}, {-0.27, 0.26, 0}, {-0.27, -0.60, 0}};
  fprintf(svg, "<path fill=\"#efe7da\" stroke=\"#ddd0bb\" d=\"");
  for (int i = 0; i < 4; i++) {
    double p[3];
    picture_project(corners[i], p);
    fprintf(svg, "%s%.1f %.1f", i ? "L" : "M", p[0], p[1]);
  }
  fprintf(svg, "Z\"/>\n");
}
// The path of the moving body's origin.
static void picture_path(FILE *svg, const picture_panel *panel, const char *ink) {
  fprintf(svg,
          "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2\" stroke-dasharray=\"2 6\" "
          "stroke-linecap=\"round\" d=\"",
          ink);
  for (size_t i = 0; i < panel->count; i++) {
    double p[3];
    double world[3] = {(double)panel->poses[i].position[0], (double)panel->poses[i].position[1],
                       (double)panel->poses[i].position[2]};
    picture_project(world, p);
    fprintf(svg, "%s%.1f %.1f", i ? "L" : "M", p[0], p[1]);
  }
  fprintf(svg, "\"/>\n");
}
// The witness: a ring about the point, and the normal, 12 cm long, out of the fixed body.
static void picture_contact(FILE *svg, const picture_panel *panel) {
  const nsvcd_answer *a = &panel->answer;
  double world[3], tip[3], p[3], q[3];
  for (int k = 0; k < 3; k++) {
    world[k] = (double)a->point[k];
    tip[k] = world[k] + 0.12 * (double)a->normal[k];
  }
  picture_project(world, p);
  picture_project(tip, q);
  const double x = q[0] - p[0];
  const double y = q[1] - p[1];
  const double length = hypot(x, y) + 1e-9;
  const double ux = x / length;
  const double uy = y / length;
  fprintf(
      svg,
      "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"17\" fill=\"none\" stroke=\"#fff\" stroke-width=\"7\"/>"
      "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"17\" fill=\"none\" stroke=\"#ffb300\" "
      "stroke-width=\"4\"/>"
      "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"#ffb300\" stroke=\"#fff\" "
      "stroke-width=\"1.5\"/>\n",
      p[0], p[1], p[0], p[1], p[0], p[1]);
  fprintf(svg, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"#fff\" stroke-width=\"7\"/>", p[0], p[1],
          q[0], q[1]);
  fprintf(svg, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"#ffb300\" stroke-width=\"4\"/>", p[0],
          p[1], q[0], q[1]);
  fprintf(svg, "<path d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fZ\" fill=\"#ffb300\"/>\n", q[0] + 14 * ux,
          q[1] + 14 * uy, q[0] - 7 * uy, q[1] + 7 * ux, q[0] + 7 * uy, q[1] - 7 * ux);
}

// What of the fixed mesh covers the moving one, or all the rest. Seen from above, nothing that lies
// lower can cover it.
static void picture_fixed(FILE *svg, const picture_triangle *triangles, size_t count, double depth,
                          double lowest, int covering) {
  for (size_t i = 0; i < count; i++) {
    int covers = triangles[i].depth > depth && triangles[i].top > lowest;
    if (covers == covering)
      picture_shaded(svg, &triangles[i], &picture_steel);
  }
}
// The lowest z of a moving body, and the depth of its middle. What touches it shall not be cut in
// two by that depth: hence a little nearer than the middle.
static void picture_stand(const nsvcd_mesh *mesh, const nsvcd_pose *pose, double *depth,
                          double *lowest) {
  double world[3];
  double p[3];
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  *lowest = HUGE_VAL;
  for (size_t i = 0; i < mesh->vertex_count; i++) {
    picture_place(pose, mesh->positions + 3 * i, world);
    *lowest = fmin(*lowest, world[2]);
    world[2] = 0;
    picture_project(world, p);
    least = fmin(least, p[2]);
    most = fmax(most, p[2]);
  }
  *depth = 0.35 * least + 0.65 * most;
}
// Back to front: what of the fixed mesh lies behind the moving one, the silhouettes, the moving
// body at the time of contact or else at the end, the rest of the fixed mesh, the mark.
static void picture_scene(FILE *svg, const nsvcd_mesh *moving, const nsvcd_mesh *fixed,
                          const picture_panel *panel) {
  const nsvcd_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  const nsvcd_answer *a = &panel->answer;
  const picture_colour *colour = a->collides ? &picture_red : &picture_green;
  size_t count;
  size_t last = panel->count - 1;
  size_t shown = a->collides ? (size_t)((double)a->contact_time * (double)last + 0.5) : last;
  picture_triangle *triangles = picture_sort(fixed, &origin, &count);
  if (!triangles)
    return;
  picture_shadow(svg, fixed, &origin);
  picture_shadow(svg, moving, &panel->poses[shown]);
  double depth, lowest;
  picture_stand(moving, &panel->poses[shown], &depth, &lowest);
  picture_fixed(svg, triangles, count, depth, lowest, 0);
  for (size_t i = 0; i < PICTURE_GHOSTS; i++) {
    size_t at = i * last / (PICTURE_GHOSTS - 1);
    if (at != shown)
      picture_moving(svg, moving, &panel->poses[at], colour, 1 - (double)at / (double)last, 0);
  }
  picture_path(svg, panel, a->collides ? "#b3202c" : "#12824c");
  picture_moving(svg, moving, &panel->poses[shown], colour, 0, 1);
  picture_fixed(svg, triangles, count, depth, lowest, 1);
  free(triangles);
  if (a->status == NSVCD_STATUS_WITNESS)
    picture_contact(svg, panel);
}

// Name and verdict above, facts below.
static void picture_captions(FILE *svg, const picture_panel *panel) {
  const nsvcd_answer *a = &panel->answer;
  int pill = a->collides ? 170 : 130;
  fprintf(
      svg,
      "<text x=\"24\" y=\"41\" font-size=\"20\" font-weight=\"600\" fill=\"#2b3440\">%s</text>\n",
      panel->name);
  fprintf(svg, "<rect x=\"%d\" y=\"18\" width=\"%d\" height=\"34\" rx=\"17\" fill=\"%s\"/>\n",
          PICTURE_WIDTH - 20 - pill, pill, a->collides ? "#b3202c" : "#12824c");
  fprintf(svg,
          "<text x=\"%d\" y=\"41\" font-size=\"16\" font-weight=\"700\" fill=\"#fff\" "
          "text-anchor=\"middle\">%s</text>\n",
          PICTURE_WIDTH - 20 - pill / 2, a->collides ? "HITS THE RACK" : "CLEARS IT");
  fprintf(svg, "<rect y=\"%d\" width=\"%d\" height=\"44\" fill=\"#fff\" fill-opacity=\".9\"/>\n",
          PICTURE_HEIGHT - 44, PICTURE_WIDTH);
  fprintf(svg, "<text x=\"24\" y=\"%d\" font-size=\"15\" fill=\"#4a5564\">", PICTURE_HEIGHT - 17);
  if (a->collides)
    fprintf(svg, "at t = %.2f of the way, ", (double)a->contact_time);
  if (a->status == NSVCD_STATUS_CERTIFIED_FREE) {
    fprintf(svg, "certified free");
  } else if (a->status == NSVCD_STATUS_WITNESS) {
    fprintf(svg, "triangle %lu meets triangle %lu", (unsigned long)a->triangle_a,
            (unsigned long)a->triangle_b);
  } else {
    fprintf(svg, "%s", nsvcd_status_string(a->status));
  }
  fprintf(svg, ", answered in %.0f µs</text>\n", panel->microseconds);
}

static void picture_legend(FILE *svg, int x, int y) {
  fprintf(svg, "<g transform=\"translate(%d %d)\" font-size=\"14\" fill=\"#5a6675\">\n", x, y);
  for (int i = 0; i < 5; i++)
    fprintf(svg, "<circle cx=\"%d\" cy=\"-5\" r=\"8\" fill=\"#46505e\" fill-opacity=\"%.2f\"/>",
            10 + 13 * i, 0.14 + 0.14 * i);
  fprintf(svg, "<text x=\"84\">the mug from start (light) to end (dark)</text>\n");
  fprintf(svg,
          "<path d=\"M424 -5H462\" stroke=\"#46505e\" stroke-width=\"2\" stroke-dasharray=\"2 6\" "
          "stroke-linecap=\"round\"/><text x=\"474\">the path it is carried along</text>\n");
  fprintf(
      svg,
      "<circle cx=\"736\" cy=\"-5\" r=\"9\" fill=\"none\" stroke=\"#ffb300\" stroke-width=\"4\"/>"
      "<text x=\"756\">the witness: where two triangles meet, and the normal</text>\n</g>\n");
}

// Returns 1, or 0 after a message.
static int picture_write(const char *path, const nsvcd_mesh *moving, const nsvcd_mesh *fixed,
                         const picture_panel *panels, int count) {
  FILE *svg = fopen(path, "w");
  if (!svg)
    return fprintf(stderr, "%s: cannot be written\n", path), 0;
  int width = 24 + (PICTURE_WIDTH + 24) * count;
  int height = PICTURE_TOP + PICTURE_HEIGHT + 56;
  fprintf(
      svg,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
      "font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"%d\" height=\"%d\" "
      "fill=\"#f6f7f9\"/>\n",
      width, height, width, height, width, height);
  fprintf(svg,
          "<text x=\"26\" y=\"38\" font-size=\"26\" font-weight=\"700\" fill=\"#1b2430\">"
          "Does the mug, carried along this path, hit the dish rack?</text>\n");
  fprintf(svg,
          "<text x=\"26\" y=\"64\" font-size=\"15\" fill=\"#5a6675\">"
          "neuralsvcd.h: each mesh encoded once, each whole motion answered by one query</text>\n");
  for (int i = 0; i < count; i++) {
    fprintf(svg, "<g transform=\"translate(%d %d)\">\n", 24 + (PICTURE_WIDTH + 24) * i,
            PICTURE_TOP);
    fprintf(svg,
            "<clipPath id=\"panel%d\"><rect width=\"%d\" height=\"%d\" rx=\"12\"/></clipPath>\n", i,
            PICTURE_WIDTH, PICTURE_HEIGHT);
    fprintf(svg,
            "<g clip-path=\"url(#panel%d)\"><rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n", i,
            PICTURE_WIDTH, PICTURE_HEIGHT);
    picture_table(svg);
    picture_scene(svg, moving, fixed, &panels[i]);
    picture_captions(svg, &panels[i]);
    fprintf(svg,
            "</g>\n<rect width=\"%d\" height=\"%d\" rx=\"12\" fill=\"none\" stroke=\"#d5dae1\"/>\n",
            PICTURE_WIDTH, PICTURE_HEIGHT);
    fprintf(svg, "</g>\n");
  }
  picture_legend(svg, 26, height - 22);
  fprintf(svg, "</svg>\n");
  int good = !ferror(svg);
  if (fclose(svg) == 0 && good)
    return 1;
  return fprintf(stderr, "%s: cannot be written\n", path), 0;
}

#endif
