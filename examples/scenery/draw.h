// draw.h - meshes as SVG: triangles at poses, solid or as ghosts, lines that things move along,
// panels side by side, frames one after the other.
//
// A parallel projection, nearer triangles over farther ones; long triangles are cut up, as
// otherwise a wall would have only one depth. One panel:
//
//   FILE *svg = draw_open("scene.svg", 800, 600, "title", "what is to be seen");
//   draw_panel(svg, 20, 84, &view);
//   draw_list list = {&view, NULL, 0, 0, 0};
//   draw_solid(&list, &floor, &pose, &draw_cream, 1), draw_flush(svg, &list);  // things stand on it
//   draw_solid(&list, &thing, &pose, &draw_blue, 1), draw_flush(svg, &list);
//   draw_panel_end(svg, &view, "caption");
//   draw_close(svg);
#ifndef NSVCD_SCENERY_DRAW_H
#define NSVCD_SCENERY_DRAW_H

#include "oracle.h"
#include "shapes.h"

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
static const draw_colour draw_red = {{132, 14, 22}, {255, 128, 116}};
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
// Can none of it be seen in the panel? corners: projected.
DRAW_DEF int draw_is_outside(const draw_view *view, const double (*corners)[3]) {
  const double size[2] = {view->width, view->height};
  for (int axis = 0; axis < 2; axis++) {
    const double a = corners[0][axis];
    const double b = corners[1][axis];
    const double c = corners[2][axis];
    if (fmax(a, fmax(b, c)) < -1 || fmin(a, fmin(b, c)) > size[axis] + 1) return 1;
  }
  return 0;
}
// Halves the longest edge until none is longer than view->cut.
DRAW_DEF void draw_split(draw_list *list, const double (*world)[3], draw_triangle *triangle) {
  double longest = 0;
  double d[3], p[3][3];
  int edge = 0;
  for (int i = 0; i < 3; i++) {
    draw_project(list->view, world[i], p[i]);
    oracle_sub(world[(i + 1) % 3], world[i], d);
    if (oracle_length(d) > longest) {
      longest = oracle_length(d);
      edge = i;
    }
  }
  if (draw_is_outside(list->view, (const double(*)[3])p)) return;
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
  triangle->depth = 0;
  for (int i = 0; i < 3; i++) {
    triangle->corners[i][0] = p[i][0];
    triangle->corners[i][1] = p[i][1];
    triangle->depth += p[i][2] / 3;
  }
  draw_push(list, triangle);
}
// One triangle, unless it is seen from inside.
DRAW_DEF void draw_one(draw_list *list, const oracle_triangle *t, const oracle_pose *pose,
                       const draw_colour *colour, double opacity) {
  const double to_light[3] = {0.35, -0.45, 0.82};
  const draw_view *view = list->view;
  const double to_viewer[3] = {cos(view->elevation) * cos(view->azimuth),
                               cos(view->elevation) * sin(view->azimuth), sin(view->elevation)};
  draw_triangle triangle = {{{0, 0}, {0, 0}, {0, 0}}, 0, 0, opacity, colour};
  double world[3][3], m[9], normal[3];
  oracle_matrix(pose->rotation, m);
  oracle_rotate(m, t->normal, normal);
  if (oracle_dot(normal, to_viewer) <= 0) return;
  for (int k = 0; k < 3; k++) oracle_transform(pose, t->v[k], world[k]);
  triangle.light = 0.5 + 0.5 * oracle_dot(normal, to_light);
  draw_split(list, (const double(*)[3])world, &triangle);
}
// Opacity below 1 makes a ghost.
DRAW_DEF void draw_solid(draw_list *list, const oracle_mesh *mesh, const oracle_pose *pose,
                         const draw_colour *colour, double opacity) {
  for (size_t i = 0; i < mesh->triangle_count; i++)
    draw_one(list, &mesh->triangles[i], pose, colour, opacity);
}
// The same, from both sides: for what is not closed, or inside out.
DRAW_DEF void draw_sheet(draw_list *list, const oracle_mesh *mesh, const oracle_pose *pose,
                         const draw_colour *colour, double opacity) {
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    oracle_triangle back = mesh->triangles[i];
    memcpy(back.v[1], mesh->triangles[i].v[2], sizeof back.v[1]);
    memcpy(back.v[2], mesh->triangles[i].v[1], sizeof back.v[2]);
    for (int k = 0; k < 3; k++) back.normal[k] = -back.normal[k];
    draw_one(list, &mesh->triangles[i], pose, colour, opacity);
    draw_one(list, &back, pose, colour, opacity);
  }
}
DRAW_DEF void draw_shape(draw_list *list, const shapes_mesh *shape, double scale,
                         const oracle_pose *pose, const draw_colour *colour) {
  oracle_mesh mesh;
  list->failed |= !oracle_mesh_init(&mesh, shape->positions, shape->vertices, shape->indices,
                                    shape->triangles, scale);
  if (list->failed) return;
  draw_solid(list, &mesh, pose, colour, 1);
  oracle_mesh_free(&mesh);
}
DRAW_DEF int draw_compare(const void *a, const void *b) {
  double x = ((const draw_triangle *)a)->depth;
  double y = ((const draw_triangle *)b)->depth;
  return (x > y) - (x < y);
}
// Draws the list, the farthest first, and empties it.
DRAW_DEF void draw_flush(FILE *svg, draw_list *list) {
  unsigned before = 0;  // a fill that triangles before this one have
  if (list->count) qsort(list->triangles, list->count, sizeof *list->triangles, draw_compare);
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
  if (list->count) fprintf(svg, "\"/>\n");
  free(list->triangles);
  list->triangles = NULL;
  list->count = list->capacity = 0;
}
// In the `d` of a path: to this point, or, the first, from it.
DRAW_DEF void draw_to(FILE *svg, const draw_view *view, int first, const double *world) {
  double p[3];
  draw_project(view, world, p);
  fprintf(svg, "%s%.1f %.1f", first ? "M" : "L", p[0], p[1]);
}

// ------------------------------------------------------------------------------------------- pages

// May a picture be written there? Not over what is there and is none: it may be an input, by
// whatever name. Returns 0 after a message.
DRAW_DEF int draw_may_write(const char *path) {
  char begin[4] = "";
  FILE *file = fopen(path, "rb");
  const size_t size = file ? fread(begin, 1, sizeof begin, file) : 0;
  if (file) fclose(file);
  if (size == 0 || memcmp(begin, "<svg", 4) == 0 || memcmp(begin, "<?xm", 4) == 0) return 1;
  return fprintf(stderr, "%s: is there already, and is no SVG\n", path), 0;
}

// Returns NULL after a message if the file cannot be written.
DRAW_DEF FILE *draw_open(const char *path, int width, int height, const char *title,
                         const char *subtitle) {
  if (!draw_may_write(path)) return NULL;
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
  if (fclose(svg) == 0 && good) return 1;
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
DRAW_DEF void draw_frame_end(FILE *svg) {
  fprintf(svg, "</g>\n");
}

#endif
