// bimanual_insertion.c - two arms, twelve joints: the left hand puts a peg into the hole of a block
// that the right hand holds. Both move.
//
//   build/bimanual_insertion [SEED] [PICTURE.svg]     ends with 0 if the exact oracle finds the
//                                                     motion free
//
// Peg and block are bodies like the arms' own: only planner_place knows that they are held
// (planner_plan in task_planner.h is the code to copy).
#define _POSIX_C_SOURCE 200112L  // scenery/clock.h
#define NEURALSVCD_IMPLEMENTATION
#include "task_planner.h"

// Left: both arms at the start and, in between, where the peg and the block come along. Right: the
// same way as seen from the block.
static void draw_motion(FILE *svg, const task_scene *scene, const planner_motion *motion) {
  const int peg = scene->held[0];
  const int block = scene->held[1];
  const int hand = 3;
  const int ghosts = 6;
  const float *start = scene->problems[0].start;
  const float *goal = scene->problems[0].goal;
  const double m = TASK_PI / 2;
  draw_view view = {0.35, 0.4, {0.22, 0, 0.72}, 650, 640, 520};
  draw_view near = {0, 0.3, {0, 0, 0}, 650, 640, 520};
  draw_list list = {&view, NULL, 0, 0, 0};
  draw_panel(svg, 24, 84, &view);
  draw_still(&list, scene);
  draw_robot(&list, scene, start, &planner_pale, &draw_orange, 0.4);
  for (int i = 1; i < ghosts; i++) {
    const float *joints = planner_joints_at(scene, motion, (double)i / ghosts);
    planner_ghost(&list, scene, joints, peg, -1, &draw_orange, 0.35);
    if (i % 2 == 0) planner_ghost(&list, scene, joints, block, -1, &draw_wood, 0.3);
  }
  draw_robot(&list, scene, goal, &planner_pale, &draw_orange, 1);
  draw_flush(svg, &list);
  planner_ways(svg, &view, scene, motion, peg, -1);
  planner_label(svg, &view, scene, start, peg, -1, 0, -8, "start");
  planner_label(svg, &view, scene, goal, block, -1, -30, 36, "goal");
  draw_panel_end(svg, &view,
                 motion->good ? "one hand brings the peg, the other the block" : "NOT FREE");

  // Looks across the way from the start to the hole's axis.
  oracle_pose from = planner_pose(scene, start, peg, block);
  near.azimuth = atan2(from.position[1], from.position[0]) + m;
  planner_fit(&near, scene, motion, block, block, 0.12);
  list.view = &near;
  draw_panel(svg, 24 + 670, 84, &near);
  for (int i = 0; i <= 8; i++)
    planner_ghost(&list, scene, planner_joints_at(scene, motion, i / 8.0), peg, block, &draw_orange,
                  i % 8 ? 0.3 : 0.9);
  planner_ghost(&list, scene, start, hand, block, &planner_pale, 0.5);
  planner_ghost(&list, scene, goal, hand, block, &planner_pale, 0.9);
  planner_ghost(&list, scene, goal, block, block, &draw_wood, 0.55);
  draw_flush(svg, &list);
  planner_ways(svg, &near, scene, motion, peg, block);
  planner_label(svg, &near, scene, start, peg, block, 0, 24, "start");
  planner_label(svg, &near, scene, goal, peg, block, 0, 24, "goal");
  planner_label(svg, &near, scene, goal, block, block, 80, 60, "block");
  draw_panel_end(svg, &near, "the same, as seen from the block");
}

int main(int argc, char **argv) {
  static task_scene scene;
  static planner_motion motion;
  const nsvcd_body *bodies[TASK_MAX_BODIES];
  planner_user user = {&scene, 0};
  uint64_t seed = 2;
  const char *picture = "build/bimanual_insertion.svg";
  if (!planner_arguments(argc, argv, &seed, &picture, NULL)) return 2;
  if (!task_bimanual_episode(&scene, seed))
    return fprintf(stderr, "no scene comes of this seed: try another\n"), 1;

  FILE *svg = draw_open(picture, 24 + 2 * 670 + 4, 520 + 108, "Two arms put a peg into a hole",
                        PLANNER_LEGEND);
  if (!svg) return 1;
  double begin = seconds();
  if (!planner_encode(&scene, bodies)) return 1;
  printf("%s, seed %llu: %d bodies encoded in %.2f s, %d pairs that can meet\n", scene.name,
         (unsigned long long)seed, scene.body_count, seconds() - begin, scene.pair_count);

  if (!planner_plan(&user, bodies, NULL, NULL, &motion)) return 1;  // NULL: the defaults will do
  planner_judge(&scene, &motion);
  planner_report(&scene, &motion);

  draw_motion(svg, &scene, &motion);
  if (!draw_close(svg)) return 1;
  printf("see %s\n", picture);
  planner_free(&scene, bodies);
  task_free(&scene);
  return !motion.good;
}
