// draw.h - meshes as SVG: triangles at poses, solid or as ghosts, lines that things move along,
// panels side by side, frames one after the other.
//
// A parallel projection. What is nearest is found sample by sample, and what is written are the
// outlines of what has one colour: so a picture grows with what is seen, not with triangles. One
// panel:
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
  double corners[3][3];  // pixels; depth in metres, greater is nearer
  double light;          // 0 dark to 1 bright
  double opacity;        // below 1: a ghost
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
// One triangle, unless it is seen from inside.
DRAW_DEF void draw_one(draw_list *list, const oracle_triangle *t, const oracle_pose *pose,
                       const draw_colour *colour, double opacity) {
  const double to_light[3] = {0.35, -0.45, 0.82};
  const draw_view *view = list->view;
  const double to_viewer[3] = {cos(view->elevation) * cos(view->azimuth),
                               cos(view->elevation) * sin(view->azimuth), sin(view->elevation)};
  draw_triangle triangle = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, 0, opacity, colour};
  double world[3], m[9], normal[3];
  oracle_matrix(pose->rotation, m);
  oracle_rotate(m, t->normal, normal);
  if (oracle_dot(normal, to_viewer) <= 0) return;
  for (int k = 0; k < 3; k++) {
    oracle_transform(pose, t->v[k], world);
    draw_project(view, world, triangle.corners[k]);
  }
  triangle.light = 0.5 + 0.5 * oracle_dot(normal, to_light);
  if (!draw_is_outside(view, (const double(*)[3])triangle.corners)) draw_push(list, &triangle);
}
// Opacity below 1 makes a ghost.
DRAW_DEF void draw_solid(draw_list *list, const oracle_mesh *mesh, const oracle_pose *pose,
                         const draw_colour *colour, double opacity) {
  for (size_t i = 0; i < mesh->triangle_count; i++)
    draw_one(list, &mesh->triangles[i], pose, colour, opacity);
}
// Lists a mesh to be seen from both sides, as one is that is not closed, or inside out.
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

// ------------------------------------------------------------------------------------ what is seen

#define DRAW_SAMPLES 2  // a pixel, along each axis
#define DRAW_STEPS 24   // steps of light: more the eye does not see

// What is seen at each sample: the fill, 0 for nothing, and how near it is.
typedef struct draw_raster {
  int width, height;
  uint32_t *fills;  // (height, width)
  float *depths;
} draw_raster;

DRAW_DEF uint32_t draw_fill(const draw_triangle *t) {
  uint32_t fill = 1u << 24;  // so that black is something
  const double light = floor(DRAW_STEPS * t->light) / DRAW_STEPS;
  for (int k = 0; k < 3; k++)
    fill |= (uint32_t)(t->colour->dark[k] + light * (t->colour->bright[k] - t->colour->dark[k]))
            << (16 - 8 * k);
  return fill;
}

// Twice the area of abc, in pixels.
DRAW_DEF double draw_area(const double *a, const double *b, double x, double y) {
  return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

DRAW_DEF void draw_fill_in(draw_raster *r, const draw_triangle *t) {
  const double(*p)[3] = (const double(*)[3])t->corners;
  const uint32_t fill = draw_fill(t);
  const double area = draw_area(p[0], p[1], p[2][0], p[2][1]);
  const int size[2] = {r->width, r->height};
  int first[2], last[2];
  if (fabs(area) < 1e-9) return;
  for (int axis = 0; axis < 2; axis++) {
    const double low = fmin(p[0][axis], fmin(p[1][axis], p[2][axis]));
    const double high = fmax(p[0][axis], fmax(p[1][axis], p[2][axis]));
    first[axis] = (int)fmax(0, floor(DRAW_SAMPLES * low));
    last[axis] = (int)fmin(size[axis] - 1, floor(DRAW_SAMPLES * high));
  }
  for (int y = first[1]; y <= last[1]; y++)
    for (int x = first[0]; x <= last[0]; x++) {
      const double at[2] = {(x + 0.5) / DRAW_SAMPLES, (y + 0.5) / DRAW_SAMPLES};
      const double u = draw_area(p[1], p[2], at[0], at[1]) / area;
      const double v = draw_area(p[2], p[0], at[0], at[1]) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      const size_t sample = (size_t)y * (size_t)r->width + (size_t)x;
      const float depth = (float)(u * p[0][2] + v * p[1][2] + (1 - u - v) * p[2][2]);
      if (depth <= r->depths[sample]) continue;
      r->depths[sample] = depth;
      r->fills[sample] = fill;
    }
}

// The fill of a sample; 0 beside the picture.
DRAW_DEF uint32_t draw_at(const draw_raster *r, int x, int y) {
  if (x < 0 || y < 0 || x >= r->width || y >= r->height) return 0;
  return r->fills[(size_t)y * (size_t)r->width + (size_t)x];
}

// A sample that none beside it is like becomes like the one on its left: a speck costs as much as a
// wall.
DRAW_DEF void draw_despeckle(draw_raster *r) {
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++) {
      const uint32_t fill = draw_at(r, x, y);
      const uint32_t beside = draw_at(r, x - 1, y);
      if (beside && fill && beside != fill && draw_at(r, x + 1, y) != fill &&
          draw_at(r, x, y - 1) != fill && draw_at(r, x, y + 1) != fill)
        r->fills[(size_t)y * (size_t)r->width + (size_t)x] = beside;
    }
}

// ----------------------------------------------------------------------------------- its outlines

typedef struct draw_outline {
  uint32_t fill;
  size_t first, count;  // points
} draw_outline;

typedef struct draw_outlines {
  draw_outline *all;
  int (*points)[2];  // corners, in half samples
  size_t count, point_count, room, point_room;
  int failed;  // no memory
} draw_outlines;

DRAW_DEF void draw_put(draw_outlines *out, int x, int y) {
  if (out->point_count == out->point_room) {
    const size_t room = out->point_room ? 2 * out->point_room : 4096;
    int(*grown)[2] = (int(*)[2])realloc(out->points, room * sizeof *grown);
    out->failed |= !grown;
    if (!grown) return;
    out->points = grown;
    out->point_room = room;
  }
  out->points[out->point_count][0] = x;
  out->points[out->point_count++][1] = y;
}

// Goes once about a part of one fill, which lies on the right, from the top of a sample; through the
// middles of the samples' sides, so that a slope is no staircase. done: tops that were passed.
DRAW_DEF void draw_follow(const draw_raster *r, int left, int top, char *done, draw_outlines *out) {
  static const int steps[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  static const int aheads[4][2] = {
      {0, 0}, {-1, 0}, {-1, -1}, {0, -1}};  // the sample on the right of a corner
  const uint32_t fill = draw_at(r, left, top);
  int x = left;
  int y = top;
  int way = 0;
  do {
    if (way == 0) done[(size_t)y * (size_t)r->width + (size_t)x] = 1;
    draw_put(out, 2 * x + steps[way][0], 2 * y + steps[way][1]);
    x += steps[way][0];
    y += steps[way][1];
    const int *right = aheads[way];
    const int *ahead = aheads[(way + 3) % 4];  // beyond it, on the left
    if (draw_at(r, x + right[0], y + right[1]) != fill)
      way = (way + 1) % 4;
    else if (draw_at(r, x + ahead[0], y + ahead[1]) == fill)
      way = (way + 3) % 4;
  } while (x != left || y != top || way != 0);
}

// Leaves out the points between two that are no farther from the line than 0.6 samples (Douglas and
// Peucker 1973). Those that stay move to the front; returns how many, without the last.
DRAW_DEF size_t draw_thin(int (*p)[2], size_t count) {
  const double dx = p[count - 1][0] - p[0][0];
  const double dy = p[count - 1][1] - p[0][1];
  const double length = hypot(dx, dy);
  double farthest = 1.2;
  size_t at = 0;
  for (size_t i = 1; i + 1 < count; i++) {
    const double x = p[i][0] - p[0][0];
    const double y = p[i][1] - p[0][1];
    const double away = length > 0 ? fabs(dx * y - dy * x) / length : hypot(x, y);
    if (away <= farthest) continue;
    farthest = away;
    at = i;
  }
  if (at == 0) return 1;
  const size_t first = draw_thin(p, at + 1);
  const size_t second = draw_thin(p + at, count - at);
  memmove(p + first, p + at, second * sizeof *p);
  return first + second;
}

DRAW_DEF int draw_compare(const void *a, const void *b) {
  const draw_outline *x = (const draw_outline *)a;
  const draw_outline *y = (const draw_outline *)b;
  if (x->fill != y->fill) return x->fill < y->fill ? -1 : 1;
  return x->first < y->first ? -1 : 1;
}

// Finds all outlines, by their fills. Returns 0 without memory.
DRAW_DEF int draw_find_outlines(const draw_raster *r, draw_outlines *out) {
  char *done = (char *)calloc((size_t)r->width * (size_t)r->height, 1);
  memset(out, 0, sizeof *out);
  for (int y = 0; y < r->height && done && !out->failed; y++)
    for (int x = 0; x < r->width && !out->failed; x++) {
      const uint32_t fill = draw_at(r, x, y);
      if (!fill || draw_at(r, x, y - 1) == fill || done[(size_t)y * (size_t)r->width + (size_t)x])
        continue;
      const size_t first = out->point_count;
      draw_follow(r, x, y, done, out);
      draw_put(out, 2 * x + 1, 2 * y);  // closes it
      if (out->failed) break;
      out->point_count = first + draw_thin(out->points + first, out->point_count - first);
      if (out->point_count - first < 3) out->point_count = first;
      if (out->point_count == first) continue;
      if (out->count == out->room) {
        out->room = out->room ? 2 * out->room : 256;
        draw_outline *grown = (draw_outline *)realloc(out->all, out->room * sizeof *grown);
        out->failed |= !grown;
        if (!grown) break;
        out->all = grown;
      }
      const draw_outline outline = {fill, first, out->point_count - first};
      out->all[out->count++] = outline;
    }
  if (out->count) qsort(out->all, out->count, sizeof *out->all, draw_compare);
  free(done);
  return done && !out->failed;
}

// A path for each fill; a thin edge of the same colour hides the seams.
DRAW_DEF void draw_write(FILE *svg, const draw_outlines *out, double opacity) {
  uint32_t before = 0;
  fprintf(svg, "<g transform=\"scale(%g)\" fill=\"currentColor\" stroke=\"currentColor\"",
          0.5 / DRAW_SAMPLES);
  if (opacity < 1) fprintf(svg, " opacity=\"%.2f\"", opacity);
  fprintf(svg, " stroke-width=\"%g\" stroke-linejoin=\"round\">\n", 1.6 * DRAW_SAMPLES);
  for (size_t n = 0; n < out->count; n++) {
    const draw_outline *outline = &out->all[n];
    const int(*p)[2] = (const int(*)[2])out->points + outline->first;
    if (outline->fill != before)
      fprintf(svg, "%s<path color=\"#%06lx\" d=\"", before ? "\"/>\n" : "",
              (unsigned long)(outline->fill & 0xffffffu));
    before = outline->fill;
    fprintf(svg, "M%d %dl", p[0][0], p[0][1]);
    for (size_t i = 1; i < outline->count; i++)
      for (int k = 0; k < 2; k++) {
        const int step = p[i][k] - p[i - 1][k];
        fprintf(svg, step < 0 || (i == 1 && k == 0) ? "%d" : " %d", step);
      }
    fputs("z", svg);
  }
  fprintf(svg, "%s</g>\n", before ? "\"/>\n" : "");
}

// Draws the list, and empties it: what is opaque, then the ghosts, those of one opacity together,
// where nothing opaque is before them.
DRAW_DEF void draw_flush(FILE *svg, draw_list *list) {
  draw_raster r = {DRAW_SAMPLES * list->view->width, DRAW_SAMPLES * list->view->height, NULL, NULL};
  const size_t samples = (size_t)r.width * (size_t)r.height;
  float *opaque = (float *)malloc(samples * sizeof *opaque);
  r.fills = (uint32_t *)malloc(samples * sizeof *r.fills);
  r.depths = (float *)malloc(samples * sizeof *r.depths);
  list->failed |= !opaque || !r.fills || !r.depths;
  for (size_t i = 0; i < samples && !list->failed; i++) opaque[i] = -HUGE_VALF;
  for (double opacity = 1; opacity > 0 && !list->failed;) {
    double next = 0;  // the greatest that is less
    draw_outlines outlines;
    memset(r.fills, 0, samples * sizeof *r.fills);
    memcpy(r.depths, opaque, samples * sizeof *r.depths);
    for (size_t i = 0; i < list->count; i++) {
      const draw_triangle *t = &list->triangles[i];
      if (t->opacity < opacity) next = fmax(next, t->opacity);
      if (t->opacity >= opacity && (t->opacity <= opacity || opacity >= 1)) draw_fill_in(&r, t);
    }
    if (opacity >= 1) memcpy(opaque, r.depths, samples * sizeof *opaque);
    draw_despeckle(&r);
    list->failed |= !draw_find_outlines(&r, &outlines);
    if (outlines.count && !list->failed) draw_write(svg, &outlines, opacity);
    free(outlines.all);
    free(outlines.points);
    opacity = next;
  }
  free(opaque);
  free(r.fills);
  free(r.depths);
  free(list->triangles);
  list->triangles = NULL;
  list->count = list->capacity = 0;
}
// Writes a point into the `d` of a path: the first begins the path, others are drawn to.
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
// Begins a panel: until draw_panel_end, all is drawn in it, cut off at its edges.
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
