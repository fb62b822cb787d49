// task_planner.h - from a task (tasks.h) to a checked motion, for the examples that plan:
// dish_insertion.c, bimanual_insertion.c, mining_site.c.
//
// planner_plan is what to copy: it states the problem for nsvcd_plan, plans, and samples the
// result. The rest encodes, judges with the exact oracle, reports and draws.
#ifndef NSVCD_EXAMPLES_TASK_PLANNER_H
#define NSVCD_EXAMPLES_TASK_PLANNER_H

#include "draw_tasks.h"
#include "scenery/clock.h"

#include <errno.h>

#define PLANNER_DEF SHAPES_DEF
// patches per body; 256 are faster, but wires and holes are better seen with more
#define PLANNER_POINTS 512
#define PLANNER_SAMPLES 201  // samples of a motion, for the oracle and the pictures

// What nsvcd_plan's callbacks get: one pointer serves them all.
typedef struct planner_user {
  task_scene *scene;
  // seconds() at which to give up; only for a progress callback that looks at it
  double until;
} planner_user;

typedef struct planner_motion {
  // (PLANNER_SAMPLES, joint_count), uniform in time
  float joints[PLANNER_SAMPLES * TASK_MAX_JOINTS];
  double metres[PLANNER_SAMPLES];  // way that the held thing has come by then
  nsvcd_plan_answer answer;        // the network's opinion
  task_verdict verdict;            // the oracle's
  double seconds;
  // 1: free, within the limits, from the start to the goal, by the oracle
  int good;
  float naive_hit[TASK_MAX_JOINTS];  // where the straight line in joint space first hits something,
  int naive_hits;                    // if it does
} planner_motion;

// ------------------------------------------------------------------------------------------ encode

// Encodes all bodies; planner_free gives them back. 0, with a message, if that fails.
PLANNER_DEF void planner_free(const task_scene *scene, const nsvcd_body **bodies) {
  for (int i = 0; i < scene->body_count; i++) nsvcd_body_free(bodies[i], NULL);
}
PLANNER_DEF int planner_encode(const task_scene *scene, const nsvcd_body **bodies) {
  nsvcd_encode_options options;
  nsvcd_result result = NSVCD_OK;
  memset(&options, 0, sizeof options);
  options.patches = PLANNER_POINTS;
  options.latents = 1;
  for (int i = 0; i < scene->body_count; i++) bodies[i] = NULL;
  for (int i = 0; i < scene->body_count && !result; i++)
    result = nsvcd_encode(&scene->bodies[i].mesh, &options, NULL, NULL, 0, &bodies[i]);
  if (!result) return 1;
  fprintf(stderr, "encode: %s\n", nsvcd_result_string(result));
  planner_free(scene, bodies);
  return 0;
}

// -------------------------------------------------------------------------------------------- plan

// Forward kinematics: tells where all bodies are at these joint values, those that stand still too.
// It computes in doubles, and still takes less than one of the ten or more microseconds that a
// segment of a trajectory costs: a faster version is not worth it.
PLANNER_DEF void planner_place(void *user, const float *joints, nsvcd_pose *poses) {
  task_place(((planner_user *)user)->scene, joints, poses);
}

// Plans the selected problem of the scene. Returns 1 if there is a motion to look at, of whatever
// worth: see motion->answer.status; 0 after a message.
PLANNER_DEF int planner_plan(planner_user *user, const nsvcd_body *const *bodies,
                             const nsvcd_plan_options *options,
                             int (*progress)(void *user, const nsvcd_plan_progress *progress),
                             planner_motion *motion) {
  const task_scene *scene = user->scene;
  const size_t joints = (size_t)scene->joint_count;
  float control[(NSVCD_MAX_VIA_POINTS + 2) * TASK_MAX_JOINTS];
  task_statement statement;
  task_state(scene, bodies, &statement);
  nsvcd_plan_problem problem = statement.problem;
  problem.kinematics = planner_place;
  problem.progress = progress;
  problem.user = user;

  double begin = seconds();
  // malloc's memory is aligned well enough on 64-bit
  size_t size = nsvcd_plan_workspace_size(&problem, options);
  void *workspace = malloc(size);
  nsvcd_result result = nsvcd_plan(&problem, options, workspace, size, control, &motion->answer);
  motion->seconds = seconds() - begin;
  free(workspace);
  if (result) return fprintf(stderr, "plan: %s\n", nsvcd_result_string(result)), 0;

  // a controller would ask for as many as it needs, and for derivatives
  for (int s = 0; s < PLANNER_SAMPLES; s++)
    nsvcd_spline(control, motion->answer.via_points, joints, (float)s / (PLANNER_SAMPLES - 1), 0,
                 motion->joints + (size_t)s * joints);
  return 1;
}

// ------------------------------------------------------------------------------------------- judge

// Asks the exact oracle, and whether a plan was needed at all.
PLANNER_DEF void planner_judge(const task_scene *scene, planner_motion *motion) {
  const int n = scene->joint_count;
  const int held = scene->held[scene->selected];
  const task_problem *problem = &scene->problems[scene->selected];
  double line[2 * TASK_MAX_JOINTS], d[3];
  task_verdict naive = {0, 1, 1, {0, 0}, 0};
  nsvcd_pose poses[TASK_MAX_BODIES];
  motion->good = task_check(scene, motion->joints, PLANNER_SAMPLES, &motion->verdict);
  for (int s = 0; s < PLANNER_SAMPLES; s++) {
    float before[3];
    memcpy(before, poses[held].position, sizeof before);
    task_place((void *)scene, motion->joints + s * n, poses);
    for (int k = 0; k < 3 && s; k++) d[k] = (double)(poses[held].position[k] - before[k]);
    motion->metres[s] = s ? motion->metres[s - 1] + oracle_length(d) : 0;
  }
  for (int j = 0; j < n; j++) {
    line[j] = (double)problem->start[j];
    line[n + j] = (double)problem->goal[j];
  }
  motion->naive_hits = !task_keeps(scene, line, 2, 0, &naive);
  for (int j = 0; motion->naive_hits && j < n; j++)
    motion->naive_hit[j] = (float)(line[j] + naive.time * (line[n + j] - line[j]));
}
// Prints what a motion took, what it is worth, and by whose word.
PLANNER_DEF void planner_report(const task_scene *scene, const planner_motion *motion) {
  const nsvcd_plan_answer *answer = &motion->answer;
  const task_verdict *v = &motion->verdict;
  const task_body *bodies = scene->bodies;
  // What was cancelled may be free all the same; what ran into its limit of iterations is not.
  int claims = answer->status == NSVCD_PLAN_CONVERGED ||
               (answer->status == NSVCD_PLAN_CANCELLED && answer->logit < 0);
  printf("%s: %s in %.2f s (%zu trajectories, %zu sweeps), moves %.2f m\n  the proof:   %s",
         bodies[scene->held[scene->selected]].name, nsvcd_plan_status_string(answer->status),
         motion->seconds, answer->trajectories, answer->sweeps, motion->metres[PLANNER_SAMPLES - 1],
         claims ? "free" : "not free");
  if (answer->seeds && answer->pair != NSVCD_NONE) {  // else nothing was planned, or nothing met
    const int *pair = scene->pairs[answer->pair];     // the problem's pairs are in the same order
    printf(" (%s and %s at t = %.2f)", bodies[pair[1]].name, bodies[pair[0]].name,
           (double)answer->time);
  }
  printf("\n  the oracle:  ");
  if (motion->good)
    printf("free, within the limits, at the goal");
  else if (!v->free)
    printf("%s meets %s at t = %.2f", bodies[v->pair[1]].name, bodies[v->pair[0]].name, v->time);
  else
    printf("%s", v->in_limits ? "does not reach the goal" : "a joint leaves its limits");
  printf("%s\n", claims == motion->good ? "" : "  <- THEY DISAGREE");
}

// ------------------------------------------------------------------------------------ command line

// Reads the arguments [SEED] [PICTURE.svg], and [SECONDS] if `patience` is not NULL. Returns 0,
// after a message, if they are something else.
PLANNER_DEF int planner_arguments(int argc, char **argv, uint64_t *seed, const char **picture,
                                  double *patience) {
  char *end = NULL;
  char *rest = NULL;
  errno = 0;
  if (argc > 1) *seed = strtoull(argv[1], &end, 10);
  int good = argc <= (patience ? 4 : 3) &&
             (argc < 2 || (argv[1][0] >= '0' && argv[1][0] <= '9' && !*end && !errno));
  if (argc > 2) {
    *picture = argv[2];
    good = good && argv[2][0] && argv[2][0] != '-';
  }
  if (good && argc > 3) {
    *patience = strtod(argv[3], &rest);
    good = rest != argv[3] && !*rest && *patience >= 0;
  }
  if (!good)
    fprintf(stderr, "usage: %s [SEED] [PICTURE.svg]%s\nSEED is a whole number from 0.%s\n", argv[0],
            patience ? " [SECONDS]" : "", patience ? " SECONDS is when to stop planning." : "");
  return good;
}

// -------------------------------------------------------------------------------------------- draw

#define PLANNER_WAY "#c75c12"
#define PLANNER_HIT "#c22f3a"
#define PLANNER_INK(ink, text) "<tspan font-weight=\"700\" fill=\"" ink "\">" text "</tspan>"
#define PLANNER_LEGEND                                    \
  PLANNER_INK(PLANNER_WAY, "orange: the way planned")     \
  ", from &#x201c;start&#x201d; to &#x201c;goal&#x201d; " \
  "&#160;&#183;&#160; " PLANNER_INK(                      \
      PLANNER_HIT, "red: the straight line in joint space") ", up to where it hits"

static const draw_colour planner_pale = {{110, 130, 160}, {214, 226, 242}};

// The joints when the held thing has come `share` of its way, in space, not in time.
PLANNER_DEF const float *planner_joints_at(const task_scene *scene, const planner_motion *motion,
                                           double fraction) {
  int s = 0;
  while (s + 1 < PLANNER_SAMPLES &&
         motion->metres[s] < fraction * motion->metres[PLANNER_SAMPLES - 1])
    s++;
  return motion->joints + s * scene->joint_count;
}
// One body at some joint values, `frame` being where it is seen from (-1: the world).
PLANNER_DEF oracle_pose planner_pose(const task_scene *scene, const float *joints, int body,
                                     int frame) {
  double q[TASK_MAX_JOINTS];
  oracle_pose links[TASK_MAX_JOINTS + 1];
  for (int j = 0; j < scene->joint_count; j++) q[j] = (double)joints[j];
  task_links(scene, q, links);
  oracle_pose pose = task_body_pose(scene, body, links);
  if (frame < 0) return pose;
  oracle_pose base = task_body_pose(scene, frame, links);
  return task_relative(&base, &pose);
}
// Brings the way of the held thing and body `also` into the view's middle, and `margin` metres
// around them.
PLANNER_DEF void planner_fit(draw_view *view, const task_scene *scene, const planner_motion *motion,
                             int also, int frame, double margin) {
  double low[2] = {HUGE_VAL, HUGE_VAL};
  double high[2] = {-HUGE_VAL, -HUGE_VAL};
  double p[3];
  const double sa = sin(view->azimuth);
  const double ca = cos(view->azimuth);
  const double se = sin(view->elevation);
  const double ce = cos(view->elevation);
  for (int s = -1; s < PLANNER_SAMPLES; s++) {
    const float *joints = motion->joints + (s < 0 ? 0 : s * scene->joint_count);
    draw_project(
        view,
        planner_pose(scene, joints, s < 0 ? also : scene->held[scene->selected], frame).position,
        p);
    for (int k = 0; k < 2; k++) {
      low[k] = fmin(low[k], p[k]);
      high[k] = fmax(high[k], p[k]);
    }
  }
  const double right = ((low[0] + high[0]) / 2 - view->width / 2.0) / view->scale;
  const double up = (view->height / 2.0 - (low[1] + high[1]) / 2) / view->scale;
  view->look_at[0] += -sa * right - se * ca * up;
  view->look_at[1] += ca * right - se * sa * up;
  view->look_at[2] += ce * up;
  view->scale = fmin(view->width / ((high[0] - low[0]) / view->scale + 2 * margin),
                     view->height / ((high[1] - low[1]) / view->scale + 2 * margin));
}
PLANNER_DEF void planner_ghost(draw_list *list, const task_scene *scene, const float *joints,
                               int body, int frame, const draw_colour *colour, double opacity) {
  oracle_pose pose = planner_pose(scene, joints, body, frame);
  draw_solid(list, &scene->bodies[body].exact, &pose, colour, opacity);
}
// The line along which the body's origin moves. joints: (count, joint_count).
PLANNER_DEF void planner_line(FILE *svg, const draw_view *view, const task_scene *scene,
                              const float *joints, int count, int body, int frame,
                              const char *style) {
  fprintf(svg, "<path fill=\"none\" stroke-linejoin=\"round\" stroke-width=\"3\" %s d=\"", style);
  for (int s = 0; s < count; s++) {
    const oracle_pose pose = planner_pose(scene, joints + s * scene->joint_count, body, frame);
    draw_to(svg, view, s == 0, pose.position);
  }
  fprintf(svg, "\"/>\n");
}
// The plan, and the straight line up to a cross where it hits.
PLANNER_DEF void planner_ways(FILE *svg, const draw_view *view, const task_scene *scene,
                              const planner_motion *motion, int body, int frame) {
  const int n = scene->joint_count;
  float line[50 * TASK_MAX_JOINTS];
  double p[3];
  for (int s = 0; s < 50 && motion->naive_hits; s++)
    for (int j = 0; j < n; j++)
      line[s * n + j] =
          motion->joints[j] + (float)s / 49 * (motion->naive_hit[j] - motion->joints[j]);
  planner_line(svg, view, scene, motion->joints, PLANNER_SAMPLES, body, frame,
               "stroke=\"" PLANNER_WAY "\"");
  if (!motion->naive_hits) return;
  planner_line(svg, view, scene, line, 50, body, frame,
               "stroke=\"" PLANNER_HIT "\" stroke-dasharray=\"7 5\"");
  draw_project(view, planner_pose(scene, motion->naive_hit, body, frame).position, p);
  for (int pass = 0; pass < 2; pass++)
    fprintf(svg,
            "<path d=\"M%.1f %.1fl18 18m0 -18l-18 18\" stroke=\"%s\" stroke-width=\"%d\" "
            "stroke-linecap=\"round\"/>\n",
            p[0] - 9, p[1] - 9, pass ? PLANNER_HIT : "#fff", pass ? 5 : 9);
}
// A word with a halo, `dx`, `dy` pixels off the body's origin.
PLANNER_DEF void planner_label(FILE *svg, const draw_view *view, const task_scene *scene,
                               const float *joints, int body, int frame, double dx, double dy,
                               const char *text) {
  double p[3];
  draw_project(view, planner_pose(scene, joints, body, frame).position, p);
  fprintf(svg,
          "<text x=\"%.0f\" y=\"%.0f\" font-size=\"16\" font-weight=\"700\" text-anchor=\"middle\" "
          "fill=\"" DRAW_INK
          "\" stroke=\"#fff\" stroke-width=\"4\" stroke-linejoin=\"round\" "
          "paint-order=\"stroke\">%s</text>\n",
          p[0] + dx, p[1] + dy, text);
}

#endif
