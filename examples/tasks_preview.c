// tasks_preview.c - looks at the three planning tasks of tasks.h, without planning.
//
//   build/tasks_preview            writes build/task_dish.svg, build/task_bimanual.svg, build/task_mining.svg
//   build/tasks_preview 7          those of seed 7
//   build/tasks_preview measure N  N episodes of each task: bodies, pairs, time, how hard they are
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "draw.h"

#include <time.h>

#define PREVIEW_MAX 512  // samples of a trajectory

static double preview_now(void) { return (double)clock() / CLOCKS_PER_SEC; }
static int preview_episode(task_scene *scene, int task, uint64_t seed) {
  return task == 0   ? task_dish_episode(scene, seed)
         : task == 1 ? task_bimanual_episode(scene, seed)
                     : task_mining_episode(scene, seed);
}

// ----------------------------------------------------------------------------------------------------------- solver
// Shows that episodes can be solved by simple motions: random via points, then the generator's way into the goal.

// The points start, vias, approach, goal: `vias` of them random about the straight line, within `spread`, each drawn
// anew until the line to it is free. Returns 0 if that fails.
static int preview_points(task_scene *scene, int vias, int task, double spread, double (*points)[TASK_MAX_JOINTS]) {
  const task_problem *p = &scene->problems[scene->selected];
  const int n = scene->joint_count;
  for (int v = 0; v <= vias + 2; v++) {
    double u = v == vias + 2 ? 1 : (double)v / (vias + 1);
    const float *end = v == vias + 2 ? p->goal : p->approach;
    int free_line = v == 0, random = v > 0 && v <= vias;
    for (int attempt = 0; attempt == 0 || (random && attempt < 8 && !free_line); attempt++) {
      double line[2 * TASK_MAX_JOINTS];
      for (int j = 0; j < n; j++) {
        // In the mine the base goes where it likes across the tunnel, and the arm keeps still.
        double wide = task < 2 ? spread : j == 0 ? 0.8 : j == 1 ? 1.2 : 0.2;
        points[v][j] = (double)p->start[j] + u * ((double)end[j] - (double)p->start[j]);
        if (random) points[v][j] += shapes_uniform(&scene->rng, -wide, wide);
        points[v][j] = fmax(scene->joints[j].low, fmin(scene->joints[j].high, points[v][j]));
        line[j] = points[v ? v - 1 : 0][j], line[n + j] = points[v][j];
      }
      if (v) free_line = task_keeps(scene, line, 2, 0, NULL);
    }
    if (!free_line) return 0;
  }
  return vias + 3;
}
// The quintic Hermite spline of a trajectory optimizer: control points at equal times, velocity by central, acceleration
// by second differences, both 0 at the ends.
static int preview_spline(const double (*c)[TASK_MAX_JOINTS], int count, int joints, int steps, double *out) {
  int at = 0;
  for (int i = 0; i + 1 < count; i++)
    for (int s = 0; s < steps + (i + 2 == count); s++, at++)
      for (int j = 0; j < joints; j++) {
        double t = (double)s / steps, p[2], v[2], a[2];
        for (int e = 0; e < 2; e++) {
          int k = i + e, end = k == 0 || k + 1 == count;
          p[e] = c[k][j];
          v[e] = end ? 0 : (c[k + 1][j] - c[k - 1][j]) / 2, a[e] = end ? 0 : c[k + 1][j] - 2 * c[k][j] + c[k - 1][j];
        }
        double d = p[1] - p[0] - v[0] - a[0] / 2, dv = v[1] - v[0] - a[0], da = a[1] - a[0];
        double c3 = 10 * d - 4 * dv + da / 2, c4 = -15 * d + 7 * dv - da, c5 = 6 * d - 3 * dv + da / 2;
        out[at * joints + j] = p[0] + t * (v[0] + t * (a[0] / 2 + t * (c3 + t * (c4 + t * c5))));
      }
  return at;
}
// Ten control points at equal distances along the points; the last three from the approach on.
static void preview_resample(const double (*points)[TASK_MAX_JOINTS], int count, int joints,
                             double (*control)[TASK_MAX_JOINTS]) {
  double length[16] = {0};
  for (int i = 1; i + 1 < count; i++) {
    double sum = 0;
    for (int j = 0; j < joints; j++) sum += pow(points[i][j] - points[i - 1][j], 2);
    length[i] = length[i - 1] + sqrt(sum);
  }
  for (int k = 0; k < 10; k++)
    for (int j = 0; j < joints; j++) {
      double at = fmin(k / 7.0, 1) * length[count - 2], f = fmax(0, (k - 7) / 2.0);
      int i = 0;
      while (i + 3 < count && length[i + 1] < at) i++;
      double u = (at - length[i]) / (length[i + 1] - length[i]);
      control[k][j] = points[i][j] + u * (points[i + 1][j] - points[i][j]);
      if (k > 7) control[k][j] = points[count - 2][j] + f * (points[count - 1][j] - points[count - 2][j]);
    }
}
// Tries until a polyline is free, and goes on until a spline is. found: the random via points of the first polyline and
// of the first spline, -1 where none did in `tries`. Returns the samples of the spline in `out`.
static int preview_solve(task_scene *scene, int task, int tries, double *out, int *found) {
  double points[8][TASK_MAX_JOINTS], control[10][TASK_MAX_JOINTS];
  const int n = scene->joint_count;
  found[0] = found[1] = -1;
  for (int t = 0; t < tries; t++) {
    int vias = task == 2 ? 3 : t % 3, good = 1;
    int count = preview_points(scene, vias, task, 0.2 + 0.8 * t / tries, points);
    if (!count) continue;
    if (found[0] < 0) found[0] = vias;
    preview_resample((const double(*)[TASK_MAX_JOINTS])points, count, n, control);
    int samples = preview_spline((const double(*)[TASK_MAX_JOINTS])control, 10, n, 12, out);
    for (int s = 0; s < samples && good; s++) good = task_in_limits(scene, out + s * n);
    if (!good || !task_keeps(scene, out, samples, 0, NULL)) continue;
    found[1] = vias;
    return samples;
  }
  return 0;
}
static int preview_measure(int episodes, int first) {
  const char *const names[3] = {"dish insertion", "bimanual insertion", "mining site"};
  static double path[PREVIEW_MAX * TASK_MAX_JOINTS];
  static float line[PREVIEW_MAX * TASK_MAX_JOINTS];
  static task_scene scene;
  printf("%-20s %8s %6s %6s %9s %9s %9s %8s %8s %9s %9s\n", "task", "problems", "bodies", "pairs", "make ms",
         "worst ms", "straight", "lines", "spline", "check ms", "worst ms");
  for (int task = first; task < 3; task++) {
    int problems = 0, hits = 0, lines = 0, splines = 0, checks = 0, pairs = 0, bodies = 0;
    double made = 0, worst = 0, checked = 0, slowest = 0;
    for (int e = 0; e < episodes; e++) {
      double begin = preview_now();
      if (!preview_episode(&scene, task, (uint64_t)e)) {
        printf("%s: seed %d fails\n", names[task], e);
        continue;
      }
      made += preview_now() - begin, worst = fmax(worst, preview_now() - begin);
      for (int i = 0; i < scene.problem_count; i++) {
        const int n = scene.joint_count, tries = 1000;
        task_select(&scene, i);
        problems++, pairs = pairs > scene.pair_count ? pairs : scene.pair_count;
        bodies = bodies > scene.body_count ? bodies : scene.body_count;
        for (int j = 0; j < n; j++)
          path[j] = (double)scene.problems[i].start[j], path[n + j] = (double)scene.problems[i].goal[j];
        hits += !task_keeps(&scene, path, 2, 0, NULL);
        int found[2], samples = preview_solve(&scene, task, tries, path, found);
        lines += found[0] >= 0, splines += found[1] >= 0;
        if (!samples) printf("%s seed %d problem %d: no spline found, lines %d\n", names[task], e, i, found[0]);
        if (!samples) continue;
        for (int s = 0; s < 200; s++)  // the same path at 200 samples
          for (int j = 0; j < n; j++) {
            double at = s / 199.0 * (samples - 1);
            int k = (int)fmin(at, samples - 2);
            line[s * n + j] = (float)(path[k * n + j] + (at - k) * (path[(k + 1) * n + j] - path[k * n + j]));
          }
        begin = preview_now();
        task_check(&scene, line, 200, NULL);
        checked += preview_now() - begin, slowest = fmax(slowest, preview_now() - begin), checks++;
      }
      task_free(&scene);
    }
    printf("%-20s %8d %6d %6d %9.1f %9.1f %8.1f%% %7.1f%% %7.1f%% %9.1f %9.1f\n", names[task], problems, bodies, pairs,
           1e3 * made / episodes, 1e3 * worst, 100.0 * hits / problems, 100.0 * lines / problems,
           100.0 * splines / problems, 1e3 * checked / checks, 1e3 * slowest);
    fflush(stdout);
  }
  return 0;
}

// ---------------------------------------------------------------------------------------------------------- pictures

static int preview_draw(task_scene *scene, const char *path, const draw_view *views, int view_count) {
  int panels = view_count * scene->problem_count, width = 24, x = 24;
  for (int i = 0; i < panels; i++) width += views[i % view_count].width + 24;
  FILE *svg = draw_open(path, width, views[0].height + 108, scene->name,
                        "blue: the robot at the start; green: at the goal; pale: on the straight way between");
  if (!svg) return 0;
  for (int i = 0; i < panels; i++) {
    const draw_view *view = &views[i % view_count];
    task_select(scene, i / view_count);
    const task_problem *problem = &scene->problems[scene->selected];
    draw_list list = {view, NULL, 0, 0, 0};
    draw_panel(svg, x, 84, view);
    draw_still(&list, scene);
    for (int ghost = 1; ghost < 4; ghost++) {
      float joints[TASK_MAX_JOINTS];
      for (int j = 0; j < scene->joint_count; j++)
        joints[j] = problem->start[j] + (problem->goal[j] - problem->start[j]) * (float)ghost / 4;
      draw_robot(&list, scene, joints, &draw_steel, &draw_orange, 0.25);
    }
    draw_robot(&list, scene, problem->start, &draw_blue, &draw_orange, 1);
    draw_robot(&list, scene, problem->goal, &draw_green, &draw_orange, 1);
    draw_flush(svg, &list);
    draw_panel_end(svg, view, scene->bodies[scene->held[i / view_count]].name);
    x += view->width + 24;
  }
  return draw_close(svg);
}

int main(int argc, char **argv) {
  static task_scene scene;
  if (argc > 2) return preview_measure(atoi(argv[2]), argc > 3 ? atoi(argv[3]) : 0);
  const draw_view dish = {-0.9, 0.45, {0.2, 0, 0.28}, 420, 560, 520, 0.06};
  const draw_view bimanual[2] = {{0.4, 0.35, {0.15, 0, 0.72}, 640, 620, 620, 0.04},
                                 {0.4, 0.9, {0.3, 0, 0.72}, 900, 620, 620, 0.04}};
  const draw_view mining = {-1.25, 0.75, {4.9, -0.1, 0.4}, 118, 1340, 520, 0.3};
  uint64_t seed = argc > 1 ? (uint64_t)atoi(argv[1]) : 1;
  if (!preview_episode(&scene, 0, seed) || !preview_draw(&scene, "build/task_dish.svg", &dish, 1)) return 1;
  task_free(&scene);
  if (!preview_episode(&scene, 1, seed) || !preview_draw(&scene, "build/task_bimanual.svg", bimanual, 2)) return 1;
  task_free(&scene);
  if (!preview_episode(&scene, 2, seed) || !preview_draw(&scene, "build/task_mining.svg", &mining, 1)) return 1;
  task_free(&scene);
  return 0;
}
