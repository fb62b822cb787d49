// robot_file.h - reads planning files (version 1), with messages that name file, line and reason.
// Include problem_file.h, load.h and robot_shapes.h first.
//
//   nsvcd-plans 1
//   joint NAME PARENT  x y z qx qy qz qw  ax ay az  KIND LOW HIGH SPEED [ACCELERATION]
//   mimic NAME LEADER MULTIPLIER OFFSET
//   body NAME JOINT SHAPE [pose x y z qx qy qz qw] [scale SX SY SZ]
//   pair NAME NAME
//   scene NAME
//   obstacle NAME SHAPE  x y z qx qy qz qw [scale SX SY SZ]
//   clearance NAME NAME METRES, or: clearance obstacles METRES
//   allow NAME NAME [METRES]
//   keep NAME x|y|z X Y Z DEGREES
//   attach NAME JOINT, or: release NAME
//   group NAME JOINT...
//   plan ID SCENE  [start...  [goal...]]  [group NAME]
//   goal ID joints...
//   goal ID pose x y z qx qy qz qw NAME [free x|y|z] [box HX HY HZ]
//   path ID SCENE COUNT [group NAME]      # COUNT lines of joints follow
//   curve ID SCENE DEGREE COUNT [timed] [group NAME]   # so do COUNT lines here
//   together ID SCENE  ID [at SECONDS]...
//
// examples/FORMATS.md says what they mean.
#ifndef NSVCD_SCENERY_ROBOT_FILE_H
#define NSVCD_SCENERY_ROBOT_FILE_H

// A mesh of a file, or another shape; the same one is encoded once.
typedef struct robot_mesh {
  robot_shape shape;
  size_t line;              // the line that names it first
  const char *kind, *name;  // "body" or "obstacle", and its name, there
  int is_needed;
  int moves;  // on a link
  const nsvcd_body *body;
  proof_mesh proof;  // made where a certificate is written
} robot_mesh;

// A body of the robot, or an obstacle of a scene.
typedef struct robot_thing {
  const char *name;
  size_t mesh;
  uint32_t link;
  nsvcd_pose pose;
} robot_thing;

typedef struct robot_clearance {
  size_t room;   // the scene that it holds in; NSVCD_NONE: all
  size_t at[2];  // two things; NSVCD_NONE: each pair with an obstacle
  float metres;
} robot_clearance;

typedef struct robot_room {  // a scene
  const char *name;
  size_t first, count;  // its obstacles, among the file's things
} robot_room;

typedef struct robot_group {
  const char *name;
  uint8_t held[NSVCD_MAX_JOINTS];  // 1: not one of the group's joints
  uint32_t joints[NSVCD_MAX_JOINTS];
  size_t joint_count;
} robot_group;

typedef struct robot_task {
  const char *id;
  size_t line, room;
  size_t points;      // 0: a plan, whose numbers are its start
  size_t first;       // the first of its numbers; NSVCD_NONE: it starts where the plan above ended
  size_t goal_count;  // of a plan
  size_t group;       // of whose joints it is; NSVCD_NONE: of all
  size_t degree;      // of a curve, else 0
  size_t times;       // of a curve: the first of its times; NSVCD_NONE: it has none
  int is_together;    // a curve that was merged of several
} robot_task;

// What a robot takes, or lets go of, before a task.
typedef struct robot_change {
  size_t task, line, thing;
  uint32_t link;    // 0: it rests
  nsvcd_pose pose;  // where it stood, in that link: once the task's start is known
} robot_change;

// Two things that may touch near the start and the goals, from a task on.
typedef struct robot_allow {
  size_t task, at[2];
  size_t room;  // the scene; NSVCD_NONE: all
  double metres;
} robot_allow;

// An axis of a thing that is kept upright, or otherwise, from a task on, while a joint moves it.
typedef struct robot_keep {
  size_t task, thing;
  size_t room;  // the scene; NSVCD_NONE: all
  nsvcd_cone cone;
} robot_keep;
static int robot_is_kept(const robot_keep *keep, size_t task, size_t room) {
  return keep->task <= task && (keep->room == room || keep->room == NSVCD_NONE);
}

// Does it hold for a task of a scene?
static int robot_is_allowed(const robot_allow *allow, size_t task, size_t room) {
  return allow->task <= task && (allow->room == room || allow->room == NSVCD_NONE);
}
#define ALLOWED_METRES 0.005
// of a line's metres, what is asked for: `verify` does not round radii to floats, as bodies do
#define ALLOWED_SHARE (1 - 1e-7)

// A goal of a plan: joints, or where a body is to be.
typedef struct robot_goal {
  size_t task, line;
  size_t first;  // the first of its numbers
  size_t thing;  // a body, of the robot's; NSVCD_NONE: it is joints
  nsvcd_pose pose;
  float free_axis[3], half[3];  // as nsvcd_reach_problem has them
} robot_goal;

typedef struct robot_file {
  const char *path;
  char *text;
  const char *joint_names[NSVCD_MAX_JOINTS];
  nsvcd_joint joints[NSVCD_MAX_JOINTS];
  robot_mesh *meshes;
  robot_thing *things;  // the robot's bodies, then obstacles
  nsvcd_body_pair *pairs;
  robot_clearance *clearances;
  robot_group *groups;
  robot_room *rooms;
  robot_task *tasks;
  robot_task *moves;  // paths and curves of groups
  robot_goal *goals;
  robot_change *changes;
  robot_allow *allows;
  robot_keep *keeps;
  double *numbers, *times;
  size_t joint_count, mesh_count, thing_count, body_count, pair_count, clearance_count, group_count,
      room_count, task_count, move_count, goal_count, change_count, allow_count, keep_count,
      number_count, time_count;
  size_t mesh_capacity, thing_capacity, pair_capacity, clearance_capacity, group_capacity,
      room_capacity, task_capacity, move_capacity, goal_capacity, change_capacity, allow_capacity,
      keep_capacity, number_capacity, time_capacity;
} robot_file;

// Adds an item to a list, and clears it.
#define ROBOT_ADD(list, count, capacity)                                       \
  ((list) = room_for_one(list, count, &(capacity), sizeof *(list)), (count)++, \
   memset(&(list)[(count)-1], 0, sizeof *(list)), &(list)[(count)-1])

// The link that follows a joint, or the world.
static int robot_link(const reader *r, const robot_file *file, const char *name, uint32_t *link) {
  *link = 0;
  if (strcmp(name, "world") == 0) return 1;
  for (size_t i = 0; i < file->joint_count; i++)
    if (strcmp(file->joint_names[i], name) == 0) return *link = (uint32_t)i + 1, 1;
  return refuse_field(r, "no joint of this name above, nor world", name);
}

static int robot_number(const reader *r, const char *field, double *out) {
  if (parse_number(field, out) && fabs(*out) <= (double)NSVCD_MAX_COORDINATE) return 1;
  return refuse_field(r, "not a finite number, or beyond NSVCD_MAX_COORDINATE", field);
}

static int robot_read_joint(const reader *r, robot_file *file) {
  static const char *const kinds[] = {"revolute", "continuous", "prismatic"};
  char *const *f = r->fields;
  uint32_t parent, other;
  if (r->field_count != 17 && r->field_count != 18)
    return refuse(r,
                  "expected: joint NAME PARENT x y z qx qy qz qw ax ay az "
                  "revolute|continuous|prismatic LOW HIGH SPEED [ACCELERATION]");
  if (file->joint_count == NSVCD_MAX_JOINTS) return refuse(r, "more joints than NSVCD_MAX_JOINTS");
  if (file->room_count > 0) return refuse(r, "a joint after the first scene");
  if (strcmp(f[1], "world") == 0) return refuse(r, "a joint of the name world");
  for (other = 0; other < file->joint_count; other++)
    if (strcmp(file->joint_names[other], f[1]) == 0)
      return refuse_field(r, "a second joint of this name", f[1]);
  nsvcd_joint *joint = &file->joints[file->joint_count];
  if (!robot_link(r, file, f[2], &parent) || !read_pose(r, f + 3, &joint->origin)) return 0;
  joint->parent = parent;
  for (size_t k = 0; k < 3; k++)
    if (!parse_float(f[10 + k], &joint->axis[k]))
      return refuse_field(r, "not a finite number", f[10 + k]);
  size_t kind = 0;
  while (kind < 3 && strcmp(kinds[kind], f[13]) != 0) kind++;
  if (kind == 3) return refuse_field(r, "none of revolute, continuous, prismatic", f[13]);
  joint->kind = (nsvcd_joint_kind)kind;
  double *to[4] = {&joint->low, &joint->high, &joint->speed, &joint->acceleration};
  for (size_t k = 0; k + 14 < r->field_count; k++)
    if (!robot_number(r, f[14 + k], to[k])) return 0;
  if (joint->kind != NSVCD_JOINT_CONTINUOUS && joint->low > joint->high)
    return refuse(r, "LOW is above HIGH");
  if (!(joint->speed > 0) || joint->acceleration < 0)
    return refuse(r, "SPEED or ACCELERATION is not positive");
  file->joint_names[file->joint_count++] = f[1];
  return 1;
}

// A joint's value is always that of another, its leader, times a multiplier, and an offset.
static int robot_read_mimic(const reader *r, robot_file *file) {
  uint32_t links[2];
  if (r->field_count != 5) return refuse(r, "expected: mimic NAME LEADER MULTIPLIER OFFSET");
  if (file->room_count > 0) return refuse(r, "a mimic after the first scene");
  if (file->group_count > 0) return refuse(r, "a mimic after a group");
  for (int k = 0; k < 2; k++) {
    if (!robot_link(r, file, r->fields[1 + k], &links[k])) return 0;
    if (links[k] == 0) return refuse(r, "the world is no joint");
  }
  nsvcd_joint *joint = &file->joints[links[0] - 1];
  const nsvcd_joint *leader = &file->joints[links[1] - 1];
  if (joint->mimic || joint == leader) return refuse_field(r, "it mimics a joint", r->fields[1]);
  if (leader->mimic) return refuse_field(r, "it mimics a joint", r->fields[2]);
  for (size_t k = 0; k < file->joint_count; k++)
    if (file->joints[k].mimic == links[0]) return refuse_field(r, "a leader", r->fields[1]);
  if (!robot_number(r, r->fields[3], &joint->multiplier) ||
      !robot_number(r, r->fields[4], &joint->offset))
    return 0;
  const double rate = fabs(joint->multiplier);
  if (rate < 1e-6) return refuse_field(r, "MULTIPLIER is 0, or nearly", r->fields[3]);
  if (joint->kind == NSVCD_JOINT_CONTINUOUS && leader->kind == joint->kind && rate > floor(rate))
    return refuse_field(r, "not a whole number, where both are continuous", r->fields[3]);
  joint->mimic = links[1];
  return 1;
}

// Adds a shape, unless it is there already. Returns which one it is.
static size_t robot_find_mesh(robot_file *file, const reader *r, const robot_shape *shape) {
  for (size_t i = 0; i < file->mesh_count; i++)
    if (robot_same_shape(&file->meshes[i].shape, shape)) return i;
  robot_mesh *mesh = ROBOT_ADD(file->meshes, file->mesh_count, file->mesh_capacity);
  mesh->shape = *shape;
  mesh->line = r->line;
  mesh->kind = r->fields[0];
  mesh->name = r->fields[1];
  return file->mesh_count - 1;
}

// Reads what may follow from a field on: `pose` and `scale`, each once. pose: NULL if the line has
// one of its own.
static int robot_read_words(const reader *r, size_t at, nsvcd_pose *pose, robot_shape *shape) {
  double *scale = shape->scale;
  int has_scale = shape->kind != ROBOT_MESH;
  scale[0] = scale[1] = scale[2] = 1;
  while (at < r->field_count) {
    char *const *f = r->fields + at;
    const size_t left = r->field_count - at;
    if (pose && strcmp(f[0], "pose") == 0 && left >= 8) {
      if (!read_pose(r, f + 1, pose)) return 0;
      pose = NULL;
      at += 8;
    } else if (!has_scale && strcmp(f[0], "scale") == 0 && left >= 4) {
      for (size_t k = 0; k < 3; k++)
        if (!parse_number(f[1 + k], &scale[k]) || !(fabs(scale[k]) >= (double)NSVCD_MIN_SCALE) ||
            !(fabs(scale[k]) <= (double)NSVCD_MAX_SCALE))
          return refuse_field(r, "a scale, or minus one, is not in 1e-6..1e6", f[1 + k]);
      has_scale = 1;
      at += 4;
    } else if (shape->kind != ROBOT_MESH && strcmp(f[0], "scale") == 0) {
      return refuse(r, "a scale is of meshes only");
    } else {
      return refuse_field(r,
                          pose ? "expected 'pose x y z qx qy qz qw' or 'scale SX SY SZ', each once"
                               : "expected 'scale SX SY SZ', once",
                          f[0]);
    }
  }
  return 1;
}

// Finds a thing by its name, among the robot's bodies, and the obstacles from `first` on.
static int robot_find(const robot_file *file, size_t first, const char *name, size_t *at) {
  for (*at = 0; *at < file->thing_count; ++*at) {
    if (*at >= file->body_count && *at < first) continue;
    if (strcmp(file->things[*at].name, name) == 0) return 1;
  }
  return 0;
}

static int robot_read_body(const reader *r, robot_file *file) {
  size_t found;
  size_t at = 3;
  uint32_t link;
  robot_shape shape;
  nsvcd_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
  if (r->field_count < 4)
    return refuse(r, "expected: body NAME JOINT SHAPE [pose x y z qx qy qz qw] [scale SX SY SZ]");
  if (file->room_count > 0) return refuse(r, "a body after the first scene");
  if (robot_find(file, 0, r->fields[1], &found))
    return refuse_field(r, "a second body of this name", r->fields[1]);
  if (!robot_link(r, file, r->fields[2], &link) || !robot_read_shape(r, &at, &shape) ||
      !robot_read_words(r, at, &pose, &shape))
    return 0;
  const size_t mesh = robot_find_mesh(file, r, &shape);
  robot_thing *thing = ROBOT_ADD(file->things, file->thing_count, file->thing_capacity);
  thing->name = r->fields[1];
  thing->mesh = mesh;
  thing->link = link;
  thing->pose = pose;
  file->body_count = file->thing_count;
  return 1;
}

static int robot_read_pair(const reader *r, robot_file *file) {
  size_t at[2];
  if (r->field_count != 3) return refuse(r, "expected: pair NAME NAME");
  if (file->room_count > 0) return refuse(r, "a pair after the first scene");
  for (int k = 0; k < 2; k++)
    if (!robot_find(file, 0, r->fields[1 + k], &at[k]))
      return refuse_field(r, "no body of this name above", r->fields[1 + k]);
  if (file->things[at[0]].link == file->things[at[1]].link)
    return refuse(r, "both follow the same joint");
  nsvcd_body_pair *pair = ROBOT_ADD(file->pairs, file->pair_count, file->pair_capacity);
  pair->a = (uint32_t)at[0];
  pair->b = (uint32_t)at[1];
  return 1;
}

// Are two things, in any order, the ones that a line is about?
static int robot_is_about(const size_t *at, size_t a, size_t b) {
  return (at[0] == a && at[1] == b) || (at[0] == b && at[1] == a);
}

// Is there such a pair: by a `pair` line, or of a body that moves and an obstacle?
static int robot_are_pair(const robot_file *file, const robot_clearance *line) {
  const size_t low = line->at[0] < line->at[1] ? line->at[0] : line->at[1];
  const size_t high = low == line->at[0] ? line->at[1] : line->at[0];
  if (high >= file->body_count) return low < file->body_count && file->things[low].link > 0;
  for (size_t n = 0; n < file->pair_count; n++)
    if (robot_is_about(line->at, file->pairs[n].a, file->pairs[n].b)) return 1;
  return 0;
}

static int robot_read_clearance(const reader *r, robot_file *file) {
  const size_t rooms = file->room_count;
  robot_clearance line = {rooms ? rooms - 1 : NSVCD_NONE, {NSVCD_NONE, NSVCD_NONE}, 0};
  double metres;
  const int is_of_obstacles = r->field_count == 3 && strcmp(r->fields[1], "obstacles") == 0;
  if (r->field_count != 4 && !is_of_obstacles)
    return refuse(r, "expected: clearance NAME NAME METRES, or: clearance obstacles METRES");
  for (int k = 0; k < 2 && !is_of_obstacles; k++)
    if (!robot_find(file, rooms ? file->rooms[rooms - 1].first : 0, r->fields[1 + k], &line.at[k]))
      return refuse_field(r, "no body of this name above", r->fields[1 + k]);
  if (!is_of_obstacles && !robot_are_pair(file, &line))
    return refuse(r, "neither a pair above, nor a body that moves and an obstacle");
  for (size_t n = 0; n < file->clearance_count; n++)
    if (file->clearances[n].room == line.room &&
        robot_is_about(file->clearances[n].at, line.at[0], line.at[1]))
      return refuse(r, "a second clearance of these");
  const char *last = r->fields[r->field_count - 1];
  if (!robot_number(r, last, &metres)) return 0;
  if (metres < 0) return refuse_field(r, "a clearance is negative", last);
  line.metres = (float)metres;
  *ROBOT_ADD(file->clearances, file->clearance_count, file->clearance_capacity) = line;
  return 1;
}

static int robot_find_group(const robot_file *file, const char *name, size_t *at) {
  for (*at = 0; *at < file->group_count; ++*at)
    if (strcmp(file->groups[*at].name, name) == 0) return 1;
  return 0;
}

static int robot_read_group(const reader *r, robot_file *file) {
  size_t found;
  robot_group group;
  if (r->field_count < 3) return refuse(r, "expected: group NAME JOINT...");
  if (file->room_count > 0) return refuse(r, "a group after the first scene");
  if (robot_find_group(file, r->fields[1], &found))
    return refuse_field(r, "a second group of this name", r->fields[1]);
  memset(&group, 0, sizeof group);
  group.name = r->fields[1];
  memset(group.held, 1, sizeof group.held);
  for (size_t k = 2; k < r->field_count; k++) {
    uint32_t link;
    if (!robot_link(r, file, r->fields[k], &link)) return 0;
    if (link == 0) return refuse(r, "the world is no joint");
    // its paths and curves have no number for what mimics
    if (group.held[link - 1] && !file->joints[link - 1].mimic)
      group.joints[group.joint_count++] = link - 1;
    group.held[link - 1] = 0;
  }
  *ROBOT_ADD(file->groups, file->group_count, file->group_capacity) = group;
  return 1;
}

static int robot_find_room(const robot_file *file, const char *name, size_t *at) {
  for (*at = 0; *at < file->room_count; ++*at)
    if (strcmp(file->rooms[*at].name, name) == 0) return 1;
  return 0;
}

static int robot_read_scene(const reader *r, robot_file *file) {
  size_t found;
  if (r->field_count != 2) return refuse(r, "expected: scene NAME");
  if (file->joint_count == 0) return refuse(r, "no joint above");
  if (robot_find_room(file, r->fields[1], &found))
    return refuse_field(r, "a second scene of this name", r->fields[1]);
  robot_room *room = ROBOT_ADD(file->rooms, file->room_count, file->room_capacity);
  room->name = r->fields[1];
  room->first = file->thing_count;
  return 1;
}

static int robot_read_obstacle(const reader *r, robot_file *file) {
  size_t found;
  size_t at = 2;
  nsvcd_pose pose;
  robot_shape shape;
  static const char form[] = "expected: obstacle NAME SHAPE x y z qx qy qz qw [scale SX SY SZ]";
  if (r->field_count < 3) return refuse(r, form);
  if (file->room_count == 0) return refuse(r, "no scene above");
  robot_room *room = &file->rooms[file->room_count - 1];
  if (robot_find(file, room->first, r->fields[1], &found))
    return refuse_field(r, "a second body of this name", r->fields[1]);
  if (!robot_read_shape(r, &at, &shape)) return 0;
  if (at + 7 > r->field_count) return refuse(r, form);
  if (!read_pose(r, r->fields + at, &pose) || !robot_read_words(r, at + 7, NULL, &shape)) return 0;
  const size_t mesh = robot_find_mesh(file, r, &shape);
  robot_thing *thing = ROBOT_ADD(file->things, file->thing_count, file->thing_capacity);
  thing->name = r->fields[1];
  thing->mesh = mesh;
  thing->pose = pose;
  room->count++;
  return 1;
}

// The value that a joint has in a configuration: its own, or what the one that it mimics makes it.
static double robot_value(const robot_file *file, size_t joint, const double *at) {
  const nsvcd_joint *j = &file->joints[joint];
  return j->mimic ? j->multiplier * at[j->mimic - 1] + j->offset : at[joint];
}

// Of all joints, or of those that a group's lines have.
static int robot_read_joints(const reader *r, robot_file *file, size_t count, char *const *fields) {
  for (size_t j = 0; j < count; j++) {
    double number;
    if (!robot_number(r, fields[j], &number)) return 0;
    *ROBOT_ADD(file->numbers, file->number_count, file->number_capacity) = number;
  }
  const double *at = file->numbers + file->number_count - count;
  for (size_t j = 0; j < file->joint_count && count == file->joint_count; j++) {
    const nsvcd_joint *joint = &file->joints[j];
    if (!joint->mimic) continue;
    const double value = robot_value(file, j, at);
    const double most = 1 + fabs(joint->offset) + fabs(value - joint->offset);
    // as nsvcd_joint has it
    if (!(fabs(at[j] - value) <= 1e-9 * most))
      return complain("%s:%zu: joint %s is %.12g, and by %s, which it mimics, %.12g", r->path,
                      r->line, file->joint_names[j], at[j], file->joint_names[joint->mimic - 1],
                      value);
  }
  return 1;
}

// Adds a goal to a plan.
static robot_goal *robot_add_goal(const reader *r, robot_file *file, size_t task) {
  robot_goal *goal = ROBOT_ADD(file->goals, file->goal_count, file->goal_capacity);
  goal->task = task;
  goal->line = r->line;
  goal->first = file->number_count;
  goal->thing = NSVCD_NONE;
  file->tasks[task].goal_count++;
  return goal;
}

// Two bodies of the scene may touch.
static int robot_read_allow(const reader *r, robot_file *file) {
  robot_allow allow;
  memset(&allow, 0, sizeof allow);
  allow.metres = ALLOWED_METRES;
  if (r->field_count != 3 && r->field_count != 4)
    return refuse(r, "expected: allow NAME NAME [METRES]");
  const size_t rooms = file->room_count;
  allow.task = file->task_count;
  allow.room = rooms ? rooms - 1 : NSVCD_NONE;
  for (int k = 0; k < 2; k++)
    if (!robot_find(file, rooms ? file->rooms[rooms - 1].first : 0, r->fields[1 + k], &allow.at[k]))
      return refuse_field(r, "no body of this name above", r->fields[1 + k]);
  if (r->field_count == 4 && !robot_number(r, r->fields[3], &allow.metres)) return 0;
  if (allow.metres < 0) return refuse_field(r, "a distance is negative", r->fields[3]);
  *ROBOT_ADD(file->allows, file->allow_count, file->allow_capacity) = allow;
  return 1;
}

// An axis of a body of the robot, or of an obstacle that is attached, stays near a direction.
static int robot_read_keep(const reader *r, robot_file *file) {
  char *const *f = r->fields;
  robot_keep keep;
  double degrees;
  float *to = keep.cone.direction;
  memset(&keep, 0, sizeof keep);
  if (r->field_count != 7 || f[2][0] < 'x' || f[2][0] > 'z' || f[2][1])
    return refuse(r, "expected: keep NAME x|y|z X Y Z DEGREES");
  const size_t rooms = file->room_count;
  keep.task = file->task_count;
  keep.room = rooms ? rooms - 1 : NSVCD_NONE;
  if (!robot_find(file, rooms ? file->rooms[rooms - 1].first : 0, f[1], &keep.thing))
    return refuse_field(r, "no body of this name above", f[1]);
  if (keep.thing < file->body_count && !file->things[keep.thing].link)
    return refuse_field(r, "this body follows no joint", f[1]);
  keep.cone.axis[f[2][0] - 'x'] = 1;
  for (size_t k = 0; k < 3; k++)
    if (!parse_float(f[3 + k], &to[k]) || !(fabsf(to[k]) <= NSVCD_MAX_COORDINATE))
      return refuse_field(r, "not a finite number, or beyond NSVCD_MAX_COORDINATE", f[3 + k]);
  if (!(fabsf(to[0]) + fabsf(to[1]) + fabsf(to[2]) > 1e-6f))
    return refuse(r, "the direction has no length");
  if (!parse_number(f[6], &degrees) || !(degrees >= 0.01 && degrees < 180))
    return refuse_field(r, "DEGREES are not 0.01 or more, and less than 180", f[6]);
  keep.cone.angle = degrees * (3.141592653589793 / 180);
  *ROBOT_ADD(file->keeps, file->keep_count, file->keep_capacity) = keep;
  return 1;
}

// An obstacle of the scene moves with a joint from the next task on, or rests again.
static int robot_read_change(const reader *r, robot_file *file) {
  robot_change change;
  const int attaches = r->fields[0][0] == 'a';
  memset(&change, 0, sizeof change);
  if (r->field_count != (attaches ? 3 : 2))
    return refuse(r, attaches ? "expected: attach NAME JOINT" : "expected: release NAME");
  if (file->room_count == 0) return refuse(r, "no scene above");
  if (!robot_find(file, file->rooms[file->room_count - 1].first, r->fields[1], &change.thing) ||
      change.thing < file->body_count)
    return refuse_field(r, "no obstacle of this name above", r->fields[1]);
  if (attaches && !robot_link(r, file, r->fields[2], &change.link)) return 0;
  change.task = file->task_count;
  change.line = r->line;
  *ROBOT_ADD(file->changes, file->change_count, file->change_capacity) = change;
  return 1;
}

// Reads a goal that is joints. Those that are not of the plan's group are as the start has them.
static int robot_read_goal_joints(const reader *r, robot_file *file, size_t task,
                                  char *const *fields) {
  const robot_task *plan = &file->tasks[task];
  const robot_goal *goal = robot_add_goal(r, file, task);
  if (!robot_read_joints(r, file, file->joint_count, fields)) return 0;
  // where a plan starts that has no start of its own is not known yet
  for (size_t j = 0; j < file->joint_count && plan->group != NSVCD_NONE; j++) {
    if (plan->first == NSVCD_NONE) break;
    const robot_group *group = &file->groups[plan->group];
    const double off = file->numbers[goal->first + j] - file->numbers[plan->first + j];
    if (group->held[j] && !file->joints[j].mimic && (off > 0 || off < 0))
      return complain("%s:%zu: joint %s is not of group %s, but its goal is not its start", r->path,
                      r->line, file->joint_names[j], group->name);
  }
  return 1;
}

// Reads `group NAME` at the end of a line, if it is there. Returns how many fields there are before
// it; 0 after a complaint.
static size_t robot_read_group_of(const reader *r, const robot_file *file, robot_task *task) {
  const size_t words = r->field_count;
  task->group = NSVCD_NONE;
  if (words < 5 || strcmp(r->fields[words - 2], "group") != 0) return words;
  if (robot_find_group(file, r->fields[words - 1], &task->group)) return words - 2;
  refuse_field(r, "no group of this name above", r->fields[words - 1]);
  return 0;
}

// How many joints the lines of a path or a curve have.
static size_t robot_width(const robot_file *file, const robot_task *task) {
  return task->group == NSVCD_NONE ? file->joint_count : file->groups[task->group].joint_count;
}

// Those of a group are asked about together with others only.
static void robot_add_motion(robot_file *file, const robot_task *task) {
  if (task->group == NSVCD_NONE)
    *ROBOT_ADD(file->tasks, file->task_count, file->task_capacity) = *task;
  else
    *ROBOT_ADD(file->moves, file->move_count, file->move_capacity) = *task;
}

static int robot_read_path(reader *r, robot_file *file) {
  robot_task task;
  char *const *f = r->fields;
  memset(&task, 0, sizeof task);
  const size_t fields = robot_read_group_of(r, file, &task);
  if (!fields) return 0;
  if (fields != 4) return refuse(r, "expected: path ID SCENE COUNT [group NAME]");
  task.id = f[1];
  task.line = r->line;
  task.first = file->number_count;
  task.times = NSVCD_NONE;
  const size_t joints = robot_width(file, &task);
  if (!robot_find_room(file, f[2], &task.room))
    return refuse_field(r, "no scene of this name above", f[2]);
  if (!parse_count(f[3], 1, 10000000, &task.points))
    return refuse_field(r, "COUNT is not in 1..10000000", f[3]);
  for (size_t i = 0; i < task.points; i++) {
    if (!next_line(r) || r->field_count != joints)
      return complain("%s:%zu: path %s has %zu of its %zu lines of %zu joints", r->path, task.line,
                      task.id, i, task.points, joints);
    if (!robot_read_joints(r, file, joints, r->fields)) return 0;
  }
  robot_add_motion(file, &task);
  return 1;
}

static int robot_read_plan(reader *r, robot_file *file) {
  robot_task task;
  const size_t joints = file->joint_count;
  char *const *f = r->fields;
  memset(&task, 0, sizeof task);
  const size_t fields = robot_read_group_of(r, file, &task);
  if (!fields) return 0;
  const int has_goal = fields == 3 + 2 * joints;
  const int follows = fields == 3;
  if (fields != 3 + joints && !has_goal && !follows)
    return complain(
        "%s:%zu: expected: plan ID SCENE, then %zu joints of the start, unless it starts where the "
        "plan above ended, and perhaps of a goal, and perhaps group NAME",
        r->path, r->line, joints);
  task.id = f[1];
  task.line = r->line;
  task.first = follows ? NSVCD_NONE : file->number_count;
  if (!robot_find_room(file, f[2], &task.room))
    return refuse_field(r, "no scene of this name above", f[2]);
  if (!follows && !robot_read_joints(r, file, joints, f + 3)) return 0;
  *ROBOT_ADD(file->tasks, file->task_count, file->task_capacity) = task;
  return !has_goal || robot_read_goal_joints(r, file, file->task_count - 1, f + 3 + joints);
}

// Reads what may follow the NAME of a goal.
static int robot_read_region(const reader *r, robot_goal *goal) {
  int has_free = 0;
  int has_box = 0;
  for (size_t at = 11; at < r->field_count;) {
    char *const *f = r->fields + at;
    const size_t left = r->field_count - at;
    if (!has_free && left >= 2 && strcmp(f[0], "free") == 0 && f[1][0] >= 'x' && f[1][0] <= 'z' &&
        !f[1][1]) {
      goal->free_axis[f[1][0] - 'x'] = 1;
      has_free = 1;
      at += 2;
    } else if (!has_box && left >= 4 && strcmp(f[0], "box") == 0) {
      for (size_t k = 0; k < 3; k++)
        if (!parse_float(f[1 + k], &goal->half[k]) || !(goal->half[k] >= 0) ||
            !(goal->half[k] <= NSVCD_MAX_COORDINATE))
          return refuse_field(r, "half a side is negative, or too large", f[1 + k]);
      has_box = 1;
      at += 4;
    } else {
      return refuse_field(r, "expected 'free x|y|z' or 'box HX HY HZ', each once", f[0]);
    }
  }
  return 1;
}

// Reads a line of a curve, which begins with a time if it is timed.
static int robot_read_point(const reader *r, robot_file *file, size_t joints, int is_timed) {
  double time;
  if (!robot_read_joints(r, file, joints, r->fields + is_timed)) return 0;
  if (!is_timed) return 1;
  if (!robot_number(r, r->fields[0], &time)) return 0;
  *ROBOT_ADD(file->times, file->time_count, file->time_capacity) = time;
  return 1;
}

// A curve's lines are Bezier points; where a piece begins or ends they may begin with the time.
static int robot_read_curve(reader *r, robot_file *file) {
  robot_task task;
  char *const *f = r->fields;
  memset(&task, 0, sizeof task);
  const size_t fields = robot_read_group_of(r, file, &task);
  if (!fields) return 0;
  const int is_timed = fields == 6 && strcmp(f[5], "timed") == 0;
  if (fields != 5 && !is_timed)
    return refuse(r, "expected: curve ID SCENE DEGREE COUNT [timed] [group NAME]");
  const size_t joints = robot_width(file, &task);
  task.id = f[1];
  task.line = r->line;
  task.first = file->number_count;
  task.times = is_timed ? file->time_count : NSVCD_NONE;
  if (!robot_find_room(file, f[2], &task.room))
    return refuse_field(r, "no scene of this name above", f[2]);
  if (!parse_count(f[3], 1, NSVCD_MAX_DEGREE, &task.degree))
    return refuse_field(r, "DEGREE is not in 1..5", f[3]);
  if (!parse_count(f[4], 2, 10000000, &task.points) || (task.points - 1) % task.degree != 0)
    return refuse_field(r, "COUNT is not a multiple of DEGREE and 1, up to 10000000", f[4]);
  for (size_t i = 0; i < task.points; i++) {
    const int has_time = is_timed && i % task.degree == 0;
    const size_t needed = joints + (size_t)has_time;
    if (!next_line(r) || r->field_count != needed)
      return complain("%s:%zu: curve %s: its line %zu is not one of %zu numbers", r->path, r->line,
                      task.id, i, needed);
    if (!robot_read_point(r, file, joints, has_time)) return 0;
    const size_t times = file->time_count;
    if (has_time && i > 0 && !(file->times[times - 1] > file->times[times - 2]))
      return refuse(r, "times do not rise");
  }
  robot_add_motion(file, &task);
  return 1;
}

// The motion of a path or a curve of a group.
static nsvcd_partial_motion robot_motion_of(const robot_file *file, const robot_task *move) {
  const robot_group *group = &file->groups[move->group];
  const size_t degree = move->degree ? move->degree : 1;
  const nsvcd_joint_motion motion = {(move->points - 1) / degree, degree,
                                     file->numbers + move->first,
                                     move->times == NSVCD_NONE ? NULL : file->times + move->times};
  const nsvcd_partial_motion out = {motion, group->joints, group->joint_count, 0};
  return out;
}

// Reads the paths and curves of groups that a line names, and when they begin. Each joint is moved by
// one of them. Returns 0 after a complaint.
static int robot_read_motions(const reader *r, const robot_file *file, size_t room,
                              nsvcd_partial_motion *motions, size_t *count) {
  uint8_t moved[NSVCD_MAX_JOINTS] = {0};
  char *const *f = r->fields;
  for (size_t at = 3; at < r->field_count; at++) {
    size_t n = file->move_count;
    while (n > 0 && (file->moves[n - 1].room != room || strcmp(file->moves[n - 1].id, f[at]) != 0))
      n--;
    if (!n) return refuse_field(r, "no path or curve of a group above, in this scene", f[at]);
    nsvcd_partial_motion one = robot_motion_of(file, &file->moves[n - 1]);
    for (size_t k = 0; k < one.joint_count; k++)
      if (moved[one.joints[k]]++)
        return refuse_field(r, "two of these move one joint", file->joint_names[one.joints[k]]);
    if (at + 2 < r->field_count && strcmp(f[at + 1], "at") == 0) {
      if (!robot_number(r, f[at + 2], &one.delay)) return 0;
      at += 2;
    }
    motions[(*count)++] = one;
  }
  for (size_t j = 0; j < file->joint_count; j++)
    if (!moved[j] && !file->joints[j].mimic)
      return refuse_field(r, "none of these moves a joint; where it rests, a path of one line says",
                          file->joint_names[j]);
  return 1;
}

// Motions on clocks of their own become one curve.
static int robot_read_together(reader *r, robot_file *file) {
  robot_task task;
  static const double zeros[NSVCD_MAX_JOINTS];  // of joints that mimic, until they follow
  nsvcd_partial_motion motions[NSVCD_MAX_JOINTS];
  nsvcd_joint_motion merged;
  size_t count = 0;
  const size_t joints = file->joint_count;
  memset(&task, 0, sizeof task);
  if (r->field_count < 4) return refuse(r, "expected: together ID SCENE  ID [at SECONDS]...");
  task.id = r->fields[1];
  task.line = r->line;
  task.first = file->number_count;
  task.group = NSVCD_NONE;
  task.is_together = 1;
  if (!robot_find_room(file, r->fields[2], &task.room))
    return refuse_field(r, "no scene of this name above", r->fields[2]);
  if (!robot_read_motions(r, file, task.room, motions, &count)) return 0;
  const size_t size = nsvcd_merge_motions_size(motions, count, joints);
  void *memory = allocate(size);
  const nsvcd_result result =
      nsvcd_merge_motions(motions, count, joints, zeros, memory, size, &merged);
  if (!result) {
    task.degree = merged.pieces ? merged.degree : 0;
    task.points = merged.pieces * merged.degree + 1;
    task.times = merged.pieces ? file->time_count : NSVCD_NONE;
    for (size_t i = 0; i < task.points * joints; i++) {
      const double value = robot_value(file, i % joints, merged.points + (i - i % joints));
      *ROBOT_ADD(file->numbers, file->number_count, file->number_capacity) = value;
    }
    for (size_t i = 0; merged.pieces && i <= merged.pieces; i++)
      *ROBOT_ADD(file->times, file->time_count, file->time_capacity) = merged.times[i];
    robot_add_motion(file, &task);
  }
  free(memory);
  return result ? refuse(r, nsvcd_result_string(result)) : 1;
}

static int robot_read_goal(const reader *r, robot_file *file) {
  char *const *f = r->fields;
  const int is_pose = r->field_count >= 11 && strcmp(f[2], "pose") == 0;
  if (!is_pose && r->field_count != 2 + file->joint_count)
    return complain(
        "%s:%zu: expected: goal ID pose x y z qx qy qz qw NAME [free x|y|z] [box HX HY HZ], "
        "or goal ID and %zu joints",
        r->path, r->line, file->joint_count);
  size_t task = file->task_count;
  while (task > 0 && (file->tasks[task - 1].points || strcmp(file->tasks[task - 1].id, f[1]) != 0))
    task--;
  if (!task) return refuse_field(r, "no plan of this ID above", f[1]);
  if (!is_pose) return robot_read_goal_joints(r, file, task - 1, f + 2);
  robot_goal *goal = robot_add_goal(r, file, task - 1);
  const size_t first = file->rooms[file->tasks[task - 1].room].first;
  if (!robot_find(file, first, f[10], &goal->thing))
    return refuse_field(r, "no body of this name", f[10]);
  uint32_t link = file->things[goal->thing].link;
  for (size_t k = 0; k < file->change_count; k++)
    if (file->changes[k].thing == goal->thing && file->changes[k].task < task)
      link = file->changes[k].link;
  if (!link) return refuse_field(r, "this body follows no joint", f[10]);
  return read_pose(r, f + 3, &goal->pose) && robot_read_region(r, goal);
}

static int read_robot(const char *path, robot_file *file) {
  static const struct {
    const char *word;
    int (*read)(const reader *r, robot_file *file);
  } lines[] = {{"joint", robot_read_joint},         {"mimic", robot_read_mimic},
               {"body", robot_read_body},           {"pair", robot_read_pair},
               {"clearance", robot_read_clearance}, {"group", robot_read_group},
               {"scene", robot_read_scene},         {"goal", robot_read_goal},
               {"obstacle", robot_read_obstacle},   {"allow", robot_read_allow},
               {"keep", robot_read_keep},           {"attach", robot_read_change},
               {"release", robot_read_change}};
  static const struct {
    const char *word;
    int (*read)(reader *r, robot_file *file);
  } tasks[] = {{"plan", robot_read_plan},
               {"path", robot_read_path},
               {"curve", robot_read_curve},
               {"together", robot_read_together}};
  const size_t count = sizeof lines / sizeof lines[0];
  const size_t kinds = sizeof tasks / sizeof tasks[0];
  reader r;
  memset(file, 0, sizeof *file);
  file->path = shown_name(path);
  if (!open_reader(path, "nsvcd-plans", &file->text, &r)) return 0;
  while (next_line(&r)) {
    size_t k = 0;
    size_t kind = 0;
    while (k < count && strcmp(lines[k].word, r.fields[0]) != 0) k++;
    while (kind < kinds && strcmp(tasks[kind].word, r.fields[0]) != 0) kind++;
    if (k == count && kind == kinds)
      return refuse_field(&r,
                          "expected 'joint', 'mimic', 'body', 'pair', 'clearance', 'group', "
                          "'scene', 'obstacle', 'allow', 'keep', 'attach', 'release', 'plan', "
                          "'goal', 'path', 'curve' or 'together'",
                          r.fields[0]);
    if (r.field_count > MOST_FIELDS) return refuse(&r, "too many fields");
    if (!(kind < kinds ? tasks[kind].read(&r, file) : lines[k].read(&r, file))) return 0;
  }
  for (size_t i = 0; i < file->task_count; i++) {
    const robot_task *task = &file->tasks[i];
    if (!task->points && !task->goal_count)
      return complain("%s:%zu: plan %s has no goal, here or on lines 'goal %s ...' below",
                      file->path, task->line, task->id, task->id);
  }
  return 1;
}

static void free_robot(robot_file *file) {
  for (size_t i = 0; i < file->mesh_count; i++) {
    nsvcd_body_free(file->meshes[i].body, NULL);
    free_tree(&file->meshes[i].proof);
  }
  free(file->text);
  free(file->meshes);
  free(file->things);
  free(file->pairs);
  free(file->clearances);
  free(file->groups);
  free(file->rooms);
  free(file->tasks);
  free(file->moves);
  free(file->goals);
  free(file->changes);
  free(file->allows);
  free(file->keeps);
  free(file->numbers);
  free(file->times);
}
#endif  // NSVCD_SCENERY_ROBOT_FILE_H
