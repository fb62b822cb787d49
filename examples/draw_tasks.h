// draw_tasks.h - draws scenes of tasks.h (scenery/draw.h): what stands still, the robot at any
// number of configurations, solid or as ghosts, and the lines that things move along.
//
//   draw_floor(&list, &scene), draw_flush(svg, &list);  // first, as everything stands on it
//   draw_still(&list, &scene), draw_robot(&list, &scene, joints, &draw_blue, &draw_orange, 1);
//   draw_flush(svg, &list);
#ifndef NSVCD_EXAMPLES_DRAW_TASKS_H
#define NSVCD_EXAMPLES_DRAW_TASKS_H

#include "scenery/draw.h"
#include "scenery/tasks.h"

// A foot that does not travel, a torso.
DRAW_DEF int draw_is_fixed(const task_scene *scene, const task_body *body) {
  return body->kind == TASK_ROBOT && body->link <= scene->foot && !scene->joints[0].slides;
}
DRAW_DEF void draw_floor(draw_list *list, const task_scene *scene) {
  for (int i = 0; i < scene->body_count; i++)
    if (scene->bodies[i].kind == TASK_FLOOR)
      draw_solid(list, &scene->bodies[i].exact, &scene->bodies[i].offset, &draw_cream, 1);
}
// Lists what stands still. Rock towards the viewer is left out, as it would hide what goes on
// behind it.
DRAW_DEF void draw_still(draw_list *list, const task_scene *scene) {
  for (int i = 0; i < scene->body_count; i++) {
    const task_body *body = &scene->bodies[i];
    int rock = strstr(body->name, "rock") && !strstr(body->name, "heap");
    double center[3];
    oracle_transform(&body->offset, body->exact.center, center);
    if (draw_is_fixed(scene, body)) draw_solid(list, &body->exact, &body->offset, &draw_steel, 1);
    if (body->kind != TASK_SCENE) continue;
    if (rock && center[1] * sin(list->view->azimuth) > 0) continue;
    int wood =
        strstr(body->name, "beam") || strstr(body->name, "frame") || strstr(body->name, "prop");
    int dark = rock || strstr(body->name, "coal") || strstr(body->name, "heap");
    const draw_colour *colour = wood                          ? &draw_wood
                                : dark                        ? &draw_rock
                                : strstr(body->name, "wagon") ? &draw_steel
                                : !strcmp(body->name, "rack") ? &draw_iron
                                                              : &draw_china;
    draw_solid(list, &body->exact, &body->offset, colour, 1);
  }
}
// The robot and what it holds. Opacity below 1 makes a ghost.
DRAW_DEF void draw_robot(draw_list *list, const task_scene *scene, const float *joints,
                         const draw_colour *robot, const draw_colour *held, double opacity) {
  double q[TASK_MAX_JOINTS];
  oracle_pose links[TASK_MAX_JOINTS + 1];
  for (int j = 0; j < scene->joint_count; j++) q[j] = (double)joints[j];
  task_links(scene, q, links);
  for (int i = 0; i < scene->body_count; i++) {
    oracle_pose pose = task_body_pose(scene, i, links);
    const task_body *body = &scene->bodies[i];
    if (!task_moves(body) || draw_is_fixed(scene, body)) continue;
    const draw_colour *colour = body->kind == TASK_ROBOT      ? robot
                                : strcmp(body->name, "block") ? held
                                                              : &draw_wood;
    draw_solid(list, &body->exact, &pose, colour, opacity);
  }
}
// The line along which the origin of `body` moves. joints: (samples, joint_count).
DRAW_DEF void draw_trace(FILE *svg, const draw_view *view, const task_scene *scene, int body,
                         const float *joints, int samples, const char *ink) {
  fprintf(svg,
          "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2.5\" stroke-linejoin=\"round\" d=\"",
          ink);
  for (int s = 0; s < samples; s++) {
    double q[TASK_MAX_JOINTS];
    oracle_pose links[TASK_MAX_JOINTS + 1];
    for (int j = 0; j < scene->joint_count; j++) q[j] = (double)joints[s * scene->joint_count + j];
    task_links(scene, q, links);
    const oracle_pose pose = task_body_pose(scene, body, links);
    draw_to(svg, view, s == 0, pose.position);
  }
  fprintf(svg, "\"/>\n");
}

#endif
