// picture.h - draws what the quickstart asked about, as SVG (scenery/draw.h): the fixed mesh and the
// moving one along its motion, light to dark, the place of contact marked. No part of the library.
// Include neuralsvcd.h first.
//
// In: meshes (metres), motions, answers. Out: one panel per motion. Nearer things cover farther
// ones, where each drawing of the moving mesh counts as one thing.
#ifndef NSVCD_EXAMPLES_PICTURE_H
#define NSVCD_EXAMPLES_PICTURE_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenery/draw.h"
#include "scenery/poses.h"

#define PICTURE_MAX_POSES 128
#define PICTURE_WIDTH 664  // pixels of a panel
#define PICTURE_HEIGHT 520
#define PICTURE_TOP 84  // of the panels
#define PICTURE_GHOSTS 9

// The camera stands at +x, 24 degrees towards -y, and looks down by 17 degrees.
static const draw_view picture_view = {-0.42, 0.30,          {0, -0.1528, 0.1361},
                                       860,   PICTURE_WIDTH, PICTURE_HEIGHT};
static const oracle_pose picture_origin = {{0, 0, 0}, {0, 0, 0, 1}};

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

// Exits where there is no memory.
static oracle_mesh picture_mesh(const nsvcd_mesh *mesh) {
  oracle_mesh out;
  double *positions = (double *)malloc(3 * mesh->vertex_count * sizeof *positions);
  for (size_t i = 0; positions && i < 3 * mesh->vertex_count; i++)
    positions[i] = (double)mesh->positions[i];
  if (!positions || !oracle_mesh_init(&out, positions, mesh->vertex_count, mesh->indices,
                                      mesh->triangle_count, 1)) {
    exit(1);
  }
  free(positions);
  return out;
}

// ----------------------------------------------------------------------------------------- drawing

// The moving body on its way, a silhouette. `light`: from 1, early, to 0, late.
static void picture_ghost(FILE *svg, const oracle_mesh *mesh, const nsvcd_pose *pose,
                          const draw_colour *colour, double light) {
  draw_list list = {&picture_view, NULL, 0, 0, 0};
  const oracle_pose at = pose_widened(pose);
  draw_solid(&list, mesh, &at, colour, 0.16 + 0.30 * (1 - light));
  for (size_t i = 0; i < list.count; i++) list.triangles[i].light = 0.25 + 0.75 * light;
  draw_flush(svg, &list);
}
// The shadow on the table: light from straight above.
static void picture_shadow(FILE *svg, const oracle_mesh *mesh, const oracle_pose *pose) {
  double m[9];
  oracle_matrix(pose->rotation, m);
  fprintf(svg, "<path fill=\"#1b2430\" fill-opacity=\".13\" d=\"");
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    const oracle_triangle *t = &mesh->triangles[i];
    double normal[3], world[3];
    oracle_rotate(m, t->normal, normal);
    if (normal[2] < 1e-3) continue;
    for (int k = 0; k < 3; k++) {
      oracle_transform(pose, t->v[k], world);
      world[2] = 0;
      draw_to(svg, &picture_view, k == 0, world);
    }
    fprintf(svg, "Z");
  }
  fprintf(svg, "\"/>\n");
}
static void picture_table(FILE *svg) {
  const double corners[4][3] = {
      {0.25, -0.60, 0}, {0.25, 0.26, 0}, {-0.27, 0.26, 0}, {-0.27, -0.60, 0}};
  fprintf(svg, "<path fill=\"#efe7da\" stroke=\"#ddd0bb\" d=\"");
  for (int i = 0; i < 4; i++) draw_to(svg, &picture_view, i == 0, corners[i]);
  fprintf(svg, "Z\"/>\n");
}
// The path of the moving body's origin.
static void picture_path(FILE *svg, const picture_panel *panel, const char *ink) {
  fprintf(svg,
          "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2\" stroke-dasharray=\"2 6\" "
          "stroke-linecap=\"round\" d=\"",
          ink);
  for (size_t i = 0; i < panel->count; i++) {
    const oracle_pose pose = pose_widened(&panel->poses[i]);
    draw_to(svg, &picture_view, i == 0, pose.position);
  }
  fprintf(svg, "\"/>\n");
}
// The witness: a ring about the point, and the normal, 12 cm long, out of the fixed body.
static void picture_contact(FILE *svg, const picture_panel *panel) {
  const nsvcd_answer *a = &panel->answer;
  double world[3], tip[3], p[3], q[3];
  for (int k = 0; k < 3; k++) {
    world[k] = (double)a->nearest.point[k];
    tip[k] = world[k] + 0.12 * (double)a->nearest.normal[k];
  }
  draw_project(&picture_view, world, p);
  draw_project(&picture_view, tip, q);
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

// Draws that part of the fixed mesh which covers the moving one, or all the rest. Seen from above,
// nothing that lies lower can cover it.
static void picture_fixed(FILE *svg, const oracle_mesh *mesh, double depth, double lowest,
                          int covering) {
  draw_list list = {&picture_view, NULL, 0, 0, 0};
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    const oracle_triangle *t = &mesh->triangles[i];
    double middle[3], p[3];
    for (int k = 0; k < 3; k++) middle[k] = (t->v[0][k] + t->v[1][k] + t->v[2][k]) / 3;
    draw_project(&picture_view, middle, p);
    const double top = fmax(t->v[0][2], fmax(t->v[1][2], t->v[2][2]));
    if ((p[2] > depth && top > lowest) == covering)
      draw_one(&list, t, &picture_origin, &draw_steel, 1);
  }
  draw_flush(svg, &list);
}
// The lowest z of a moving body, and the depth of its middle. What touches it shall not be cut in
// two by that depth: hence a little nearer than the middle.
static void picture_stand(const oracle_mesh *mesh, const oracle_pose *pose, double *depth,
                          double *lowest) {
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  *lowest = HUGE_VAL;
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    double world[3], p[3];
    oracle_transform(pose, mesh->triangles[i / 3].v[i % 3], world);
    *lowest = fmin(*lowest, world[2]);
    world[2] = 0;
    draw_project(&picture_view, world, p);
    least = fmin(least, p[2]);
    most = fmax(most, p[2]);
  }
  *depth = 0.35 * least + 0.65 * most;
}
// Back to front: what of the fixed mesh lies behind the moving one, the silhouettes, the moving
// body at the time of contact or else at the end, the rest of the fixed mesh, the mark.
static void picture_scene(FILE *svg, const oracle_mesh *moving, const oracle_mesh *fixed,
                          const picture_panel *panel) {
  const nsvcd_answer *a = &panel->answer;
  const int is_free = a->verdict == NSVCD_FREE;
  const draw_colour *colour = is_free ? &draw_green : &draw_red;
  const size_t last = panel->count - 1;
  const size_t shown = is_free ? last : (size_t)((double)a->nearest.time * (double)last + 0.5);
  const oracle_pose pose = pose_widened(&panel->poses[shown]);
  double depth, lowest;
  picture_shadow(svg, fixed, &picture_origin);
  picture_shadow(svg, moving, &pose);
  picture_stand(moving, &pose, &depth, &lowest);
  picture_fixed(svg, fixed, depth, lowest, 0);
  for (size_t i = 0; i < PICTURE_GHOSTS; i++) {
    const size_t at = i * last / (PICTURE_GHOSTS - 1);
    if (at != shown)
      picture_ghost(svg, moving, &panel->poses[at], colour, 1 - (double)at / (double)last);
  }
  picture_path(svg, panel, is_free ? "#12824c" : "#b3202c");
  draw_list list = {&picture_view, NULL, 0, 0, 0};
  draw_solid(&list, moving, &pose, colour, 1);
  draw_flush(svg, &list);
  picture_fixed(svg, fixed, depth, lowest, 1);
  if (a->contact_count > 0) picture_contact(svg, panel);
}

// Name and verdict above, facts below.
static void picture_captions(FILE *svg, const picture_panel *panel) {
  const nsvcd_answer *a = &panel->answer;
  const int is_free = a->verdict == NSVCD_FREE;
  const char *const says[3] = {"MAY HIT IT", "CLEARS IT", "HITS THE RACK"};  // by verdict
  const int pill = is_free ? 130 : 170;
  fprintf(
      svg,
      "<text x=\"24\" y=\"41\" font-size=\"20\" font-weight=\"600\" fill=\"#2b3440\">%s</text>\n",
      panel->name);
  fprintf(svg, "<rect x=\"%d\" y=\"18\" width=\"%d\" height=\"34\" rx=\"17\" fill=\"%s\"/>\n",
          PICTURE_WIDTH - 20 - pill, pill, is_free ? "#12824c" : "#b3202c");
  fprintf(svg,
          "<text x=\"%d\" y=\"41\" font-size=\"16\" font-weight=\"700\" fill=\"#fff\" "
          "text-anchor=\"middle\">%s</text>\n",
          PICTURE_WIDTH - 20 - pill / 2, says[a->verdict]);
  fprintf(svg, "<rect y=\"%d\" width=\"%d\" height=\"44\" fill=\"#fff\" fill-opacity=\".9\"/>\n",
          PICTURE_HEIGHT - 44, PICTURE_WIDTH);
  fprintf(svg, "<text x=\"24\" y=\"%d\" font-size=\"15\" fill=\"#4a5564\">", PICTURE_HEIGHT - 17);
  if (!is_free) fprintf(svg, "first at t = %.2f of the way, ", (double)a->nearest.time);
  if (is_free) {
    fprintf(svg, "certified free");
  } else if (a->contact_count > 0) {
    fprintf(svg, "triangle %lu meets triangle %lu", (unsigned long)a->nearest.triangle_a,
            (unsigned long)a->nearest.triangle_b);
  } else {
    fprintf(svg, "%s", a->inside ? "inside" : "undecided");
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
  const int height = PICTURE_TOP + PICTURE_HEIGHT + 56;
  FILE *svg = draw_open(path, 24 + (PICTURE_WIDTH + 24) * count, height,
                        "Does the mug, carried along this path, hit the dish rack?",
                        "neuralsvcd.h: each mesh encoded once, each motion answered by one query");
  if (!svg) return 0;
  oracle_mesh a = picture_mesh(moving);
  oracle_mesh b = picture_mesh(fixed);
  for (int i = 0; i < count; i++) {
    draw_panel(svg, 24 + (PICTURE_WIDTH + 24) * i, PICTURE_TOP, &picture_view);
    picture_table(svg);
    picture_scene(svg, &a, &b, &panels[i]);
    picture_captions(svg, &panels[i]);
    draw_panel_end(svg, &picture_view, "");
  }
  picture_legend(svg, 26, height - 22);
  oracle_mesh_free(&a);
  oracle_mesh_free(&b);
  return draw_close(svg);
}

#endif
