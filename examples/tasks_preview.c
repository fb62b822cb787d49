// tasks_preview.c - looks at the three planning tasks of tasks.h, without planning.
//
//   build/tasks_preview            writes build/task_dish.svg, build/task_bimanual.svg,
//                                  build/task_mining.svg and a film, build/task_film.svg
//   build/tasks_preview 7          those of seed 7
//   build/tasks_preview measure N [SEED]  N episodes of each task: bodies, pairs, time, how hard
//                                         they are
#include "draw_tasks.h"

#include <time.h>

#define PREVIEW_MAX 512  // samples of a trajectory

static double preview_now(void) {
  return (double)clock() / CLOCKS_PER_SEC;
}
static int preview_episode(task_scene *scene, int task, uint64_t seed) {
  return task == 0   ? task_dish_episode(scene, seed)
         : task == 1 ? task_bimanual_episode(scene, seed)
                     : task_mining_episode(scene, seed);
}

// ------------------------------------------------------------------------------------------ solver
// Shows that episodes can be solved by simple motions: random via points, then the generator's way
// into the goal.

// The points start, vias, approach, goal: `vias` of them random about the straight line, within
// `spread`, each drawn anew until the line to it is free. Returns 0 if that fails.
static int preview_points(task_scene *scene, int vias, int task, double spread,
                          double (*points)[TASK_MAX_JOINTS]) {
  const task_problem *p = &scene->problems[scene->selected];
  const int n = scene->joint_count;
  for (int v = 0; v <= vias + 2; v++) {
    double u = v == vias + 2 ? 1 : (double)v / (vias + 1);
    const float *end = v == vias + 2 ? p->goal : p->approach;
    int free_line = v == 0;
    int random = v > 0 && v <= vias;
    for (int attempt = 0; attempt == 0 || (random && attempt < 8 && !free_line); attempt++) {
      double line[2 * TASK_MAX_JOINTS];
      for (int j = 0; j < n; j++) {
        // In the mine the base goes where it likes across the tunnel, and the arm keeps still.
        double wide = task < 2 ? spread : j == 0 ? 1 : j == 1 ? 1.2 : 0.2;
        points[v][j] = (double)p->start[j] + u * ((double)end[j] - (double)p->start[j]);
        if (random) points[v][j] += shapes_uniform(&scene->rng, -wide, wide);
        points[v][j] = fmax(scene->joints[j].low, fmin(scene->joints[j].high, points[v][j]));
        line[j] = points[v ? v - 1 : 0][j];
        line[n + j] = points[v][j];
      }
      if (v) free_line = task_keeps(scene, line, 2, 0, NULL);
    }
    if (!free_line) return 0;
  }
  return vias + 3;
}
// The quintic Hermite spline of a trajectory optimizer: control points at equal times, velocity by
// central, acceleration by second differences, both 0 at the ends.
static int preview_spline(const double (*c)[TASK_MAX_JOINTS], int count, int joints, int steps,
                          double *out) {
  int at = 0;
  for (int i = 0; i + 1 < count; i++)
    for (int s = 0; s < steps + (i + 2 == count); s++, at++)
      for (int j = 0; j < joints; j++) {
        double t = (double)s / steps;
        double p[2];
        double v[2];
        double a[2];
        for (int e = 0; e < 2; e++) {
          int k = i + e;
          int end = k == 0 || k + 1 == count;
          p[e] = c[k][j];
          v[e] = end ? 0 : (c[k + 1][j] - c[k - 1][j]) / 2;
          a[e] = end ? 0 : c[k + 1][j] - 2 * c[k][j] + c[k - 1][j];
        }
        double d = p[1] - p[0] - v[0] - a[0] / 2;
        double dv = v[1] - v[0] - a[0];
        double da = a[1] - a[0];
        double c3 = 10 * d - 4 * dv + da / 2;
        double c4 = -15 * d + 7 * dv - da;
        double c5 = 6 * d - 3 * dv + da / 2;
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
      double at = fmin(k / 7.0, 1) * length[count - 2];
      double f = fmax(0, (k - 7) / 2.0);
      int i = 0;
      while (i + 3 < count && length[i + 1] < at) i++;
      double u = (at - length[i]) / (length[i + 1] - length[i]);
      control[k][j] = points[i][j] + u * (points[i + 1][j] - points[i][j]);
      if (k > 7)
        control[k][j] = points[count - 2][j] + f * (points[count - 1][j] - points[count - 2][j]);
    }
}
// Tries until a polyline is free, and goes on until a spline is. found: the random via points of
// the first polyline and of the first spline, -1 where none did in `tries`. Returns the samples of
// the spline in `out`.
static int preview_solve(task_scene *scene, int task, int tries, double *out, int *found) {
  double points[8][TASK_MAX_JOINTS], control[10][TASK_MAX_JOINTS];
  const int n = scene->joint_count;
  found[0] = found[1] = -1;
  for (int t = 0; t < tries; t++) {
    int vias = task == 2 ? 3 : t % 3;
    int good = 1;
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
static int preview_measure(int episodes, int first_seed) {
  const char *const names[3] = {"dish insertion", "bimanual insertion", "mining site"};
  static double path[PREVIEW_MAX * TASK_MAX_JOINTS];
  static float line[PREVIEW_MAX * TASK_MAX_JOINTS];
  static task_scene scene;
  setvbuf(stdout, NULL, _IOLBF, 0);
  printf("%-20s %8s %6s %6s %9s %9s %9s %8s %8s %8s %9s %9s\n", "task", "problems", "bodies",
         "pairs", "make ms", "worst ms", "straight", "no via", "lines", "spline", "check ms",
         "worst ms");
  for (int task = 0; task < 3; task++) {
    int problems = 0;
    int hits = 0;
    int simple = 0;
    int lines = 0;
    int splines = 0;
    int checks = 0;
    int pairs = 0;
    int bodies = 0;
    double made = 0;
    double worst = 0;
    double checked = 0;
    double slowest = 0;
    for (int e = first_seed; e < first_seed + episodes; e++) {
      double begin = preview_now();
      if (!preview_episode(&scene, task, (uint64_t)e)) {
        printf("%s: seed %d fails\n", names[task], e);
        continue;
      }
      made += preview_now() - begin;
      worst = fmax(worst, preview_now() - begin);
      for (int i = 0; i < scene.problem_count; i++) {
        const int n = scene.joint_count;
        const int tries = task == 2 ? 300 : 2000;
        task_select(&scene, i);
        problems++;
        pairs = pairs > scene.pair_count ? pairs : scene.pair_count;
        bodies = bodies > scene.body_count ? bodies : scene.body_count;
        for (int j = 0; j < n; j++) {
          path[j] = (double)scene.problems[i].start[j];
          path[n + j] = (double)scene.problems[i].goal[j];
        }
        hits += !task_keeps(&scene, path, 2, 0, NULL);
        int found[2];
        int samples = preview_solve(&scene, task, tries, path, found);
        simple += found[0] == 0;
        lines += found[0] >= 0;
        splines += found[1] >= 0;
        if (!samples)
          printf("%s seed %d problem %d: no spline found, lines %d\n", names[task], e, i, found[0]);
        if (!samples) continue;
        for (int s = 0; s < 200; s++)  // the same path at 200 samples
          for (int j = 0; j < n; j++) {
            double at = s / 199.0 * (samples - 1);
            int k = (int)fmin(at, samples - 2);
            line[s * n + j] =
                (float)(path[k * n + j] + (at - k) * (path[(k + 1) * n + j] - path[k * n + j]));
          }
        begin = preview_now();
        task_check(&scene, line, 200, NULL);
        checked += preview_now() - begin;
        slowest = fmax(slowest, preview_now() - begin);
        checks++;
      }
      task_free(&scene);
    }
    printf("%-20s %8d %6d %6d %9.1f %9.1f %8.1f%% %7.1f%% %7.1f%% %7.1f%% %9.1f %9.1f\n",
           names[task], problems, bodies, pairs, 1e3 * made / episodes, 1e3 * worst,
           100.0 * hits / problems, 100.0 * simple / problems, 100.0 * lines / problems,
           100.0 * splines / problems, 1e3 * checked / checks, 1e3 * slowest);
    fflush(stdout);
  }
  return 0;
}

// ---------------------------------------------------------------------------------------- pictures

// A panel: the selected problem on a path of `samples`, `ghosts` of them pale; both ends, or one of
// them, solid.
static void preview_panel(FILE *svg, int x, task_scene *scene, const draw_view *view,
                          const float *path, int samples, int ghosts, int start, int goal,
                          const char *caption) {
  const task_problem *problem = &scene->problems[scene->selected];
  draw_list list = {view, NULL, 0, 0, 0};
  float line[2 * TASK_MAX_JOINTS];
  float *end = line + scene->joint_count;
  memcpy(line, problem->start, sizeof problem->start);
  memcpy(end, problem->goal, (size_t)scene->joint_count * sizeof *end);
  float straight[20 * TASK_MAX_JOINTS];
  for (int i = 0; i < 20 * scene->joint_count; i++) {
    int j = i % scene->joint_count;
    straight[i] = line[j] + (end[j] - line[j]) * (float)(i / scene->joint_count) / 19;
  }
  draw_panel(svg, x, 84, view);
  draw_floor(&list, scene);
  draw_flush(svg, &list);
  draw_still(&list, scene);
  for (int i = 1; i <= ghosts; i++)
    draw_robot(&list, scene, path + i * (samples - 1) / (ghosts + 1) * scene->joint_count,
               &draw_steel, &draw_orange, 0.3);
  if (start) draw_robot(&list, scene, problem->start, &draw_blue, &draw_orange, 1);
  if (goal) draw_robot(&list, scene, problem->goal, &draw_green, &draw_orange, 1);
  draw_flush(svg, &list);
  draw_trace(svg, view, scene, scene->held[scene->selected], straight, 20, "#c22f3a");
  draw_trace(svg, view, scene, scene->held[scene->selected], path, samples, "#12824c");
  draw_panel_end(svg, view, caption);
}
static int preview_draw(int task, uint64_t seed, const char *path, const draw_view *view) {
  static task_scene scene;
  static double found_path[PREVIEW_MAX * TASK_MAX_JOINTS];
  static float way[PREVIEW_MAX * TASK_MAX_JOINTS];
  if (!preview_episode(&scene, task, seed)) return fprintf(stderr, "no episode\n"), 0;
  int panels = task == 2 ? 1 : 3;
  int ok = 1;
  FILE *svg = draw_open(path, 24 + panels * (view->width + 24), view->height + 108, scene.name,
                        "blue: the start; green: the goal; red: the straight line in joint space, "
                        "which collides; green "
                        "line: a free way, found by random via points");
  if (!svg) return task_free(&scene), 0;
  for (int i = 0; i < panels; i++) {
    int found[2];
    int x = 24 + i * (view->width + 24);
    task_select(&scene, task ? 0 : i);
    int samples = preview_solve(&scene, task, 1000, found_path, found);
    if (!samples) {
      ok = fprintf(stderr, "problem %d: no way found\n", i) < 0;
      samples = 1;
    }
    for (int k = 0; k < samples * scene.joint_count; k++) way[k] = (float)found_path[k];
    draw_view near = *view;
    if (task == 1 && i == 2) {  // close to the hole
      nsvcd_pose poses[TASK_MAX_BODIES];
      task_place(&scene, scene.problems[0].goal, poses);
      for (int k = 0; k < 3; k++) near.look_at[k] = (double)poses[scene.held[1]].position[k];
      near.scale *= 3.5;
    }
    const char *const steps[3] = {"start", "goal", "goal, from near"};
    const int ghosts[3] = {3, 0, 5};
    preview_panel(svg, x, &scene, &near, way, samples, ghosts[task], task != 1 || i == 0,
                  task != 1 || i > 0, task == 1 ? steps[i] : scene.bodies[scene.held[i]].name);
  }
  task_free(&scene);
  return draw_close(svg) && ok;
}

// The peg's way into the hole as a film.
static int preview_film(uint64_t seed, const char *path, const draw_view *view) {
  const int frames = 40;
  static task_scene scene;
  static double found_path[PREVIEW_MAX * TASK_MAX_JOINTS];
  int found[2];
  if (!task_bimanual_episode(&scene, seed)) return fprintf(stderr, "no episode\n"), 0;
  int samples = preview_solve(&scene, 1, 1000, found_path, found);
  FILE *svg = draw_open(path, view->width + 48, view->height + 108, scene.name,
                        "a free way, found by random via points");
  if (!svg || !samples) return task_free(&scene), 0;
  draw_panel(svg, 24, 84, view);
  for (int i = 0; i < frames; i++) {
    draw_list list = {view, NULL, 0, 0, 0};
    float joints[TASK_MAX_JOINTS];
    for (int j = 0; j < scene.joint_count; j++)
      joints[j] = (float)found_path[i * (samples - 1) / (frames - 1) * scene.joint_count + j];
    draw_frame(svg, i, frames, 4);
    draw_still(&list, &scene);
    draw_robot(&list, &scene, joints, &draw_blue, &draw_orange, 1);
    draw_flush(svg, &list);
    draw_frame_end(svg);
  }
  draw_panel_end(svg, view, "");
  task_free(&scene);
  return draw_close(svg);
}

int main(int argc, char **argv) {
  const draw_view dish = {-0.9, 0.5, {0.25, 0, 0.25}, 410, 560, 520};
  const draw_view bimanual = {0.5, 0.45, {0.22, 0.03, 0.72}, 700, 700, 640};
  const draw_view mining = {-1.45, 0.8, {4.95, 0.25, 0.4}, 130, 1480, 520};
  uint64_t seed = argc > 1 ? (uint64_t)atoi(argv[1]) : 1;
  if (argc > 2) return preview_measure(atoi(argv[2]), argc > 3 ? atoi(argv[3]) : 0);
  const draw_view film = {0.5, 0.45, {0.22, 0.03, 0.72}, 560, 560, 520};
  return !(preview_film(seed, "build/task_film.svg", &film) &&
           preview_draw(0, seed, "build/task_dish.svg", &dish) &&
           preview_draw(1, seed, "build/task_bimanual.svg", &bimanual) &&
           preview_draw(2, seed, "build/task_mining.svg", &mining));
}
