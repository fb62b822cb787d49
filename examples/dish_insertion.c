// dish_insertion.c - a UR5 puts three dishes into a rack, one after the other; each becomes an
// obstacle for the next.
//
//   build/dish_insertion [SEED] [PICTURE.svg]     ends with 0 if the exact oracle finds all three
//                                                 motions free
//
// A motion is planned with the network alone (planner_plan in task_planner.h is the code to copy)
// and judged afterwards with the exact oracle, which knows the triangles.
#define _POSIX_C_SOURCE 200112L  // scenery/clock.h
#define NEURALSVCD_IMPLEMENTATION
#include "task_planner.h"

// Sees the slots of the rack nearly edge-on, not through the robot, and the start well beside the
// goal.
static draw_view look(const task_scene *scene, const planner_motion *motion) {
  const int dish = scene->held[scene->selected];
  const task_problem *problem = &scene->problems[scene->selected];
  const int rack_body = scene->held[0] - 1;
  const oracle_pose *rack = &scene->bodies[rack_body].offset;
  draw_view view = {0, 0.5, {0, 0, 0}, 500, 496, 470};
  double best = -HUGE_VAL;
  double azimuth = 0;
  double yaw = 2 * atan2(rack->rotation[2], rack->rotation[3]);
  double start[3];
  double goal[3];
  for (int i = 0; i < 4; i++) {
    view.azimuth = yaw + TASK_PI * (i / 2 + 0.5) + (i % 2 ? 0.45 : -0.45);
    draw_project(&view, planner_pose(scene, problem->start, dish, -1).position, start);
    draw_project(&view, planner_pose(scene, problem->goal, dish, -1).position, goal);
    double front = cos(view.azimuth - atan2(rack->position[1], rack->position[0]));
    double score = fmin(fabs(start[0] - goal[0]), 150) + 300 * fmin(front, 0.3);
    if (score > best) {
      best = score;
      azimuth = view.azimuth;
    }
  }
  view.azimuth = azimuth;
  planner_fit(&view, scene, motion, rack_body, -1, 0.17);
  return view;
}
static void draw_motion(FILE *svg, int x, const task_scene *scene, const planner_motion *motion) {
  const int dish = scene->held[scene->selected];
  const int ghosts = 7;
  const task_problem *problem = &scene->problems[scene->selected];
  const draw_view view = look(scene, motion);
  draw_list list = {&view, NULL, 0, 0, 0};
  char caption[80];
  draw_panel(svg, x, 84, &view);
  draw_floor(&list, scene);
  draw_flush(svg, &list);
  draw_still(&list, scene);
  for (int i = 0; i < ghosts; i++)
    planner_ghost(&list, scene, planner_joints_at(scene, motion, (double)i / ghosts), dish, -1,
                  &draw_orange, i ? 0.35 : 0.9);
  draw_robot(&list, scene, problem->start, &planner_pale, &draw_orange, 0.4);
  draw_robot(&list, scene, problem->goal, &planner_pale, &draw_orange, 1);
  draw_flush(svg, &list);
  planner_ways(svg, &view, scene, motion, dish, -1);
  planner_label(svg, &view, scene, problem->start, dish, -1, 0, 6, "start");
  planner_label(svg, &view, scene, problem->goal, dish, -1, 0, 6, "goal");
  snprintf(caption, sizeof caption, "%d. %s%s", scene->selected + 1, scene->bodies[dish].name,
           motion->good ? "" : " (NOT FREE)");
  draw_panel_end(svg, &view, caption);
}

int main(int argc, char **argv) {
  static task_scene scene;
  static planner_motion motion;
  const nsvcd_body *bodies[TASK_MAX_BODIES];
  planner_user user = {&scene, 0};
  uint64_t seed = 1;
  const char *picture = "build/dish_insertion.svg";
  if (!planner_arguments(argc, argv, &seed, &picture, NULL)) return 2;
  if (!task_dish_episode(&scene, seed))
    return fprintf(stderr, "no scene comes of this seed: try another\n"), 1;

  FILE *svg = draw_open(picture, 3 * 516 + 32, 470 + 108, "A UR5 puts three dishes into a rack",
                        PLANNER_LEGEND " &#160;&#183;&#160; grey and white: not to be touched");
  if (!svg) return 1;
  // Once: every body is encoded as it is, the dishes by themselves. A dish that is grasped, carried
  // and let go is the same body all along: planner_place moves it with the hand, or not, and
  // nothing is encoded again.
  double begin = seconds();
  if (!planner_encode(&scene, bodies)) return 1;
  printf("%s, seed %llu: %d bodies encoded in %.2f s\n", scene.name, (unsigned long long)seed,
         scene.body_count, seconds() - begin);

  nsvcd_plan_options options;
  memset(&options, 0, sizeof options);  // the defaults, but:
  // rather a wider way than a wire missed: the decision shifts towards "hits"
  options.sweep.network.recall = 0.999f;

  int good = 0;
  for (int i = 0; i < scene.problem_count; i++) {
    task_select(&scene, i);  // the dish of problem i is in the hand; those before stand in the rack
    if (!planner_plan(&user, bodies, &options, NULL, &motion)) return 1;
    planner_judge(&scene, &motion);
    planner_report(&scene, &motion);
    draw_motion(svg, 24 + 516 * i, &scene, &motion);
    good += motion.good;
  }
  printf("%d of %d motions are free by the oracle and reach their goal; see %s\n", good,
         scene.problem_count, picture);
  int all = draw_close(svg) && good == scene.problem_count;
  planner_free(&scene, bodies);
  task_free(&scene);
  return !all;
}
