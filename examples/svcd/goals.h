// goals.h - goals of a plan as configurations: those that have a body at a pose are found.
#ifndef NSVCD_SVCD_GOALS_H
#define NSVCD_SVCD_GOALS_H

#include "settings.h"

// configurations that a goal by a pose comes down to, at most
#define GOAL_ROWS 16

// What the goals of a plan come down to.
typedef struct plan_goals {
  nsvcd_reach_answer *reached;  // (goals of the file): of those by poses
  double *rows;                 // (rows, joints)
  size_t row_count;
} plan_goals;

static void free_goals(plan_goals *g) {
  free(g->reached);
  free(g->rows);
}

// Of a pose that is reached in contact only, the best configuration is a row, so that a route says what
// is wrong with it.
static nsvcd_result find_goals(const robot_in_room *in, const robot_task *task,
                               const settings *options, const nsvcd_route_problem *problem,
                               plan_goals *g) {
  const robot_file *file = in->file;
  const size_t joints = file->joint_count;
  nsvcd_result result = NSVCD_OK;
  g->reached = (nsvcd_reach_answer *)allocate(file->goal_count * sizeof *g->reached);
  g->rows = (double *)allocate(GOAL_ROWS * task->goal_count * joints * sizeof *g->rows);
  for (size_t i = 0; i < file->goal_count && !result; i++) {
    const robot_goal *goal = &file->goals[i];
    double *row = g->rows + g->row_count * joints;
    nsvcd_reach_problem asked;
    nsvcd_reach_options how;
    if (&file->tasks[goal->task] != task) continue;
    if (goal->thing == NSVCD_NONE) {
      memcpy(row, file->numbers + goal->first, joints * sizeof *row);
      g->row_count++;
      continue;
    }
    const robot_thing *thing = &file->things[goal->thing];
    memset(&asked, 0, sizeof asked);
    memset(&how, 0, sizeof how);
    asked.start = problem->start;
    asked.link = thing->link;
    asked.tool = thing->pose;
    asked.target = goal->pose;
    memcpy(asked.half, goal->half, sizeof asked.half);
    memcpy(asked.free_axis, goal->free_axis, sizeof asked.free_axis);
    asked.stop = problem->stop;
    asked.user = problem->user;
    asked.held = problem->held;
    how.seed = options->seed;
    // the route says which goals are free, once it is known near which ones something may touch
    how.may_touch = in->scene.allowance_count > 0;
    nsvcd_reach_answer *answer = &g->reached[i];
    result = nsvcd_reach(in->checker, &asked, &how, row, GOAL_ROWS, answer);
    if (!result && !answer->solutions && answer->reached)
      memcpy(row, answer->best, joints * sizeof *row);
    if (!result) g->row_count += answer->solutions + (!answer->solutions && answer->reached);
  }
  return result;
}

#endif
