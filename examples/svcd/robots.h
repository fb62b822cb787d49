// robots.h - svcd plan, path and pairs: motions of a robot, found and proven; which of its bodies
// can meet.
#ifndef NSVCD_SVCD_ROBOTS_H
#define NSVCD_SVCD_ROBOTS_H

#include "seeds.h"
#include "srdf.h"

#define PLAN_NODES 100000
// seconds: to which the first conflict of motions together is sought
#define FIRST_CONFLICT 1e-3
// that `pairs` takes, and the proof of a pair, at most
#define PAIRS_SECONDS 10.0
// units of its first search of each pair
#define PAIRS_UNITS 400000
// about each mesh of a link
#define LINK_BALLS 128

// Is an ID in a list "a,b"? In NULL all are.
static int is_listed(const char *list, const char *id) {
  const size_t length = strlen(id);
  while (list && *list) {
    const size_t word = strcspn(list, ",");
    if (word == length && strncmp(list, id, word) == 0) return 1;
    list += word + (list[word] == ',');
  }
  return !list;
}

static int plan_options(const settings *options, const char *command) {
  if (options->path_count != 1)
    return usage_error(command, "expected a planning file ('svcd plan --help')");
  if ((options->samples > 0) != (options->joints != NULL))
    return usage_error("--samples", "together with --joints OUT.tsv");
  if (options->joints && !ends_with(options->joints, ".tsv"))
    return usage_error("--joints", "expected a file that ends in .tsv");
  if (options->srdf && !ends_with(options->srdf, ".srdf"))
    return usage_error("--srdf", "expected a file that ends in .srdf");
  const char *pictures[2] = {options->picture, options->film};
  for (size_t k = 0; k < 2; k++) {
    const char *name = k ? "--film" : "--picture";
    if (!pictures[k]) continue;
    if (!ends_with(pictures[k], ".svg"))
      return usage_error(name, "expected a file that ends in .svg");
    if (!options->only || strchr(options->only, ',')) return usage_error(name, "--only one plan");
    if (!draw_may_write(pictures[k])) return REFUSED;
  }
  return DONE;
}

// The length of a motion in joint space, radians and metres alike, by 16 chords a piece.
static double route_length(const nsvcd_joint_motion *m, size_t joints) {
  double length = 0;
  double q[2][NSVCD_MAX_JOINTS];
  const size_t chords = 16 * m->pieces;
  nsvcd_motion_at(m, joints, 0, q[0]);
  for (size_t k = 1; k <= chords; k++) {
    double sum = 0;
    const double *times = m->times + (k - 1) / 16;
    nsvcd_motion_at(m, joints, times[0] + (times[1] - times[0]) * (double)((k - 1) % 16 + 1) / 16,
                    q[k % 2]);
    for (size_t j = 0; j < joints; j++) sum += (q[1][j] - q[0][j]) * (q[1][j] - q[0][j]);
    length += sqrt(sum);
  }
  return length;
}

// Prints all pairs that are as near as the clearance on standard error.
static void tell_pairs(const robot_in_room *in, const char *from, const double *joints) {
  nsvcd_proximity_options options;
  size_t count = 0;
  nsvcd_proximity *gaps = (nsvcd_proximity *)allocate((in->scene.pair_count + 1) * sizeof *gaps);
  memset(&options, 0, sizeof options);
  options.max_distance = 1e-6f;
  for (size_t k = 0; k < in->scene.pair_count; k++)
    if (in->clearances[k] > options.max_distance) options.max_distance = in->clearances[k];
  options.max_depth = 0.1f;
  if (nsvcd_proximities(in->checker, joints, &options, gaps, in->scene.pair_count, &count))
    count = 0;
  for (size_t k = 0; k < count; k++) {
    const nsvcd_proximity *gap = &gaps[k];
    const nsvcd_body_pair *pair = &in->scene.pairs[gap->pair];
    const char *a = robot_name(in, pair->a);
    const char *b = robot_name(in, pair->b);
    if (gap->verdict == NSVCD_UNDECIDED && gap->why == NSVCD_WHY_OPEN) continue;
    if (gap->verdict == NSVCD_FREE && gap->distance.low > in->clearances[gap->pair]) continue;
    if (gap->verdict != NSVCD_HIT)
      complain("%s: %s and %s are %.2f mm apart", from, a, b, 1e3 * (double)gap->distance.high);
    else if (gap->depth < HUGE_VALF)
      complain("%s: %s and %s meet, %.2f mm deep", from, a, b, 1e3 * (double)gap->depth);
    else
      complain("%s: %s and %s meet, no push-out of 100 mm separates them", from, a, b);
  }
  free(gaps);
}

// Prints the nearest free configuration that was found.
static void tell_way_out(const robot_in_room *in, const char *from, const double *joints,
                         const nsvcd_route_problem *problem) {
  nsvcd_nearest_free_options nearest;
  int is_found = 0;
  double out[NSVCD_MAX_JOINTS];
  memset(&nearest, 0, sizeof nearest);
  nearest.stop = problem->abandon;
  nearest.user = problem->user;
  if (!nsvcd_nearest_free(in->checker, joints, &nearest, out, &is_found) && is_found) {
    char list[32 * NSVCD_MAX_JOINTS] = "";
    for (size_t j = 0; j < in->file->joint_count; j++)
      snprintf(list + strlen(list), sizeof list - strlen(list), " %.9g", out[j]);
    complain("%s: free near by:%s", from, list);
  } else {
    complain("%s: nothing free was found near by", from);
  }
}

// Says on standard error why it is unknown whether two bodies meet, or an axis is kept.
static void tell_undecided(const robot_in_room *in, const char *from,
                           const nsvcd_check_answer *found) {
  if (found->cone != NSVCD_NONE) {
    const char *name = robot_name(in, in->scene.cones[found->cone].part);
    complain("%s: %s is too near the edge of what it is to keep to tell", from, name);
    return;
  }
  const nsvcd_body_pair *pair = &in->scene.pairs[found->pair];
  const char *a = robot_name(in, pair->a);
  const char *b = robot_name(in, pair->b);
  if (found->why == NSVCD_WHY_OPEN)
    complain(
        "%s: a part of %s or %s seems to be inside the other, which is nearly a solid but not "
        "closed (say --open if it is a sheet)",
        from, a, b);
  else if (found->why == NSVCD_WHY_WORK)
    complain("%s: %s and %s take more work than is allowed", from, a, b);
  else
    complain("%s: %s and %s are too near each other to tell", from, a, b);
}

// Says on standard error which axis is not kept, or may not be, and by how much it is off.
static void tell_cone(const robot_in_room *in, const char *from, const double *joints, size_t n) {
  const nsvcd_cone *cone = &in->scene.cones[n];
  const size_t parts = in->scene.part_count;
  nsvcd_pose *poses = (nsvcd_pose *)allocate(parts * sizeof *poses);
  nsvcd_forward_kinematics(in->checker, joints, poses);
  const float *r = poses[cone->part].rotation;
  const double q[4] = {(double)r[0], (double)r[1], (double)r[2], (double)r[3]};
  const double d[3] = {(double)cone->direction[0], (double)cone->direction[1],
                       (double)cone->direction[2]};
  // a column of its matrix: the axis is x, y or z
  const int k = cone->axis[1] > 0 ? 1 : cone->axis[2] > 0 ? 2 : 0;
  const int l = (k + 1) % 3;
  const int m = (k + 2) % 3;
  const double along = d[k] * (1 - 2 * (q[l] * q[l] + q[m] * q[m])) +
                       2 * d[l] * (q[k] * q[l] + q[3] * q[m]) +
                       2 * d[m] * (q[k] * q[m] - q[3] * q[l]);
  const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const double degrees = 180 / 3.141592653589793;
  const double off = acos(fmax(-1, fmin(1, along / length)));
  free(poses);
  complain("%s: %s is %.6g degrees off, and is to keep within %.6g", from,
           robot_name(in, cone->part), degrees * off, degrees * cone->angle);
}

// Says on standard error what is wrong with a start or a goal.
static void tell_check(const robot_in_room *in, const char *from, const double *joints,
                       const nsvcd_check_answer *found) {
  if (found->joint != NSVCD_NONE) {
    int leads = 0;
    for (size_t j = 0; j < in->file->joint_count; j++)
      leads |= in->file->joints[j].mimic == found->joint + 1;
    complain("%s: joint %s is out of its limits%s", from, in->file->joint_names[found->joint],
             leads ? ", or one that mimics it" : "");
  } else if (found->verdict == NSVCD_UNDECIDED && found->pair != NSVCD_NONE) {
    tell_undecided(in, from, found);
  }
  if (found->cone != NSVCD_NONE) tell_cone(in, from, joints, found->cone);
  tell_pairs(in, from, joints);
}

// Says on standard error what is wrong with each goal of a plan.
static void tell_goals(const robot_in_room *in, const robot_task *task, const plan_goals *g,
                       const nsvcd_route_problem *problem) {
  const robot_file *file = in->file;
  for (size_t i = 0; i < file->goal_count; i++) {
    const robot_goal *goal = &file->goals[i];
    const nsvcd_reach_answer *reached = &g->reached[i];
    const double *row = file->numbers + goal->first;
    char from[1024];
    nsvcd_check_answer found;
    if (&file->tasks[goal->task] != task) continue;
    snprintf(from, sizeof from, "%s:%zu: %s: the goal", file->path, goal->line, task->id);
    if (goal->thing == NSVCD_NONE) {
      const nsvcd_joint_motion still = {0, 0, row, NULL};
      if (nsvcd_check(in->checker, &still, NULL, &found)) continue;
      tell_check(in, from, row, &found);
      tell_way_out(in, from, row, problem);
    } else if (reached->reached) {
      complain("%s: %s is there only in configurations that are not free, the nearest like this",
               from, file->things[goal->thing].name);
      tell_check(in, from, reached->best, &reached->check);
    } else {
      complain("%s: out of reach: %s is %.3f mm and %.3f degrees off, at best%s", from,
               file->things[goal->thing].name, 1e3 * reached->position_error,
               reached->angle_error * (180 / 3.141592653589793),
               in->scene.cone_count ? ", where axes are kept" : "");
    }
  }
}

static const char *plan_word(const nsvcd_route_answer *answer) {
  const int is_undecided =
      answer->check.verdict == NSVCD_UNDECIDED && answer->check.joint == NSVCD_NONE;
  if (answer->status == NSVCD_ROUTE_FOUND) return "certified";
  if (answer->status == NSVCD_ROUTE_START) return is_undecided ? "undecided" : "start";
  if (answer->status == NSVCD_ROUTE_GOAL) return is_undecided ? "undecided" : "goal";
  return "limit";
}

// When the search for a motion ends, and when everything does; the proof has the time in between.
#define SEARCH_SHARE 0.8
typedef struct plan_clock {
  double search_end, end;
} plan_clock;
static int search_is_over(void *user) {
  return seconds() >= ((const plan_clock *)user)->search_end;
}
static int time_is_over(void *user) {
  return seconds() >= ((const plan_clock *)user)->end;
}

static void print_plan(const robot_in_room *in, const robot_task *task, const settings *options,
                       const nsvcd_route_answer *answer, double taken) {
  const int is_found = answer->status == NSVCD_ROUTE_FOUND;
  const double duration = is_found ? answer->duration : HUGE_VAL;
  const double length = is_found ? route_length(&answer->motion, in->file->joint_count) : HUGE_VAL;
  if (options->json) {
    json_out j = {stdout, 0};
    json_open(&j, NULL, '{');
    json_text(&j, "id", task->id);
    json_text(&j, "status", plan_word(answer));
    json_digits(&j, "seconds", taken, 6);
    json_float(&j, "duration", duration);
    json_float(&j, "length", length);
    json_end_line(&j);
  } else if (is_found) {
    printf("%s\t%s\t%.6f\t%.9g\t%.9g\n", task->id, plan_word(answer), taken, duration, length);
  } else {
    printf("%s\t%s\t%.6f\tnan\tnan\n", task->id, plan_word(answer), taken);
  }
  // a reader need not wait for the next plan
  fflush(stdout);
}

static void write_samples(const robot_task *task, const nsvcd_route_answer *answer, size_t joints,
                          size_t samples, FILE *out) {
  for (size_t k = 0; k < samples; k++) {
    double q[NSVCD_MAX_JOINTS];
    const double fraction = (double)k / (double)(samples - 1);
    nsvcd_motion_at(&answer->motion, joints, answer->duration * fraction, q);
    fprintf(out, "%s\t%zu", task->id, k);
    for (size_t j = 0; j < joints; j++) fprintf(out, "\t%.17g", q[j]);
    fprintf(out, "\n");
  }
  fflush(out);
}

// Has something been attached, released or allowed in the scene of a plan, above it?
static int has_steps_above(const robot_file *file, const robot_task *task) {
  const size_t number = (size_t)(task - file->tasks);
  int has = 0;
  for (size_t k = 0; k < file->allow_count; k++)
    has |= robot_is_allowed(&file->allows[k], number, task->room);
  for (size_t k = 0; k < file->change_count; k++) {
    const size_t at = file->changes[k].task;
    has |= at <= number && file->tasks[at].room == task->room;
  }
  return has;
}

// Says what became of a plan, in all the ways that were asked for. Returns 0 after a complaint.
static int tell_plan(const robot_in_room *in, const robot_task *task, const settings *options,
                     const nsvcd_route_answer *answer, double taken, FILE *out) {
  const nsvcd_joint_motion *m = &answer->motion;
  const int is_found = answer->status == NSVCD_ROUTE_FOUND;
  int good = 1;
  print_plan(in, task, options, answer, taken);
  if (is_found && out) write_samples(task, answer, in->file->joint_count, options->samples, out);
  if (is_found && options->picture) good = robot_draw(options->picture, 0, in, task->id, m);
  if (is_found && options->film) good &= robot_draw(options->film, 1, in, task->id, m);
  if (options->certificates)
    good &= write_motion_proof(in, options->certificates, (size_t)(task - in->file->tasks),
                               is_found ? m : NULL, options->visits);
  return good;
}

// end: where the motion ends, if one is found.
static int plan_one(robot_in_room *in, const robot_task *task, const double *start,
                    const settings *options, double *end, int *is_at_end, FILE *out) {
  nsvcd_route_problem problem;
  nsvcd_route_options asked;
  nsvcd_route_answer answer;
  plan_goals goals;
  plan_clock limits = {0, 0};
  int good = 1;
  void *memory = NULL;
  memset(&problem, 0, sizeof problem);
  memset(&asked, 0, sizeof asked);
  memset(&answer, 0, sizeof answer);
  memset(&goals, 0, sizeof goals);
  problem.start = start;
  if (task->group != NSVCD_NONE) problem.held = in->file->groups[task->group].held;
  asked.seed = options->seed;
  asked.nodes = PLAN_NODES;
  const double began = seconds();
  if (options->seconds > 0) {
    problem.stop = search_is_over;
    problem.abandon = time_is_over;
    problem.user = &limits;
    limits.search_end = began + SEARCH_SHARE * (double)options->seconds;
    limits.end = began + (double)options->seconds;
  }
  nsvcd_result result = find_goals(in, task, options, &problem, &goals);
  problem.goals = goals.rows;
  problem.goal_count = goals.row_count;
  answer.status = NSVCD_ROUTE_GOAL;
  const size_t number = (size_t)(task - in->file->tasks);
  if (in->scene.allowance_count > 0)
    good = allow_near(in, number, start, goals.rows, goals.row_count);
  if (!good) {
    free_goals(&goals);
    return 0;
  }
  if (!result && goals.row_count > 0) {
    const size_t seeds = options->threads ? options->threads : 1;
    result = route_by_seeds(&in->scene, in->checker, &problem, &asked, seeds, &answer, &memory);
  } else if (problem.stop && problem.stop(problem.user)) {
    answer.status = NSVCD_ROUTE_LIMIT;
  }
  if (!result) {
    char from[1024];
    snprintf(from, sizeof from, "%s:%zu: %s: the start", in->file->path, task->line, task->id);
    good = tell_plan(in, task, options, &answer, seconds() - began, out);
    *is_at_end = answer.status == NSVCD_ROUTE_FOUND;
    if (*is_at_end) nsvcd_motion_at(&answer.motion, in->file->joint_count, answer.duration, end);
    if (answer.status == NSVCD_ROUTE_START) {
      tell_check(in, from, problem.start, &answer.check);
      tell_way_out(in, from, problem.start, &problem);
    }
    if (answer.status == NSVCD_ROUTE_GOAL) tell_goals(in, task, &goals, &problem);
  }
  free(memory);
  free_goals(&goals);
  if (result) complain("%s:%zu: %s: %s", in->file->path, task->line, task->id, reason_of(result));
  return !result && good;
}

// Asks about an edge until it is decided or time is up. to_time: of what is hit the first hit, to so
// many seconds; 0: any.
static nsvcd_result path_edge(const robot_in_room *in, const nsvcd_joint_motion *motion,
                              double to_time, const settings *options, waiting *wait,
                              nsvcd_check_answer *answer) {
  nsvcd_check_options asked;
  plan_clock limits = {wait->end, wait->end};
  memset(&asked, 0, sizeof asked);
  asked.work = options->sweep.work;
  asked.to_time = to_time;
  for (;;) {
    const double start = seconds();
    nsvcd_check_answer last;
    const nsvcd_result result = nsvcd_check(in->checker, motion, &asked, &last);
    // a check cut short by time names no pair: the answer before it is kept
    if (result || !asked.stop || last.verdict != NSVCD_UNDECIDED) *answer = last;
    if (result || last.verdict != NSVCD_UNDECIDED || last.why != NSVCD_WHY_WORK) return result;
    const size_t work = asked.work ? asked.work : NSVCD_DEFAULT_WORK;
    const size_t more = more_work(wait, work, seconds() - start);
    if (!more) return result;
    asked.work = more;
    asked.stop = time_is_over;
    asked.user = &limits;
  }
}

// An edge of a path, or all of a curve.
static nsvcd_joint_motion motion_of_task(const robot_file *file, const robot_task *task,
                                         size_t edge) {
  const double *points = file->numbers + task->first;
  const double *times = task->times == NSVCD_NONE ? NULL : file->times + task->times;
  const nsvcd_joint_motion path = {task->points > 1, 1, points + edge * file->joint_count, NULL};
  if (!task->degree) return path;
  const nsvcd_joint_motion curve = {(task->points - 1) / task->degree, task->degree, points, times};
  return curve;
}

static void print_path(const robot_in_room *in, const robot_task *task, const settings *options,
                       const nsvcd_check_answer *answer, size_t edge, double when, double mean) {
  const int is_free = answer->verdict == NSVCD_FREE;
  const nsvcd_body_pair *pair =
      is_free || answer->pair == NSVCD_NONE ? NULL : &in->scene.pairs[answer->pair];
  const int is_left = answer->cone != NSVCD_NONE;
  const char *names[2] = {pair ? robot_name(in, pair->a) : "-",
                          pair ? robot_name(in, pair->b) : "-"};
  if (is_left) {
    names[0] = robot_name(in, in->scene.cones[answer->cone].part);
    names[1] = "keep";
  }
  if (options->json) {
    json_out j = {stdout, 0};
    json_open(&j, NULL, '{');
    json_text(&j, "id", task->id);
    json_text(&j, "verdict", nsvcd_verdict_string(answer->verdict));
    if (!is_free) json_count(&j, "edge", edge);
    if (!is_free) json_float(&j, "time", when);
    if (!is_free && task->degree) json_float(&j, "free_until", answer->free_until);
    if (pair || is_left) json_text(&j, "a", names[0]);
    if (pair || is_left) json_text(&j, "b", names[1]);
    json_digits(&j, "microseconds", mean, 4);
    json_end_line(&j);
    fflush(stdout);
    return;
  }
  printf("%s\t%s\t", task->id, nsvcd_verdict_string(answer->verdict));
  if (is_free)
    printf("-1\tnan");
  else
    printf("%zu\t%.9g", edge, when);
  printf("\t%s\t%s\t%.2f\n", names[0], names[1], mean);
  fflush(stdout);
}

// Answers a path, edge by edge, or a curve.
static int path_one(const robot_in_room *in, const robot_task *task, const settings *options) {
  waiting wait = wait_for(options);
  nsvcd_check_answer answer;
  nsvcd_joint_motion motion;
  nsvcd_result result = NSVCD_OK;
  const size_t edges = task->points > 1 && !task->degree ? task->points - 1 : 1;
  const double least = task->is_together ? FIRST_CONFLICT : 0;
  const double to_time = options->first_to > 0 ? (double)options->first_to : least;
  size_t edge = 0;
  char from[1024];
  memset(&answer, 0, sizeof answer);
  const double began = seconds();
  for (size_t k = 0; k < edges && !result; k++) {
    motion = motion_of_task(in->file, task, k);
    edge = k;
    result = path_edge(in, &motion, task->degree ? to_time : 0, options, &wait, &answer);
    if (answer.verdict != NSVCD_FREE) break;
  }
  const size_t pieces = task->degree ? (task->points - 1) / task->degree : edge + 1;
  const double mean = 1e6 * (seconds() - began) / (double)pieces;
  wait_no_more(&wait);
  if (task->degree && answer.piece != NSVCD_NONE) edge = answer.piece;
  if (result)
    return complain("%s:%zu: %s: %s", in->file->path, task->line, task->id, reason_of(result));
  snprintf(from, sizeof from, "%s:%zu: %s", in->file->path, task->line, task->id);
  const int is_told = answer.pair != NSVCD_NONE || answer.cone != NSVCD_NONE;
  if (answer.verdict == NSVCD_UNDECIDED && is_told) tell_undecided(in, from, &answer);
  double when = answer.fraction;
  if (task->is_together && task->degree && edge < pieces)
    when = motion.times[edge] + when * (motion.times[edge + 1] - motion.times[edge]);
  if (task->is_together) edge = 0;
  if (task->is_together && answer.verdict == NSVCD_HIT &&
      when - answer.free_until > 1.001 * to_time)
    complain("%s: not known to be the first: proven free until %.9g s", from, answer.free_until);
  print_path(in, task, options, &answer, edge, when, mean);
  return 1;
}

static int is_asked(const robot_task *task, const settings *options, int is_path) {
  return (task->points > 0) == is_path && is_listed(options->only, task->id);
}

// Is a task asked for in a scene, from one on? Else its bodies need not be there.
static int is_scene_asked(const robot_file *file, const settings *options, int is_path,
                          size_t from) {
  for (size_t i = from; i < file->task_count; i++)
    if (file->tasks[i].room == file->tasks[from].room &&
        is_asked(&file->tasks[i], options, is_path))
      return 1;
  return 0;
}

// Answers plans, or paths, one after another; a failure of one does not stop the others. A checker
// is opened for each plan, and for paths whenever the scene changes.
static int robot_tasks(robot_file *file, const settings *options, int is_path, FILE *out) {
  robot_in_room in;
  double end[NSVCD_MAX_JOINTS];
  int is_at_end = 0;            // the plan before has ended there
  size_t unknown = NSVCD_NONE;  // the scene in which it is not known where things are
  int good = 1;
  const float clearance = options->sweep.clearance;
  memset(&in, 0, sizeof in);
  for (size_t i = 0; i < file->task_count; i++) {
    const robot_task *task = &file->tasks[i];
    const double *start = task->first == NSVCD_NONE ? NULL : file->numbers + task->first;
    if (!is_scene_asked(file, options, is_path, i)) continue;
    if (!start && is_at_end && task->room == file->tasks[i - 1].room) start = end;
    if (!change_things(file, i, start, clearance, &in)) unknown = task->room;
    is_at_end = 0;
    if (!is_asked(task, options, is_path)) continue;
    if (unknown == task->room || !start) {
      good = complain(
          "%s:%zu: %s: not asked: it starts where no plan above has ended, or what was "
          "attached above is not known",
          file->path, task->line, task->id);
      continue;
    }
    // a checker remembers what was hit, and a plan must not depend on those before it
    const int enters = !is_path || file->keep_count > 0 || has_steps_above(file, task) ||
                       in.room != &file->rooms[task->room];
    const size_t points = task->points ? task->points : 1;
    const double *last = start + (points - 1) * file->joint_count;
    if (enters && !(enter_room(file, task->room, clearance, &in) && keep_axes(&in, i) &&
                    allow_near(&in, i, start, last, (size_t)is_path))) {
      good = 0;
      break;
    }
    if (is_path)
      good &= path_one(&in, task, options);
    else
      good &= plan_one(&in, task, start, options, end, &is_at_end, out);
  }
  leave_room(&in);
  return good;
}

// A configuration, as text or as an array.
static void tell_joints(json_out *j, const char *name, const double *q, size_t joints) {
  if (j) json_open(j, name, '[');
  if (!j) printf(" %s at", name);
  for (size_t k = 0; k < joints; k++) j ? json_float(j, NULL, q[k]) : (void)printf(" %.9g", q[k]);
  if (j) json_close(j, ']');
}

static const char *unknown_reason(nsvcd_why why) {
  return why == NSVCD_WHY_WORK   ? "for want of time"
         : why == NSVCD_WHY_OPEN ? "since a mesh is not closed"
                                 : "too near to tell";
}

static void print_pair(const robot_in_room *in, const nsvcd_body_pair *pair, int is_json,
                       const nsvcd_range_answer *found) {
  const char *a = robot_name(in, pair->a);
  const char *b = robot_name(in, pair->b);
  const size_t joints = in->file->joint_count;
  const char *word = nsvcd_meeting_string(found->meeting);
  json_out j = {stdout, 0};
  if (is_json) {
    json_open(&j, NULL, '{');
    json_text(&j, "kind", word);
    json_text(&j, "a", a);
    json_text(&j, "b", b);
    if (found->has_free) tell_joints(&j, "free", found->free, joints);
    if (found->has_hit) tell_joints(&j, "hit", found->hit, joints);
    json_digits(&j, "open", found->open, 3);
    if (found->meeting == NSVCD_MEETS_UNKNOWN) json_text(&j, "why", unknown_reason(found->why));
    json_end_line(&j);
    return;
  }
  if (is_left_out(in->file, pair, found)) {
    printf("# %s %s %s: proven\n", word, a, b);
    return;
  }
  printf("pair %s %s  # %s", a, b, word);
  if (found->has_free) tell_joints(NULL, "free", found->free, joints);
  if (found->has_hit) tell_joints(NULL, "hit", found->hit, joints);
  if (found->meeting == NSVCD_MEETS_UNKNOWN)
    printf(" open %.3g, %s", found->open, unknown_reason(found->why));
  printf("\n");
}

// Asks about all pairs with ever more units, until all are decided or time is up.
static int decide_pairs(const robot_in_room *in, const settings *options, size_t count,
                        const nsvcd_body_pair *asked, nsvcd_range_answer *found) {
  nsvcd_range_options o;
  plan_clock limits = {0, 0};
  size_t left = count;
  memset(&o, 0, sizeof o);
  limits.search_end = limits.end =
      seconds() + (options->seconds > 0 ? (double)options->seconds : PAIRS_SECONDS);
  o.seed = options->seed;
  o.stop = time_is_over;
  o.user = &limits;
  for (o.units = PAIRS_UNITS; left > 0 && o.units < SIZE_MAX / 8; o.units *= 8) {
    const int is_first = o.units == PAIRS_UNITS;
    left = 0;
    for (size_t n = 0; n < count; n++) {
      if (!is_first && (found[n].meeting != NSVCD_MEETS_UNKNOWN || found[n].why != NSVCD_WHY_WORK))
        continue;
      if (!is_first && time_is_over(&limits)) return 1;
      o.clearance = clearance_above(in->file, &asked[n]);
      const size_t size = nsvcd_pair_range_size(in->checker, asked[n], &o);
      void *memory = allocate(size);
      const nsvcd_result result =
          nsvcd_pair_range(in->checker, asked[n], &o, memory, size, &found[n]);
      free(memory);
      if (result) return complain("%s: %s", in->file->path, reason_of(result));
      left += found[n].meeting == NSVCD_MEETS_UNKNOWN && found[n].why == NSVCD_WHY_WORK;
    }
  }
  return 1;
}

// Writes a proof of each two bodies that never meet. pairs: kept. Returns 0 after a complaint.
static int prove_pairs(robot_in_room *in, const settings *options, size_t count,
                       const nsvcd_body_pair *pairs, const nsvcd_range_answer *found) {
  nsvcd_joint joints[NSVCD_MAX_JOINTS];
  const double limit = options->seconds > 0 ? (double)options->seconds : PAIRS_SECONDS;
  int good = 1;
  free(in->clearances);
  in->clearances = (float *)allocate(count * sizeof *in->clearances);
  // a box has values of each joint
  memcpy(joints, in->scene.joints, in->scene.joint_count * sizeof *joints);
  for (size_t j = 0; j < in->scene.joint_count; j++) joints[j].mimic = 0;
  in->scene.joints = joints;
  in->scene.pairs = pairs;
  in->scene.pair_count = count;
  in->scene.clearances = NULL;
  const int is_open = open_room(in);
  for (size_t n = 0; n < count && is_open; n++)
    if (found[n].meeting == NSVCD_MEETS_NEVER)
      good &= write_never_proof(in, options->certificates, n, options->visits, limit);
  in->scene.joints = NULL;
  return is_open && good;
}

// Which bodies of a robot can meet each other: lines for its planning file.
static int pairs(settings *options) {
  robot_file file;
  robot_in_room in;
  size_t encoded_count;
  double taken;
  const int status = plan_options(options, "pairs");
  if (status != DONE) return status;
  memset(&in, 0, sizeof in);
  int good = read_robot(options->paths[0], &file);
  if (good && file.body_count == 0) good = complain("%s: no body", file.path);
  if (good) need_room(&file, NSVCD_NONE);
  good = good && encode_robot(&file, &options->encode, &encoded_count, &taken);
  if (good) {
    const size_t most = file.body_count * file.body_count;
    size_t count = 0;
    nsvcd_body_pair *asked = (nsvcd_body_pair *)allocate(most * sizeof *asked);
    nsvcd_range_answer *found = (nsvcd_range_answer *)allocate(most * sizeof *found);
    memset(found, 0, most * sizeof *found);
    good = enter_room(&file, NSVCD_NONE, 0, &in);
    for (uint32_t a = 0; a < file.body_count; a++) {
      for (uint32_t b = a + 1; b < file.body_count; b++) {
        const nsvcd_body_pair pair = {a, b};
        if (file.things[a].link != file.things[b].link) asked[count++] = pair;
      }
    }
    good = good && decide_pairs(&in, options, count, asked, found);
    for (size_t n = 0; n < count && good; n++) print_pair(&in, &asked[n], options->json, &found[n]);
    if (options->srdf && good) good = write_srdf(options->srdf, &file, count, asked, found);
    if (good && options->certificates) good = prove_pairs(&in, options, count, asked, found);
    free(asked);
    free(found);
  }
  leave_room(&in);
  free_robot(&file);
  return good ? DONE : REFUSED;
}

static int robot_command(settings *options, int is_path) {
  robot_file file;
  size_t encoded_count;
  double taken;
  FILE *out = NULL;
  const int status = plan_options(options, is_path ? "path" : "plan");
  if (status != DONE) return status;
  int good = read_robot(options->paths[0], &file);
  for (size_t i = 0; i < file.task_count && good; i++)
    if (is_asked(&file.tasks[i], options, is_path)) need_room(&file, file.tasks[i].room);
  if (!is_path) options->encode.balls = LINK_BALLS;
  good = good && encode_robot(&file, &options->encode, &encoded_count, &taken);
  if (good)
    fprintf(stderr, PROGRAM ": %zu meshes encoded in %.1f ms\n", encoded_count, 1e3 * taken);
  if (good && (options->picture || options->film) && file.body_count == 0)
    good = complain("%s: no body to draw", file.path);
  if (good && options->joints) {
    out = open_file(options->joints, "w");
    if (!out) good = complain("%s: %s", options->joints, strerror(errno));
  }
  good = good && robot_tasks(&file, options, is_path, out);
  if (out) {
    good = close_written(out, options->joints) && good;
  }
  free_robot(&file);
  return good ? DONE : REFUSED;
}
static int plan(settings *options) {
  return robot_command(options, 0);
}
static int path(settings *options) {
  return robot_command(options, 1);
}

#endif
