// mining_site.c - an arm on a base that drives carries a pickaxe past four obstacles to the end of
// a tunnel: nine joints, 25 bodies, about 150 pairs that can meet.
//
//   build/mining_site [SEED] [PICTURE.svg] [SECONDS]     ends with 0 if the exact oracle finds the
//                                                        motion free
//
// Shows how to watch the planner, and how to stop it after SECONDS (planner_plan in task_planner.h
// is the code to copy).
#define _POSIX_C_SOURCE 200112L  // scenery/clock.h
#define NEURALSVCD_IMPLEMENTATION
#include "task_planner.h"

// Called once per iteration. Not 0 cancels: nsvcd_plan then returns the best trajectory so far, as
// CANCELLED.
static int watch(void *data, const nsvcd_plan_progress *progress) {
  const planner_user *user = (const planner_user *)data;
  if (progress->iteration % 10 == 0 || progress->refining)
    printf("  %s %2zu: cost %8.2f, of it collision %8.2f\n",
           progress->refining ? "refine " : "explore", progress->iteration, (double)progress->cost,
           (double)progress->collision);
  return seconds() > user->until;
}

static void draw_motion(FILE *svg, const task_scene *scene, const planner_motion *motion) {
  const int axe = scene->held[0];
  const int base = 0;
  const int ghosts = 8;
  const float *start = scene->problems[0].start;
  const float *goal = scene->problems[0].goal;
  const draw_view view = {-1.45, 0.8, {4.95, 0.25, 0.4}, 132, 1500, 540};
  draw_list list = {&view, NULL, 0, 0, 0};
  draw_panel(svg, 24, 84, &view);
  draw_floor(&list, scene);
  draw_flush(svg, &list);
  draw_still(&list, scene);
  for (int i = 1; i < ghosts; i++)
    draw_robot(&list, scene, planner_joints_at(scene, motion, (double)i / ghosts), &draw_blue,
               &draw_orange, 0.45);
  draw_robot(&list, scene, start, &draw_blue, &draw_orange, 1);
  draw_robot(&list, scene, goal, &draw_blue, &draw_orange, 1);
  draw_flush(svg, &list);
  planner_ways(svg, &view, scene, motion, base, -1);
  planner_line(svg, &view, scene, motion->joints, PLANNER_SAMPLES, axe, -1,
               "stroke=\"" PLANNER_WAY "\" opacity=\".5\"");
  planner_label(svg, &view, scene, start, base, -1, 0, 50, "start");
  planner_label(svg, &view, scene, goal, base, -1, 0, 50, "goal");
  draw_panel_end(svg, &view, motion->good ? "" : "NOT FREE");
}

int main(int argc, char **argv) {
  static task_scene scene;
  static planner_motion motion;
  const nsvcd_body *bodies[TASK_MAX_BODIES];
  double patience = 60;
  uint64_t seed = 1;
  const char *picture = "build/mining_site.svg";
  if (!planner_arguments(argc, argv, &seed, &picture, &patience)) return 2;
  if (!task_mining_episode(&scene, seed))
    return fprintf(stderr, "no scene comes of this seed: try another\n"), 1;

  FILE *svg = draw_open(picture, 1548, 540 + 108, "A mobile arm carries a pickaxe through a mine",
                        PLANNER_LEGEND ". Strong: the base; pale: the pickaxe");
  if (!svg) return 1;
  double begin = seconds();
  if (!planner_encode(&scene, bodies)) return 1;
  printf("%s, seed %llu: %d bodies encoded in %.2f s, %d pairs that can meet\n", scene.name,
         (unsigned long long)seed, scene.body_count, seconds() - begin, scene.pair_count);

  nsvcd_plan_options options;
  memset(&options, 0, sizeof options);
  options.velocity = 1;
  options.acceleration = 10;
  options.jerk = 50;  // a long way: speed costs less, jerks more
  // rather a wider way than a beam touched
  options.sweep.network.recall = 0.999f;
  planner_user user = {&scene, seconds() + patience};
  if (!planner_plan(&user, bodies, &options, watch, &motion)) return 1;
  planner_judge(&scene, &motion);
  planner_report(&scene, &motion);

  draw_motion(svg, &scene, &motion);
  if (!draw_close(svg)) return 1;
  printf("see %s\n", picture);
  planner_free(&scene, bodies);
  task_free(&scene);
  return !motion.good;
}
