// robot_file.h - reads planning files (version 1), with messages that name file, line and reason.
// Include problem_file.h and load.h first.
//
//   nsvcd-plans 1
//   joint NAME PARENT  x y z qx qy qz qw  ax ay az  KIND LOW HIGH SPEED [ACCELERATION]
//   body NAME JOINT PATH [pose x y z qx qy qz qw] [scale SX SY SZ]
//   pair NAME NAME [METRES]
//   scene NAME
//   obstacle NAME PATH  x y z qx qy qz qw [scale SX SY SZ]
//   plan ID SCENE  start...  [goal...]
//   goal ID joints...
//   goal ID pose x y z qx qy qz qw NAME [free x|y|z] [box HX HY HZ]
//   path ID SCENE COUNT        # COUNT lines of joints follow
//
// examples/FORMATS.md says what they mean.
#ifndef NSVCD_SCENERY_ROBOT_FILE_H
#define NSVCD_SCENERY_ROBOT_FILE_H

// A mesh of a file; the same path at the same scale is encoded once.
typedef struct robot_mesh {
  const char *path;
  double scale[3];
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

typedef struct robot_pair {
  nsvcd_body_pair parts;
  float clearance;  // metres; below 0: the one that is asked for
} robot_pair;

typedef struct robot_room {  // a scene
  const char *name;
  size_t first, count;  // its obstacles, among the file's things
} robot_room;

typedef struct robot_task {
  const char *id;
  size_t line, room;
  size_t points;      // 0: a plan, whose numbers are its start
  size_t first;       // the first of its numbers
  size_t goal_count;  // of a plan
} robot_task;

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
  robot_pair *pairs;
  robot_room *rooms;
  robot_task *tasks;
  robot_goal *goals;
  double *numbers;
  size_t joint_count, mesh_count, thing_count, body_count, pair_count, room_count, task_count,
      goal_count, number_count;
  size_t mesh_capacity, thing_capacity, pair_capacity, room_capacity, task_capacity, goal_capacity,
      number_capacity;
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

static size_t robot_find_mesh(robot_file *file, const reader *r, const char *path,
                              const double scale[3]) {
  for (size_t i = 0; i < file->mesh_count; i++)
    if (strcmp(file->meshes[i].path, path) == 0 &&
        memcmp(file->meshes[i].scale, scale, sizeof file->meshes[i].scale) == 0)
      return i;
  robot_mesh *mesh = ROBOT_ADD(file->meshes, file->mesh_count, file->mesh_capacity);
  mesh->path = path;
  memcpy(mesh->scale, scale, sizeof mesh->scale);
  mesh->line = r->line;
  mesh->kind = r->fields[0];
  mesh->name = r->fields[1];
  return file->mesh_count - 1;
}

// Reads what may follow from a field on: `pose` and `scale`, each once. pose: NULL if the line has
// one of its own.
static int robot_read_words(const reader *r, size_t at, nsvcd_pose *pose, double scale[3]) {
  int has_scale = 0;
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
  uint32_t link;
  double scale[3];
  nsvcd_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
  if (r->field_count < 4)
    return refuse(r, "expected: body NAME JOINT PATH [pose x y z qx qy qz qw] [scale SX SY SZ]");
  if (file->room_count > 0) return refuse(r, "a body after the first scene");
  if (robot_find(file, 0, r->fields[1], &found))
    return refuse_field(r, "a second body of this name", r->fields[1]);
  if (!robot_link(r, file, r->fields[2], &link) || !robot_read_words(r, 4, &pose, scale)) return 0;
  const size_t mesh = robot_find_mesh(file, r, r->fields[3], scale);
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
  double clearance = -1;
  if (r->field_count != 3 && r->field_count != 4)
    return refuse(r, "expected: pair NAME NAME [METRES]");
  if (file->room_count > 0) return refuse(r, "a pair after the first scene");
  for (int k = 0; k < 2; k++)
    if (!robot_find(file, 0, r->fields[1 + k], &at[k]))
      return refuse_field(r, "no body of this name above", r->fields[1 + k]);
  if (file->things[at[0]].link == file->things[at[1]].link)
    return refuse(r, "both follow the same joint");
  if (r->field_count == 4 && !robot_number(r, r->fields[3], &clearance)) return 0;
  if (r->field_count == 4 && clearance < 0)
    return refuse_field(r, "a clearance is negative", r->fields[3]);
  robot_pair *pair = ROBOT_ADD(file->pairs, file->pair_count, file->pair_capacity);
  pair->parts.a = (uint32_t)at[0];
  pair->parts.b = (uint32_t)at[1];
  pair->clearance = (float)clearance;
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
  nsvcd_pose pose;
  double scale[3];
  if (r->field_count < 10)
    return refuse(r, "expected: obstacle NAME PATH x y z qx qy qz qw [scale SX SY SZ]");
  if (file->room_count == 0) return refuse(r, "no scene above");
  robot_room *room = &file->rooms[file->room_count - 1];
  if (robot_find(file, room->first, r->fields[1], &found))
    return refuse_field(r, "a second body of this name", r->fields[1]);
  if (!read_pose(r, r->fields + 3, &pose) || !robot_read_words(r, 10, NULL, scale)) return 0;
  const size_t mesh = robot_find_mesh(file, r, r->fields[2], scale);
  robot_thing *thing = ROBOT_ADD(file->things, file->thing_count, file->thing_capacity);
  thing->name = r->fields[1];
  thing->mesh = mesh;
  thing->pose = pose;
  room->count++;
  return 1;
}

static int robot_read_joints(const reader *r, robot_file *file, char *const *fields) {
  for (size_t j = 0; j < file->joint_count; j++) {
    double number;
    if (!robot_number(r, fields[j], &number)) return 0;
    *ROBOT_ADD(file->numbers, file->number_count, file->number_capacity) = number;
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

static int robot_read_task(reader *r, robot_file *file) {
  robot_task task;
  const size_t joints = file->joint_count;
  char *const *f = r->fields;
  const int is_path = strcmp(f[0], "path") == 0;
  const int has_goal = r->field_count == 3 + 2 * joints;
  memset(&task, 0, sizeof task);
  if (is_path ? r->field_count != 4 : r->field_count != 3 + joints && !has_goal) {
    if (is_path) return refuse(r, "expected: path ID SCENE COUNT");
    return complain(
        "%s:%zu: expected: plan ID SCENE, then %zu joints of the start, and perhaps of a goal",
        r->path, r->line, joints);
  }
  task.id = f[1];
  task.line = r->line;
  task.first = file->number_count;
  if (!robot_find_room(file, f[2], &task.room))
    return refuse_field(r, "no scene of this name above", f[2]);
  if (!is_path && !robot_read_joints(r, file, f + 3)) return 0;
  if (is_path && !parse_count(f[3], 1, 10000000, &task.points))
    return refuse_field(r, "COUNT is not in 1..10000000", f[3]);
  for (size_t i = 0; i < task.points; i++) {
    if (!next_line(r) || r->field_count != joints)
      return complain("%s:%zu: path %s has %zu of its %zu lines of %zu joints", r->path, task.line,
                      task.id, i, task.points, joints);
    if (!robot_read_joints(r, file, r->fields)) return 0;
  }
  *ROBOT_ADD(file->tasks, file->task_count, file->task_capacity) = task;
  if (is_path || !has_goal) return 1;
  robot_add_goal(r, file, file->task_count - 1);
  return robot_read_joints(r, file, f + 3 + joints);
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
  robot_goal *goal = robot_add_goal(r, file, task - 1);
  if (!is_pose) return robot_read_joints(r, file, f + 2);
  if (!robot_find(file, file->thing_count, f[10], &goal->thing))
    return refuse_field(r, "no body of this name", f[10]);
  if (!file->things[goal->thing].link) return refuse_field(r, "this body follows no joint", f[10]);
  return read_pose(r, f + 3, &goal->pose) && robot_read_region(r, goal);
}

static int read_robot(const char *path, robot_file *file) {
  static const struct {
    const char *word;
    int (*read)(const reader *r, robot_file *file);
  } lines[] = {{"joint", robot_read_joint},       {"body", robot_read_body},
               {"pair", robot_read_pair},         {"scene", robot_read_scene},
               {"obstacle", robot_read_obstacle}, {"goal", robot_read_goal}};
  const size_t words = sizeof lines / sizeof lines[0];
  reader r;
  memset(file, 0, sizeof *file);
  file->path = shown_name(path);
  if (!open_reader(path, "nsvcd-plans", &file->text, &r)) return 0;
  while (next_line(&r)) {
    const int is_task = strcmp(r.fields[0], "plan") == 0 || strcmp(r.fields[0], "path") == 0;
    size_t k = 0;
    while (k < words && strcmp(lines[k].word, r.fields[0]) != 0) k++;
    if (k == words && !is_task)
      return refuse_field(
          &r, "expected 'joint', 'body', 'pair', 'scene', 'obstacle', 'plan', 'goal' or 'path'",
          r.fields[0]);
    if (r.field_count > MOST_FIELDS) return refuse(&r, "too many fields");
    if (!(is_task ? robot_read_task(&r, file) : lines[k].read(&r, file))) return 0;
  }
  for (size_t i = 0; i < file->task_count; i++) {
    const robot_task *task = &file->tasks[i];
    if (!task->points && !task->goal_count)
      return complain("%s:%zu: plan %s has no goal, here or on lines 'goal %s ...' below",
                      file->path, task->line, task->id, task->id);
  }
  return 1;
}

// Notes which meshes are needed: those of the robot, and of a room, unless it is NSVCD_NONE.
static void need_room(robot_file *file, size_t room) {
  const size_t first = room == NSVCD_NONE ? 0 : file->rooms[room].first;
  const size_t count = room == NSVCD_NONE ? 0 : file->rooms[room].count;
  for (size_t n = 0; n < file->body_count; n++) {
    file->meshes[file->things[n].mesh].is_needed = 1;
    if (file->things[n].link) file->meshes[file->things[n].mesh].moves = 1;
  }
  for (size_t n = first; n < first + count; n++) file->meshes[file->things[n].mesh].is_needed = 1;
}

// Loads and encodes the meshes that are needed; balls are for those that move. Returns 0 after a
// complaint.
static int encode_robot(robot_file *file, const nsvcd_encode_options *options, size_t *count,
                        double *taken) {
  *count = 0;
  *taken = 0;
  for (size_t i = 0; i < file->mesh_count; i++) {
    robot_mesh *mesh = &file->meshes[i];
    char from[1024];
    double one;
    nsvcd_encode_options own = *options;
    if (!mesh->moves) own.balls = 0;
    if (!mesh->is_needed) continue;
    ++*count;
    snprintf(from, sizeof from, "%s:%zu: %s %s: ", file->path, mesh->line, mesh->kind, mesh->name);
    mesh->body = encode_named(from, file->path, mesh->path, mesh->scale, &own, &one);
    if (!mesh->body) return 0;
    *taken += one;
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
  free(file->rooms);
  free(file->tasks);
  free(file->goals);
  free(file->numbers);
}

// The robot in a scene, and a checker of it.
typedef struct robot_in_room {
  const robot_file *file;
  const robot_room *room;
  nsvcd_part *parts;
  nsvcd_body_pair *pairs;
  float *clearances;
  nsvcd_scene scene;
  void *memory;
  nsvcd_checker *checker;
} robot_in_room;

static const robot_thing *robot_thing_of(const robot_in_room *in, size_t part) {
  const size_t bodies = in->file->body_count;
  return &in->file->things[part < bodies ? part : in->room->first + part - bodies];
}
static const char *robot_name(const robot_in_room *in, size_t part) {
  return robot_thing_of(in, part)->name;
}

static void leave_room(robot_in_room *in) {
  free(in->parts);
  free(in->pairs);
  free(in->clearances);
  free(in->memory);
  memset(in, 0, sizeof *in);
}

// Pairs are those of the file, and each body that moves with each obstacle. room: NSVCD_NONE: there
// are no obstacles. clearance: metres, of pairs that have none of their own. Returns 0 after a
// complaint.
static int enter_room(const robot_file *file, size_t room, float clearance, robot_in_room *in) {
  static const robot_room nowhere = {"", 0, 0};
  const size_t bodies = file->body_count;
  leave_room(in);
  in->file = file;
  in->room = room == NSVCD_NONE ? &nowhere : &file->rooms[room];
  const size_t count = bodies + in->room->count;
  in->parts = (nsvcd_part *)allocate(count * sizeof *in->parts);
  const size_t most = file->pair_count + bodies * in->room->count;
  in->pairs = (nsvcd_body_pair *)allocate(most * sizeof *in->pairs);
  in->clearances = (float *)allocate(most * sizeof *in->clearances);
  memset(in->parts, 0, count * sizeof *in->parts);
  for (size_t n = 0; n < count; n++) {
    const robot_thing *thing = &file->things[n < bodies ? n : in->room->first + n - bodies];
    in->parts[n].body = file->meshes[thing->mesh].body;
    in->parts[n].link = thing->link;
    in->parts[n].pose = thing->pose;
  }
  nsvcd_scene *scene = &in->scene;
  scene->joints = file->joints;
  scene->joint_count = file->joint_count;
  scene->parts = in->parts;
  scene->part_count = count;
  scene->pairs = in->pairs;
  scene->pair_count = file->pair_count;
  scene->clearances = in->clearances;
  for (size_t n = 0; n < most; n++) in->clearances[n] = clearance;
  for (size_t n = 0; n < file->pair_count; n++) {
    in->pairs[n] = file->pairs[n].parts;
    if (file->pairs[n].clearance >= 0) in->clearances[n] = file->pairs[n].clearance;
  }
  for (size_t a = 0; a < bodies; a++) {
    for (size_t b = bodies; b < count && in->parts[a].link > 0; b++) {
      const nsvcd_body_pair pair = {(uint32_t)a, (uint32_t)b};
      in->pairs[scene->pair_count++] = pair;
    }
  }
  const size_t size = nsvcd_checker_size(scene);
  in->memory = allocate(size);
  const nsvcd_result result = nsvcd_checker_open(scene, in->memory, size, &in->checker);
  if (result) return complain("%s: scene %s: %s", file->path, in->room->name, reason_of(result));
  return 1;
}
#endif  // NSVCD_SCENERY_ROBOT_FILE_H
