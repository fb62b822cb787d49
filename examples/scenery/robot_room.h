// robot_room.h - the robot of a planning file among the obstacles of one of its scenes: encoded, its
// pairs, what they keep, and a checker. Include robot_file.h first.
#ifndef NSVCD_SCENERY_ROBOT_ROOM_H
#define NSVCD_SCENERY_ROBOT_ROOM_H

// Notes which meshes are needed: those of the robot, and of a room, unless it is NSVCD_NONE.
static void need_room(robot_file *file, size_t room) {
  const size_t first = room == NSVCD_NONE ? 0 : file->rooms[room].first;
  const size_t count = room == NSVCD_NONE ? 0 : file->rooms[room].count;
  for (size_t n = 0; n < file->body_count; n++) {
    file->meshes[file->things[n].mesh].is_needed = 1;
    if (file->things[n].link) file->meshes[file->things[n].mesh].moves = 1;
  }
  for (size_t n = first; n < first + count; n++) file->meshes[file->things[n].mesh].is_needed = 1;
  for (size_t k = 0; k < file->change_count; k++)
    if (file->changes[k].link) file->meshes[file->things[file->changes[k].thing].mesh].moves = 1;
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
    mesh->body = encode_shape(from, file->path, &mesh->shape, &own, &one);
    if (!mesh->body) return 0;
    *taken += one;
  }
  return 1;
}

// The robot in a scene, and a checker of it.
typedef struct robot_in_room {
  const robot_file *file;
  const robot_room *room;
  nsvcd_part *parts;
  nsvcd_body_pair *pairs;
  float *clearances;
  nsvcd_allowance *allowances;
  nsvcd_cone *cones;
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

// Is a pair of the scene the one that a line is about?
static int robot_is_about_pair(const robot_in_room *in, const size_t *at, size_t pair) {
  const robot_thing *things = in->file->things;
  const size_t a = (size_t)(robot_thing_of(in, in->pairs[pair].a) - things);
  const size_t b = (size_t)(robot_thing_of(in, in->pairs[pair].b) - things);
  return robot_is_about(at, a, b);
}

static void leave_room(robot_in_room *in) {
  free(in->parts);
  free(in->pairs);
  free(in->clearances);
  free(in->allowances);
  free(in->cones);
  free(in->memory);
  memset(in, 0, sizeof *in);
}

// Sets the clearance of each pair of a robot in a room. asked: metres, of pairs with obstacles: they
// keep it, or what the file says, whichever is more. A line of two bodies is stronger than both.
static void set_clearances(const robot_file *file, size_t room, float asked, robot_in_room *in) {
  float all = 0;
  for (int named = 0; named < 2; named++) {
    for (size_t k = 0; k < file->clearance_count; k++) {
      const robot_clearance *line = &file->clearances[k];
      const int is_named = line->at[0] != NSVCD_NONE;
      if (line->room != NSVCD_NONE && line->room != room) continue;
      if (!named && !is_named) all = line->metres;
      for (size_t n = 0; n < in->scene.pair_count && named && is_named; n++) {
        if (robot_is_about_pair(in, line->at, n)) in->clearances[n] = line->metres;
      }
    }
    for (size_t n = 0; n < in->scene.pair_count && !named; n++)
      in->clearances[n] = n < file->pair_count ? 0 : all > asked ? all : asked;
  }
}

static int open_room(robot_in_room *in) {
  const size_t size = nsvcd_checker_size(&in->scene);
  free(in->memory);
  in->memory = allocate(size);
  const nsvcd_result result = nsvcd_checker_open(&in->scene, in->memory, size, &in->checker);
  if (!result) return 1;
  return complain("%s: scene %s: %s", in->file->path, in->room->name, reason_of(result));
}

// Adds each part with each obstacle that is on another link. pairs: NULL: only counts.
static size_t pair_with_obstacles(const robot_in_room *in, size_t parts, nsvcd_body_pair *pairs) {
  size_t count = 0;
  for (size_t a = 0; a < parts; a++) {
    const size_t after = a + 1 > in->file->body_count ? a + 1 : in->file->body_count;
    for (size_t b = after; b < parts; b++) {
      const nsvcd_body_pair pair = {(uint32_t)a, (uint32_t)b};
      if (in->parts[a].link == in->parts[b].link) continue;
      if (pairs) pairs[count] = pair;
      count++;
    }
  }
  return count;
}

// Pairs are those of the file, and each body that moves with each obstacle. room: NSVCD_NONE: there
// are no obstacles. clearance: metres, of pairs with obstacles. Returns 0 after a complaint.
static int enter_room(const robot_file *file, size_t room, float clearance, robot_in_room *in) {
  static const robot_room nowhere = {"", 0, 0};
  const size_t bodies = file->body_count;
  leave_room(in);
  in->file = file;
  in->room = room == NSVCD_NONE ? &nowhere : &file->rooms[room];
  const size_t count = bodies + in->room->count;
  in->parts = (nsvcd_part *)allocate(count * sizeof *in->parts);
  memset(in->parts, 0, count * sizeof *in->parts);
  for (size_t n = 0; n < count; n++) {
    const robot_thing *thing = &file->things[n < bodies ? n : in->room->first + n - bodies];
    in->parts[n].body = file->meshes[thing->mesh].body;
    in->parts[n].link = thing->link;
    in->parts[n].pose = thing->pose;
  }
  const size_t most = file->pair_count + pair_with_obstacles(in, count, NULL);
  in->pairs = (nsvcd_body_pair *)allocate(most * sizeof *in->pairs);
  in->clearances = (float *)allocate(most * sizeof *in->clearances);
  nsvcd_scene *scene = &in->scene;
  scene->joints = file->joints;
  scene->joint_count = file->joint_count;
  scene->parts = in->parts;
  scene->part_count = count;
  scene->pairs = in->pairs;
  scene->pair_count = most;
  scene->clearances = in->clearances;
  for (size_t n = 0; n < file->pair_count; n++) in->pairs[n] = file->pairs[n];
  pair_with_obstacles(in, count, in->pairs + file->pair_count);
  set_clearances(file, room, clearance, in);
  return open_room(in);
}

// Lets what the file allows for a task touch near these configurations. Returns 0 after a complaint.
static int allow_near(robot_in_room *in, size_t task, const double *start, const double *rows,
                      size_t row_count) {
  const robot_file *file = in->file;
  size_t count = 0;
  size_t capacity = 0;
  free(in->allowances);
  in->allowances = NULL;
  for (size_t k = 0; k < file->allow_count; k++) {
    const robot_allow *allow = &file->allows[k];
    if (!robot_is_allowed(allow, task, file->tasks[task].room)) continue;
    for (size_t n = 0; n < in->scene.pair_count; n++) {
      if (!robot_is_about_pair(in, allow->at, n)) continue;
      for (size_t i = 0; i <= row_count; i++) {
        const double *joints = i ? rows + (i - 1) * file->joint_count : start;
        const nsvcd_allowance allowance = {n, joints, allow->metres * ALLOWED_SHARE};
        *ROBOT_ADD(in->allowances, count, capacity) = allowance;
      }
    }
  }
  in->scene.allowances = in->allowances;
  in->scene.allowance_count = count;
  return count == 0 || open_room(in);
}

// Takes the cones that the file says for a task, of what a joint moves. Returns 0 after a complaint.
static int keep_axes(robot_in_room *in, size_t task) {
  const robot_file *file = in->file;
  size_t capacity = 0;
  nsvcd_scene *scene = &in->scene;
  free(in->cones);
  in->cones = NULL;
  scene->cone_count = 0;
  for (size_t k = 0; k < file->keep_count; k++) {
    const robot_keep *keep = &file->keeps[k];
    const size_t thing = keep->thing;
    if (!robot_is_kept(keep, task, file->tasks[task].room) || !file->things[thing].link) continue;
    nsvcd_cone *cone = ROBOT_ADD(in->cones, scene->cone_count, capacity);
    *cone = keep->cone;
    cone->part =
        (uint32_t)(thing < file->body_count ? thing : file->body_count + thing - in->room->first);
  }
  scene->cones = in->cones;
  return scene->cone_count == 0 || open_room(in);
}

// Attaches and releases what the file says before a task, where everything is at its start. Returns
// 0 if that is not known (NULL), or after a complaint.
static int change_things(robot_file *file, size_t task, const double *start, float clearance,
                         robot_in_room *in) {
  for (size_t k = 0; k < file->change_count; k++) {
    robot_change *change = &file->changes[k];
    robot_thing *thing = &file->things[change->thing];
    nsvcd_part part;
    if (change->task != task) continue;
    if (!start) return 0;
    if (!enter_room(file, file->tasks[task].room, clearance, in)) return 0;
    const size_t n = file->body_count + change->thing - in->room->first;
    const nsvcd_result result = nsvcd_reparent(in->checker, start, n, change->link, &part);
    if (result) return complain("%s:%zu: %s", file->path, change->line, reason_of(result));
    thing->link = part.link;
    thing->pose = change->pose = part.pose;
  }
  return 1;
}
#endif  // NSVCD_SCENERY_ROBOT_ROOM_H
