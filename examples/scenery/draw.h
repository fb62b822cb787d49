// draw.h - draws scenes of tasks.h as SVG: what stands still, the robot at any number of
// configurations, solid or as ghosts, lines that things move along, panels side by side, frames one
// after the other.
//
// A parallel projection, nearer triangles over farther ones; long triangles are cut up, as
// otherwise a wall would have only one depth. One panel:
//
//   FILE *svg = draw_open("scene.svg", 800, 600, "title", "what is to be seen");
//   draw_panel(svg, 20, 84, &view);
//   draw_list list = {&view, NULL, 0, 0, 0};
//   draw_floor(&list, &scene), draw_flush(svg, &list);  // first, as everything stands on it
//   draw_still(&list, &scene), draw_robot(&list, &scene, joints, &draw_blue, &draw_orange, 1);
//   draw_flush(svg, &list);
//   draw_panel_end(svg, &view, "caption");
//   draw_close(svg);
#ifndef NSVCD_SCENERY_DRAW_H
#define NSVCD_SCENERY_DRAW_H

#include "tasks.h"

#define DRAW_DEF SHAPES_DEF
#define DRAW_INK "#1b2430"

// -------------------------------------------------------------------------------------- projection

typedef struct draw_view {
  double azimuth, elevation;  // radians: where the camera stands, seen from what it looks at
  double look_at[3];          // metres; in the middle of the panel
  double scale;               // pixels per metre
  int width, height;          // pixels
  double cut;                 // metres: edges longer than this are cut up
} draw_view;

typedef struct draw_colour {
  double dark[3], bright[3];
} draw_colour;

static const draw_colour draw_steel = {{92, 104, 120}, {222, 228, 236}};
static const draw_colour draw_iron = {{30, 36, 46}, {128, 138, 152}};
static const draw_colour draw_china = {{138, 150, 170}, {250, 252, 255}};
static const draw_colour draw_cream = {{168, 150, 120}, {252, 244, 226}};
static const draw_colour draw_rock = {{120, 112, 104}, {206, 198, 188}};
static const draw_colour draw_wood = {{112, 76, 40}, {214, 172, 118}};
static const draw_colour draw_blue = {{20, 60, 120}, {150, 190, 240}};
static const draw_colour draw_green = {{12, 92, 54}, {132, 222, 160}};
static const draw_colour draw_orange = {{160, 70, 8}, {255, 190, 110}};

typedef struct draw_triangle {
  double corners[3][2];  // pixels
  double depth;          // of the middle, metres; greater is nearer
  double light;          // 0 dark to 1 bright
  double opacity;
  const draw_colour *colour;
} draw_triangle;

typedef struct draw_list {
  const draw_view *view;
  draw_triangle *triangles;
  size_t count, capacity;
  int failed;  // no memory
} draw_list;

// World to the panel: x to the right and y down in pixels, z towards the viewer in metres.
DRAW_DEF void draw_project(const draw_view *view, const double *world, double *out) {
  double ca = cos(view->azimuth);
  double sa = sin(view->azimuth);
  double ce = cos(view->elevation);
  double se = sin(view->elevation);
  double p[3];
  oracle_sub(world, view->look_at, p);
  out[0] = view->width / 2.0 + view->scale * (-sa * p[0] + ca * p[1]);
  out[1] = view->height / 2.0 - view->scale * (-se * (ca * p[0] + sa * p[1]) + ce * p[2]);
  out[2] = ce * (ca * p[0] + sa * p[1]) + se * p[2];
}

// --------------------------------------------------------------------------------------- triangles

DRAW_DEF void draw_push(draw_list *list, const draw_triangle *triangle) {
  if (list->count == list->capacity) {
    size_t capacity = list->capacity ? 2 * list->capacity : 1024;
    draw_triangle *grown = (draw_triangle *)realloc(list->triangles, capacity * sizeof *grown);
    if (!grown) {
      list->failed = 1;
      return;
    }
    list->triangles = grown;
    list->capacity = capacity;
  }
  list->triangles[list->count++] = *triangle;
}
// Halves the longest edge until none is longer than view->cut.
DRAW_DEF void draw_split(draw_list *list, const double (*world)[3], draw_triangle *triangle) {
  double longest = 0;
  double d[3];
  double depth = 0;
  int edge = 0;
  for (int i = 0; i < 3; i++) {
    oracle_sub(world[(i + 1) % 3], world[i], d);
    if (oracle_length(d) > longest) {
      longest = oracle_length(d);
      edge = i;
    }
  }
  if (longest > list->view->cut) {
    double a[3][3], b[3][3];
    memcpy(a, world, sizeof a);
    memcpy(b, world, sizeof b);
    for (int k = 0; k < 3; k++)
      a[edge][k] = b[(edge + 1) % 3][k] = (world[edge][k] + world[(edge + 1) % 3][k]) / 2;
    draw_split(list, (const double(*)[3])a, triangle);
    draw_split(list, (const double(*)[3])b, triangle);
    return;
  }
  for (int i = 0; i < 3; i++) {
    double p[3];
    draw_project(list->view, world[i], p);
    triangle->corners[i][0] = p[0];
    triangle->corners[i][1] = p[1];
    depth += p[2] / 3;
  }
  triangle->depth = depth;
  draw_push(list, triangle);
}
DRAW_DEF void draw_body(draw_list *list, const task_body *body, const oracle_pose *pose,
                        const draw_colour *colour, double opacity) {
  const double to_light[3] = {0.35, -0.45, 0.82};
  const draw_view *view = list->view;
  const double to_viewer[3] = {cos(view->elevation) * cos(view->azimuth),
                               cos(view->elevation) * sin(view->azimuth), sin(view->elevation)};
  for (size_t i = 0; i < body->exact.triangle_count; i++) {
    const oracle_triangle *t = &body->exact.triangles[i];
    draw_triangle triangle = {{{0, 0}, {0, 0}, {0, 0}}, 0, 0, opacity, colour};
    double world[3][3], m[9], normal[3];
    oracle_matrix(pose->rotation, m);
    oracle_rotate(m, t->normal, normal);
    if (oracle_dot(normal, to_viewer) <= 0)
      continue;  // seen from inside
    for (int k = 0; k < 3; k++)
      oracle_transform(pose, t->v[k], world[k]);
    triangle.light = 0.5 + 0.5 * oracle_dot(normal, to_light);
    draw_split(list, (const double(*)[3])world, &triangle);
  }
}
// A foot that does not travel, a torso.
DRAW_DEF int draw_is_fixed(const task_scene *scene, const task_body *body) {
  return body->kind == TASK_ROBOT && body->link <= scene->foot && !scene->joints[0].slides;
}
DRAW_DEF void draw_floor(draw_list *list, const task_scene *scene) {
  for (int i = 0; i < scene->body_count; i++)
    if (scene->bodies[i].kind == TASK_FLOOR)
      draw_body(list, &scene->bodies[i], &scene->bodies[i].offset, &draw_cream, 1);
}
// What stands still on it; rock towards the viewer is left out, as it would hide what goes on
// behind it.
DRAW_DEF void draw_still(draw_list *list, const task_scene *scene) {
  for (int i = 0; i < scene->body_count; i++) {
    const task_body *body = &scene->bodies[i];
    int rock = strstr(body->name, "rock") && !strstr(body->name, "heap");
    double center[3];
    oracle_transform(&body->offset, body->exact.center, center);
    if (draw_is_fixed(scene, body))
      draw_body(list, body, &body->offset, &draw_steel, 1);
    if (body->kind != TASK_SCENE)
      continue;
    if (rock && center[1] * sin(list->view->azimuth) > 0)
      continue;
    int wood =
        strstr(body->name, "beam") || strstr(body->name, "frame") || strstr(body->name, "prop");
    int dark = rock || strstr(body->name, "coal") || strstr(body->name, "heap");
    const draw_colour *colour = wood                          ? &draw_wood
                                : dark                        ? &draw_rock
                                : strstr(body->name, "wagon") ? &draw_steel
                                : !strcmp(body->name, "rack") ? &draw_iron
                                                              : &draw_china;
    draw_body(list, body, &body->offset, colour, 1);
  }
}
// The robot and what it holds. Opacity below 1 makes a ghost.
DRAW_DEF void draw_robot(draw_list *list, const task_scene *scene, const float *joints,
                         const draw_colour *robot, const draw_colour *held, double opacity) {
  double q[TASK_MAX_JOINTS];
  oracle_pose links[TASK_MAX_JOINTS + 1];
  for (int j = 0; j < scene->joint_count; j++)
    q[j] = (double)joints[j];
  task_links(scene, q, links);
  for (int i = 0; i < scene->body_count; i++) {
    oracle_pose pose = task_body_pose(scene, i, links);
    const task_body *body = &scene->bodies[i];
    if (!task_moves(body) || draw_is_fixed(scene, body))
      continue;
    const draw_colour *colour = body->kind == TASK_ROBOT      ? robot
                                : strcmp(body->name, "block") ? held
                                                              : &draw_wood;
    draw_body(list, body, &pose, colour, opacity);
  }
}
DRAW_DEF int draw_compare(const void *a, const void *b) {
  double x = ((const draw_triangle *)a)->depth;
  double y = ((const draw_triangle *)b)->depth;
  return (x > y) - (x < y);
}
// Draws the list, the farthest first, and empties it.
DRAW_DEF void draw_flush(FILE *svg, draw_list *list) {
  unsigned before = 0;  // a fill that triangles before this one have
  if (list->count)
    qsort(list->triangles, list->count, sizeof *list->triangles, draw_compare);
  for (size_t i = 0; i < list->count; i++) {
    const draw_triangle *t = &list->triangles[i];
    unsigned fill = (unsigned)(100 * t->opacity) << 24;
    // steps that the eye does not see: neighbours become one path
    double light = floor(32 * t->light) / 32;
    for (int k = 0; k < 3; k++)
      fill |= (unsigned)(t->colour->dark[k] + light * (t->colour->bright[k] - t->colour->dark[k]))
              << (16 - 8 * k);
    if (fill != before) {
      fprintf(svg, "%s<path fill=\"#%06x\"", i ? "\"/>\n" : "", fill & 0xffffffu);
      if (t->opacity < 1)
        fprintf(svg, " fill-opacity=\"%.2f\" shape-rendering=\"crispEdges\" d=\"", t->opacity);
      else  // the thin edge of the same colour hides the seams
        fprintf(svg, " stroke-width=\".6\" stroke=\"#%06x\" d=\"", fill & 0xffffffu);
    }
    before = fill;
    fprintf(svg, "M%.1f %.1fL%.1f %.1fL%.1f %.1fZ", t->corners[0][0], t->corners[0][1],
            t->corners[1][0], t->corners[1][1], t->corners[2][0], t->corners[2][1]);
  }
  if (list->count)
    fprintf(svg, "\"/>\n");
  free(list->triangles);
  list->triangles = NULL;
  list->count = list->capacity = 0;
}
// The line along which the origin of `body` moves. joints: (samples, joint_count).
DRAW_DEF void draw_trace(FILE *svg, const draw_view *view, const task_scene *scene, int body,
                         const float *joints, int samples, const char *ink) {
  fprintf(svg,
          "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2.5\" stroke-linejoin=\"round\" d=\"",
          ink);
  for (int s = 0; s < samples; s++) {
    double q[TASK_MAX_JOINTS], p[3];
    oracle_pose links[TASK_MAX_JOINTS + 1];
    for (int j = 0; j < scene->joint_count; j++)
      q[j] = (double)joints[s * scene->joint_count + j];
    task_links(scene, q, links);
    draw_project(view, task_body_pose(scene, body, links).position, p);
    fprintf(svg, "%s%.1f %.1f", s ? "L" : "M", p[0], p[1]);
  }
  fprintf(svg, "\"/>\n");
}

// ------------------------------------------------------------------------------------------- pages

// Returns NULL after a message if the file cannot be written.
DRAW_DEF FILE *draw_open(const char *path, int width, int height, const char *title,
                         const char *subtitle) {
  FILE *svg = fopen(path, "w");
  if (!svg) {
    fprintf(stderr, "%s: cannot be written\n", path);
    return NULL;
  }
  fprintf(
      svg,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
      "font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"%d\" height=\"%d\" "
      "fill=\"#f6f7f9\"/>\n",
      width, height, width, height, width, height);
  fprintf(svg,
          "<text x=\"24\" y=\"38\" font-size=\"24\" font-weight=\"700\" fill=\"" DRAW_INK
          "\">%s</text>\n",
          title);
  fprintf(svg, "<text x=\"24\" y=\"64\" font-size=\"15\" fill=\"#5a6675\">%s</text>\n", subtitle);
  return svg;
}
// Returns 1, or 0 after a message.
DRAW_DEF int draw_close(FILE *svg) {
  fprintf(svg, "</svg>\n");
  int good = !ferror(svg);
  if (fclose(svg) == 0 && good)
    return 1;
  return fprintf(stderr, "the picture cannot be written\n"), 0;
}
// What follows is drawn in this panel, cut off at its edges, until draw_panel_end.
DRAW_DEF void draw_panel(FILE *svg, int x, int y, const draw_view *view) {
  fprintf(svg,
          "<g transform=\"translate(%d %d)\"><clipPath id=\"panel%d-%d\"><rect width=\"%d\" "
          "height=\"%d\" rx=\"10\"/>"
          "</clipPath>\n<g clip-path=\"url(#panel%d-%d)\"><rect width=\"%d\" height=\"%d\" "
          "fill=\"#fff\"/>\n",
          x, y, x, y, view->width, view->height, x, y, view->width, view->height);
}
DRAW_DEF void draw_panel_end(FILE *svg, const draw_view *view, const char *caption) {
  fprintf(svg,
          "</g><rect width=\"%d\" height=\"%d\" rx=\"10\" fill=\"none\" stroke=\"#d5dae1\"/>\n",
          view->width, view->height);
  fprintf(svg,
          "<text x=\"16\" y=\"28\" font-size=\"16\" font-weight=\"600\" fill=\"" DRAW_INK
          "\" stroke=\"#fff\" stroke-width=\"4\" stroke-linejoin=\"round\" "
          "paint-order=\"stroke\">%s</text></g>\n",
          caption);
}
// Frame `index` of `count` of a film that repeats every `seconds`; ends with draw_frame_end.
// Viewers that do not animate show the first one.
DRAW_DEF void draw_frame(FILE *svg, int index, int count, double seconds) {
  fprintf(
      svg,
      "<g visibility=\"%s\"><animate attributeName=\"visibility\" values=\"hidden;visible;hidden\" "
      "keyTimes=\"0;%.4f;%.4f\" calcMode=\"discrete\" dur=\"%gs\" repeatCount=\"indefinite\"/>\n",
      index ? "hidden" : "visible", (double)index / count, (index + 1.0) / count, seconds);
}
DRAW_DEF void draw_frame_end(FILE *svg) { fprintf(svg, "</g>\n"); }

#endif
