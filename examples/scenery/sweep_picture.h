// sweep_picture.h - a question and its answer as a picture (SVG, draw.h): B, which rests; A at the
// start, where it was stopped or comes closest, and at the end; its path; the place of contact.
#ifndef NSVCD_SCENERY_SWEEP_PICTURE_H
#define NSVCD_SCENERY_SWEEP_PICTURE_H

#include "draw.h"

typedef struct sweep_body {
  const char *name;
  oracle_mesh mesh;  // metres
  int sheet;         // 1: it is seen from both sides
  double pale;       // opacity at the start and at the end
} sweep_body;

typedef struct sweep_picture {
  sweep_body a, b;
  const char *title, *verdict;
  const oracle_pose *poses;  // (count) of a
  size_t count;
  int collides;
  double shown;          // time at which a is drawn solid
  const char *shown_as;  // "contact"; "": at the start or the end
  const float *point;    // the contact's, or NULL
  const float *normal;
} sweep_picture;

#define SWEEP_WIDTH 912  // pixels of the panel
#define SWEEP_HEIGHT 600
#define SWEEP_LEFT 24
#define SWEEP_TOP 84
#define SWEEP_EDGE 56   // pixels left free in the panel
#define SWEEP_STEPS 32  // steps of the path, at least
#define SWEEP_NAME 512

// Text for XML; bytes that XML cannot have become '?'.
static const char *sweep_escape(const char *text, char *out, size_t size) {
  size_t n = 0;
  for (; *text && n + 8 < size; text++) {
    const unsigned char c = (unsigned char)*text;
    const char *entity = c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : NULL;
    if (entity) {
      memcpy(out + n, entity, strlen(entity));
      n += strlen(entity);
    } else {
      out[n++] = c < 32 ? '?' : (char)c;
    }
  }
  out[n] = 0;
  return out;
}

// ---------------------------------------------------------------------------------------- the view

// Turns the view: along the path of A's middle, left to right, a little from its start and from
// above.
static void sweep_camera(const sweep_picture *p, draw_view *view) {
  double from[3], to[3], d[3];
  oracle_transform(&p->poses[0], p->a.mesh.center, from);
  oracle_transform(&p->poses[p->count - 1], p->a.mesh.center, to);
  oracle_sub(to, from, d);
  view->elevation = 0.35;
  view->azimuth = -0.9;
  if (hypot(d[0], d[1]) > 0.3 * oracle_length(d))
    view->azimuth = atan2(d[1], d[0]) - SHAPES_PI / 2 - 0.2;
}

typedef struct sweep_frame {  // a box in pixels, before the view is fitted
  double low[2], high[2];
} sweep_frame;

static void sweep_widen(sweep_frame *frame, const draw_view *view, const double *world) {
  double q[3];
  draw_project(view, world, q);
  for (int k = 0; k < 2; k++) {
    frame->low[k] = fmin(frame->low[k], q[k]);
    frame->high[k] = fmax(frame->high[k], q[k]);
  }
}

static void sweep_corner(const double *low, const double *high, int i, double *out) {
  for (int k = 0; k < 3; k++) out[k] = i >> k & 1 ? high[k] : low[k];
}

// Steps of the path: as many between any two poses.
static size_t sweep_steps(const sweep_picture *p) {
  const size_t stretches = p->count > 1 ? p->count - 1 : 1;
  return stretches * ((SWEEP_STEPS + stretches - 1) / stretches);
}

// The box of all places that A comes to, about.
static void sweep_reach(const sweep_picture *p, double *low, double *high) {
  double corner[3], world[3];
  for (int k = 0; k < 3; k++) {
    low[k] = HUGE_VAL;
    high[k] = -HUGE_VAL;
  }
  const size_t steps = sweep_steps(p);
  for (size_t i = 0; i < 8 * (steps + 1); i++) {
    const double t = (double)(i / 8) / (double)steps;
    const oracle_pose pose = oracle_pose_at(p->poses, p->count, t);
    sweep_corner(p->a.mesh.low, p->a.mesh.high, (int)(i % 8), corner);
    oracle_transform(&pose, corner, world);
    for (int k = 0; k < 3; k++) {
      low[k] = fmin(low[k], world[k]);
      high[k] = fmax(high[k], world[k]);
    }
  }
}

// Scale, size and middle of a view, so that the frame is in a panel, but for its edge.
static void sweep_fit_frame(const sweep_frame *frame, int width, int height, int edge,
                            draw_view *view) {
  const double wide = fmax(frame->high[0] - frame->low[0], 1e-12);
  const double tall = fmax(frame->high[1] - frame->low[1], 1e-12);
  const double right = (frame->low[0] + frame->high[0]) / 2;
  const double up = -(frame->low[1] + frame->high[1]) / 2;
  view->width = width;
  view->height = height;
  view->scale = fmin((width - 2 * edge) / wide, (height - 2 * edge) / tall);
  const double ca = cos(view->azimuth);
  const double sa = sin(view->azimuth);
  view->look_at[0] = -sa * right - sin(view->elevation) * ca * up;
  view->look_at[1] = ca * right - sin(view->elevation) * sa * up;
  view->look_at[2] = cos(view->elevation) * up;
}

// The view in which all of A's way fits into the panel, and all of B; if B is much larger, what is
// near by.
static draw_view sweep_fit(const sweep_picture *p) {
  draw_view view = {0, 0, {0, 0, 0}, 1, 0, 0};
  sweep_frame frame = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  double low[3], high[3], corner[3];
  double extent = 0;
  sweep_camera(p, &view);
  sweep_reach(p, low, high);
  for (int k = 0; k < 3; k++) extent = fmax(extent, high[k] - low[k]);
  const double near_by = p->b.mesh.radius < 2 * extent ? HUGE_VAL : extent / 3;
  for (int i = 0; i < 8; i++) {
    sweep_corner(low, high, i, corner);
    sweep_widen(&frame, &view, corner);
    sweep_corner(p->b.mesh.low, p->b.mesh.high, i, corner);
    for (int k = 0; k < 3; k++)
      corner[k] = fmax(low[k] - near_by, fmin(high[k] + near_by, corner[k]));
    sweep_widen(&frame, &view, corner);
  }
  sweep_fit_frame(&frame, SWEEP_WIDTH, SWEEP_HEIGHT, SWEEP_EDGE, &view);
  return view;
}

// ------------------------------------------------------------------------------------------- parts

static void sweep_body_at(draw_list *list, const sweep_body *body, const oracle_pose *pose,
                          const draw_colour *colour, double opacity) {
  (body->sheet ? draw_sheet : draw_solid)(list, &body->mesh, pose, colour, opacity);
}

// Above a body, or, where it moves up or down, to the left of it.
static void sweep_label(FILE *svg, const draw_view *view, const sweep_picture *p,
                        const oracle_pose *pose, const char *text) {
  sweep_frame frame = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  double world[3], from[3], to[3];
  for (size_t i = 0; i < 3 * p->a.mesh.triangle_count; i++) {
    oracle_transform(pose, p->a.mesh.triangles[i / 3].v[i % 3], world);
    sweep_widen(&frame, view, world);
  }
  draw_project(view, p->poses[0].position, from);
  draw_project(view, p->poses[p->count - 1].position, to);
  const int beside = fabs(to[1] - from[1]) > fabs(to[0] - from[0]);
  const double x = beside ? frame.low[0] - 8 : (frame.low[0] + frame.high[0]) / 2;
  const double y = beside ? (frame.low[1] + frame.high[1]) / 2 : frame.low[1] - 8;
  fprintf(svg,
          "<text x=\"%.0f\" y=\"%.0f\" font-size=\"15\" font-weight=\"600\" text-anchor=\"%s\" "
          "fill=\"" DRAW_INK
          "\" stroke=\"#fff\" stroke-width=\"4\" stroke-linejoin=\"round\" paint-order=\"stroke\">"
          "%s</text>\n",
          fmax(80, x), fmax(20, y), beside ? "end" : "middle", text);
}

// The way of the middle of A.
static void sweep_path(FILE *svg, const draw_view *view, const sweep_picture *p) {
  fprintf(svg, "<path fill=\"none\" stroke=\"" DRAW_INK
               "\" stroke-width=\"2\" stroke-dasharray=\"2 6\" stroke-linecap=\"round\" d=\"");
  const size_t steps = sweep_steps(p);
  for (size_t i = 0; i <= steps; i++) {
    const oracle_pose pose = oracle_pose_at(p->poses, p->count, (double)i / (double)steps);
    double world[3];
    oracle_transform(&pose, p->a.mesh.center, world);
    draw_to(svg, view, i == 0, world);
  }
  fprintf(svg, "\"/>\n");
}

// A ring about the point, and an arrow along the normal, as long as 70 pixels where it is seen from
// the side.
static void sweep_contact(FILE *svg, const draw_view *view, const float *point,
                          const float *normal) {
  double world[3], tip[3], p[3], q[3];
  for (int k = 0; k < 3; k++) {
    world[k] = (double)point[k];
    tip[k] = world[k] + 70 / view->scale * (double)normal[k];
  }
  draw_project(view, world, p);
  draw_project(view, tip, q);
  const double length = hypot(q[0] - p[0], q[1] - p[1]) + 1e-9;
  const double ux = (q[0] - p[0]) / length;
  const double uy = (q[1] - p[1]) / length;
  for (int ink = 0; ink < 2; ink++)  // a white edge, then the mark
    fprintf(svg,
            "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\" stroke-width=\"%d\"/>"
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"13\" fill=\"none\" stroke=\"%s\" "
            "stroke-width=\"%d\"/>\n",
            p[0], p[1], q[0], q[1], ink ? "#ffb300" : "#fff", ink ? 4 : 7, p[0], p[1],
            ink ? "#ffb300" : "#fff", ink ? 4 : 7);
  if (length > 10)
    fprintf(svg, "<path d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fZ\" fill=\"#ffb300\"/>\n", q[0] + 12 * ux,
            q[1] + 12 * uy, q[0] - 7 * uy, q[1] + 7 * ux, q[0] + 7 * uy, q[1] - 7 * ux);
}

// A bar of 1, 2 or 5 times a power of ten, up to a fifth of the panel.
static void sweep_ruler(FILE *svg, const draw_view *view) {
  const double most = SWEEP_WIDTH / 5.0 / view->scale;
  const double ten = pow(10, floor(log10(most)));
  const double metres = most >= 5 * ten ? 5 * ten : most >= 2 * ten ? 2 * ten : ten;
  const int small = metres < 1;
  fprintf(svg,
          "<path d=\"M20 %d v6 h%.1f v-6\" fill=\"none\" stroke=\"" DRAW_INK
          "\" stroke-width=\"2\"/><text x=\"20\" y=\"%d\" font-size=\"13\" fill=\"" DRAW_INK
          "\">%.4g %s</text>\n",
          SWEEP_HEIGHT - 24, metres * view->scale, SWEEP_HEIGHT - 30,
          small ? 1000 * metres : metres, small ? "mm" : "m");
}

static void sweep_legend(FILE *svg, const sweep_picture *p, const char *colour) {
  char a[SWEEP_NAME], b[SWEEP_NAME];
  fprintf(svg,
          "<g transform=\"translate(%d %d)\" font-size=\"14\" fill=\"#5a6675\">"
          "<rect width=\"12\" height=\"12\" y=\"-11\" fill=\"%s\"/>"
          "<text x=\"18\">A, moves: %s; pale: at the start and at the end</text>"
          "<g transform=\"translate(0 22)\"><rect width=\"12\" height=\"12\" y=\"-11\" "
          "fill=\"#8a94a2\"/><text x=\"18\">B, rests: %s</text></g></g>\n",
          SWEEP_LEFT, SWEEP_TOP + SWEEP_HEIGHT + 26, colour, sweep_escape(p->a.name, a, sizeof a),
          sweep_escape(p->b.name, b, sizeof b));
}

// ----------------------------------------------------------------------------------------- drawing

static void sweep_scene(FILE *svg, const draw_view *view, const sweep_picture *p) {
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  const oracle_pose *start = &p->poses[0];
  const oracle_pose *end = &p->poses[p->count - 1];
  const oracle_pose shown = oracle_pose_at(p->poses, p->count, p->shown);
  const draw_colour *colour = p->collides ? &draw_red : &draw_green;
  draw_list list = {view, NULL, 0, 0, 0};
  sweep_body_at(&list, &p->b, &origin, &draw_steel, 1);
  sweep_body_at(&list, &p->a, start, colour, p->a.pale);
  sweep_body_at(&list, &p->a, end, colour, p->a.pale);
  sweep_body_at(&list, &p->a, &shown, colour, 1);
  draw_flush(svg, &list);
  // what B hides of A shows through
  sweep_body_at(&list, &p->a, &shown, colour, 0.2);
  sweep_body_at(&list, &p->a, start, colour, p->a.pale / 4);
  sweep_body_at(&list, &p->a, end, colour, p->a.pale / 4);
  draw_flush(svg, &list);
  sweep_path(svg, view, p);
  sweep_label(svg, view, p, start, "start");
  sweep_label(svg, view, p, end, "end");
  sweep_label(svg, view, p, &shown, p->shown_as);
  if (p->point) sweep_contact(svg, view, p->point, p->normal);
  sweep_ruler(svg, view);
}

// Returns 1, or 0 after a message.
static int sweep_draw(const char *path, const sweep_picture *p) {
  char verdict[SWEEP_NAME];
  const draw_view view = sweep_fit(p);
  FILE *svg = draw_open(path, SWEEP_WIDTH + 2 * SWEEP_LEFT, SWEEP_TOP + SWEEP_HEIGHT + 64, p->title,
                        sweep_escape(p->verdict, verdict, sizeof verdict));
  if (!svg) return 0;
  draw_panel(svg, SWEEP_LEFT, SWEEP_TOP, &view);
  sweep_scene(svg, &view, p);
  draw_panel_end(svg, &view, "");
  sweep_legend(svg, p, p->collides ? "#c8414a" : "#2f9c66");
  return draw_close(svg);
}

#endif
