// chart.h - accuracy against time as SVG: a panel per set, all settings as faint dots, each
// method's front as a line.
//
// Time (median, microseconds) on a logarithmic axis; accuracy on an axis in which errors are
// logarithmic, so that 99 and 99.9 % are as far apart as 90 and 99 %. Up and to the left is better.
#ifndef NSVCD_BENCH_CHART_H
#define NSVCD_BENCH_CHART_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHART_POINTS 8192
#define CHART_PANELS 4
#define CHART_METHODS 8

typedef struct chart_mark {
  int panel, method, front;
  double x, y;  // microseconds, per cent
} chart_mark;

typedef struct chart {
  char titles[CHART_PANELS][64];
  const char *methods[CHART_METHODS];
  int panels, method_count;
  size_t count;
  chart_mark marks[CHART_POINTS];
} chart;

static void chart_start(chart *c) {
  memset(c, 0, sizeof *c);
}
// Points that follow belong to this panel. Panels beyond CHART_PANELS are not drawn.
static void chart_panel(chart *c, const char *name, size_t problems) {
  if (c->panels < CHART_PANELS)
    snprintf(c->titles[c->panels], sizeof c->titles[0], "%s (%zu problems)", name, problems);
  c->panels++;
}
static void chart_point(chart *c, const char *method, double microseconds, double accuracy,
                        int front) {
  int m = 0;
  while (m < c->method_count && strcmp(c->methods[m], method) != 0) m++;
  if (m == CHART_METHODS || c->count == CHART_POINTS || c->panels > CHART_PANELS) return;
  if (m == c->method_count) c->methods[c->method_count++] = method;
  chart_mark *p = &c->marks[c->count++];
  p->panel = c->panels - 1;
  p->method = m;
  p->front = front;
  p->x = microseconds;
  p->y = accuracy;
}

// Okabe and Ito's colours, which the colour-blind can tell apart; ours is the strongest.
static const char *chart_color(const char *method) {
  static const char *const names[] = {"NeuralSVCD", "convex", "full", "simplified",
                                      "spheres",    "point",  "exact"};
  static const char *const colors[] = {"#d55e00", "#0072b2", "#000000", "#888888",
                                       "#009e73", "#cc79a7", "#e69f00"};
  for (int i = 0; i < 7; i++)
    if (strncmp(method, names[i], strlen(names[i])) == 0) return colors[i];
  return "#56b4e9";
}

#define CHART_WIDTH 560.0  // of a panel's axes, pixels
#define CHART_HEIGHT 440.0
#define CHART_STEP 650.0  // from panel to panel

static double chart_x(int panel, double microseconds) {
  double t = (log10(fmax(microseconds, 0.1)) + 1) / 5;  // 0.1 us to 10 ms
  return 70 + CHART_STEP * panel + CHART_WIDTH * fmin(t, 1);
}
static double chart_y(double accuracy) {
  double least = log10(0.05);
  double most = log10(50);  // per cent of errors; 0.05 stands for none
  return 60 + CHART_HEIGHT * fmin(1, (log10(fmax(100 - accuracy, 0.05)) - least) / (most - least));
}

static void chart_axes(FILE *file, int panel, const char *title) {
  static const double accuracies[] = {50, 80, 90, 95, 98, 99, 99.5, 99.8, 99.95};
  double left = chart_x(panel, 0.1);
  double right = chart_x(panel, 1e4);
  double top = chart_y(100);
  double bottom = chart_y(50);
  fprintf(file, "<text x='%.0f' y='40' font-size='18' font-weight='bold'>%s</text>\n", left, title);
  for (int i = -1; i <= 4; i++) {
    double x = chart_x(panel, pow(10, i));
    fprintf(file,
            "<path d='M%.1f %.1fV%.1f' stroke='#ddd'/><text x='%.1f' y='%.1f' "
            "text-anchor='middle'>%g</text>\n",
            x, top, bottom, x, bottom + 20, pow(10, i));
  }
  for (size_t i = 0; i < sizeof accuracies / sizeof accuracies[0]; i++) {
    double y = chart_y(accuracies[i]);
    fprintf(file,
            "<path d='M%.1f %.1fH%.1f' stroke='#ddd'/><text x='%.1f' y='%.1f' "
            "text-anchor='end'>%g%s</text>\n",
            left, y, right, left - 8, y + 5, accuracies[i] > 99.9 ? 100 : accuracies[i],
            accuracies[i] > 99.9 ? "" : "");
  }
  fprintf(
      file,
      "<text x='%.0f' y='%.0f' text-anchor='middle'>median time of a query, microseconds</text>\n",
      (left + right) / 2, bottom + 42);
  fprintf(file,
          "<text transform='translate(%.0f %.0f) rotate(-90)' text-anchor='middle'>right answers, "
          "%%</text>\n",
          left - 48, (top + bottom) / 2);
}

static int chart_by_time(const void *a, const void *b) {
  const chart_mark *p = (const chart_mark *)a;
  const chart_mark *q = (const chart_mark *)b;
  return (p->x > q->x) - (p->x < q->x);
}

static void chart_method(FILE *file, const chart *c, int panel, int method) {
  const char *color = chart_color(c->methods[method]);
  double width = strcmp(c->methods[method], "NeuralSVCD") == 0 ? 3.5 : 2;
  char letter = 'M';
  fprintf(file, "<g fill='%s' fill-opacity='0.25'>", color);
  for (size_t i = 0; i < c->count; i++) {
    const chart_mark *p = &c->marks[i];
    if (p->panel == panel && p->method == method && !p->front && p->y > 50)
      fprintf(file, "<circle cx='%.1f' cy='%.1f' r='1.6'/>", chart_x(panel, p->x), chart_y(p->y));
  }
  fprintf(file, "</g>\n<g stroke='%s' fill='%s'><path fill='none' stroke-width='%g' d='", color,
          color, width);
  for (size_t i = 0; i < c->count; i++) {  // the front, as the marks are sorted by time
    const chart_mark *p = &c->marks[i];
    if (p->panel != panel || p->method != method || !p->front || p->y < 50) continue;
    fprintf(file, "%c%.1f %.1f", letter, chart_x(panel, p->x), chart_y(p->y));
    letter = 'L';
  }
  fprintf(file, "'/>");
  for (size_t i = 0; i < c->count; i++) {
    const chart_mark *p = &c->marks[i];
    if (p->panel == panel && p->method == method && p->front && p->y >= 50)
      fprintf(file, "<circle cx='%.1f' cy='%.1f' r='%g'/>", chart_x(panel, p->x), chart_y(p->y),
              width + 0.5);
  }
  fprintf(file, "</g>\n");
}

// Sorts the marks. Returns 0 after a message if the file cannot be written.
static int chart_write(chart *c, const char *path) {
  FILE *file = fopen(path, "w");
  int panels = c->panels < CHART_PANELS ? c->panels : CHART_PANELS;
  if (!file) return perror(path), 0;
  qsort(c->marks, c->count, sizeof *c->marks, chart_by_time);
  double width = CHART_STEP * (panels ? panels : 1) + 20;
  double bottom = chart_y(50) + 76;
  int columns = (c->method_count + 1) / 2;
  fprintf(file,
          "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f' "
          "font-family='sans-serif' font-size='14'>\n"
          "<rect width='100%%' height='100%%' fill='white'/>\n",
          width, bottom + 50);
  for (int p = 0; p < panels; p++) {
    chart_axes(file, p, c->titles[p]);
    for (int m = c->method_count - 1; m >= 0; m--) chart_method(file, c, p, m);
  }
  for (int m = 0; m < c->method_count; m++) {
    double x = 70 + (width - 90) / columns * (m % columns);
    double y = bottom + 26 * (m / columns);
    fprintf(file,
            "<circle cx='%.0f' cy='%.0f' r='6' fill='%s'/><text x='%.0f' y='%.0f'>%s</text>\n", x,
            y, chart_color(c->methods[m]), x + 12, y + 5, c->methods[m]);
  }
  fprintf(file, "</svg>\n");
  int good = !ferror(file);
  return fclose(file) == 0 && good;
}

#endif  // NSVCD_BENCH_CHART_H
