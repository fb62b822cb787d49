// throw.c - a room to throw things in, as a WebAssembly module for throw.js: things, and one who
// walks among them, are movers of an nsvcd_world. Each move is proven free before it is made, so that
// no two ever overlap; throw_overlaps asks whether that is so.
//
// The module imports nothing, not even a clock. throw.js reads the structs in linear memory.
#define NSVCD_NO_STDIO
#define NSVCD_NO_NETWORK
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "../../extras/neuralsvcd_world.h"
#include "../scenery/level.h"
#include "../scenery/props.h"

// A thing, as throw.js reads it.
typedef struct thing {
  int kind;  // -1: there is nothing
  int asleep;
  nsvcd_pose pose;
} thing;

#define EXPORT(name) __attribute__((export_name(#name))) name

// ROOM is all of it; what comes after are its parts, to be drawn in colours of their own.
enum { KINDS = 9, WALKER = KINDS, ROOM, FLOOR, WALLS, BUILT, MESHES };
#define MOST 60  // thrown things at a time: then the oldest goes
#define CAPSULE_RADIUS 0.25f
#define CAPSULE_HALF 0.55f  // metres: half its axis
#define BOTTOM (-8.0f)      // metres: what fell as low as that is gone

static shapes_mesh meshes[MESHES];
static props_shape shapes[ROOM + 1];
static nsvcd_world *world;
static void *memory, *workspace;
static size_t workspace_size;
static nsvcd_world_mover movers[MOST + 1];  // who walks is the first
static thing things[MOST + 1];
static size_t count, next;
static float walking[2];
static size_t counts[2];  // questions, and contacts
static shapes_rng rng = {2026};

// ------------------------------------------------------------------------------------------ making

static void make_props(void) {
  shapes_mug(&meshes[0], 0.15, 0.32, 0.02, 32);
  shapes_bowl(&meshes[1], 0.3, 0.17, 0.025, 32);
  shapes_torus(&meshes[2], 0.24, 0.08, 32, 16);
  shapes_box(&meshes[3], 0.42, 0.34, 0.38, 1);
  shapes_chair(&meshes[4], 0.44, 0.9, 0.055);
  shapes_bottle(&meshes[5], 0.11, 0.5, 32);
  shapes_gear(&meshes[6], 0.28, 0.06, 0.12, 16);
  shapes_knot(&meshes[7], 0.2, 0.06, 96, 12);
  level_boulder(&meshes[8], 0.24, 16, 1);
  shapes_capsule(&meshes[WALKER], (double)CAPSULE_RADIUS, 2 * (double)CAPSULE_HALF, 32);
}

// 9 x 7 metres, with a pit that a ramp leads out of, and walls that are low where one looks in.
static void make_floor(shapes_mesh *room) {
  static const double pit[8][2] = {{-4.5, -0.8}, {4.5, -0.8}, {4.5, 0}, {2, 0},
                                   {2, -0.6},    {0.6, -0.6}, {-1, 0},  {-4.5, 0}};
  const double upright[4] = {sqrt(0.5), 0, 0, sqrt(0.5)};
  const size_t first = room->vertices;
  shapes_extrude(room, pit, 8, 2);
  shapes_place(room, first, upright, 0, -0.9, 0);
  shapes_box_at(room, 0, -2.7, -0.4, 9, 1.6, 0.8);
  shapes_box_at(room, 0, 1.8, -0.4, 9, 3.4, 0.8);
}
static void make_walls(shapes_mesh *room) {
  shapes_box_at(room, 0, 3.6, 0.8, 9.4, 0.2, 3.2);
  shapes_box_at(room, 0, -3.6, -0.1, 9.4, 0.2, 1.4);
  shapes_box_at(room, -4.6, 0, 0.3, 0.2, 7, 2.2);
  shapes_box_at(room, 4.6, 0, 0.3, 0.2, 7, 2.2);
}
// Moves what was made last, from vertex `first` on, and says where the next begins.
static size_t put(shapes_mesh *room, size_t first, const double *turn, double x, double y) {
  shapes_place(room, first, turn, x, y, 0);
  return room->vertices;
}
static void make_built(shapes_mesh *room) {
  const double quarter[4] = {0, 0, sqrt(0.5), sqrt(0.5)};
  size_t first = room->vertices;
  level_stairs(room, 1.4, 0.28, 0.17, 6);
  first = put(room, first, NULL, -3.2, 2.8);
  level_pillar(room, 0.28, 2.4, 32);
  first = put(room, first, NULL, 3.4, 2.4);
  level_arch(room, 0.9, 0.13, 40);
  first = put(room, first, quarter, -2.6, -0.8);
  level_boulder(room, 0.6, 24, 1);
  first = put(room, first, NULL, 3.4, -0.2);
  shapes_cup(room, 0.5, 0.4, 0.06, 1.3, 48);
  first = put(room, first, NULL, -0.6, 1.1);
  shapes_shelf(room, 1.4, 0.5, 1.3, 0.05, 3, 1);
  put(room, first, quarter, -4.2, 1);
}

// A part of a mesh, to be drawn: triangles from one to before another.
static void cut(shapes_mesh *part, const shapes_mesh *whole, size_t from, size_t to) {
  *part = *whole;
  part->indices += 3 * from;
  part->triangles = to - from;
}

static nsvcd_result make_shapes(void) {
  const float from[3] = {0, 0, -CAPSULE_HALF};
  const float to[3] = {0, 0, CAPSULE_HALF};
  shapes_mesh *room = &meshes[ROOM];
  make_props();
  make_floor(room);
  const size_t floor = room->triangles;
  make_walls(room);
  const size_t walls = room->triangles;
  make_built(room);
  cut(&meshes[FLOOR], room, 0, floor);
  cut(&meshes[WALLS], room, floor, walls);
  cut(&meshes[BUILT], room, walls, room->triangles);
  for (size_t k = 0; k <= ROOM; k++) {
    nsvcd_result result = NSVCD_ERROR_MEMORY;
    if (k == WALKER && !meshes[k].failed)
      result = nsvcd_encode_capsule(from, to, CAPSULE_RADIUS, NULL, &shapes[k].body);
    else if (k != WALKER)
      result = props_encode(&meshes[k], k == ROOM ? 0.2f : 0, &shapes[k]);
    if (result) return result;
  }
  return NSVCD_OK;
}

// ----------------------------------------------------------------------------------------- playing

static int is_free(const nsvcd_world_mover *m) {
  return m->id && props_is_free(world, m, workspace, workspace_size);
}

// What throw.js sees of a mover.
static void show(size_t k) {
  nsvcd_world_body body;
  if (nsvcd_world_get(world, movers[k].id, &body)) return;
  things[k].pose = body.pose;
  things[k].asleep = movers[k].asleep;
}

// The room, and who walks there, and nothing else: at first, and again.
nsvcd_result EXPORT(throw_init)(void) {
  const nsvcd_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  const nsvcd_pose start = {{-4, 2.8f, 0.9f}, {0, 0, 0, 1}};
  const size_t size = nsvcd_world_size(MOST + 2);
  nsvcd_result result = shapes[ROOM].body ? NSVCD_OK : make_shapes();
  if (result) return result;
  workspace_size = nsvcd_sweep_workspace_size(NULL);
  if (!memory) memory = malloc(size);
  if (!workspace) workspace = malloc(workspace_size);
  if (!memory || !workspace) return NSVCD_ERROR_MEMORY;
  result = nsvcd_world_begin(memory, size, MOST + 2, &world);
  if (result) return result;
  if (!props_add(world, &shapes[ROOM], 1, 0, &origin)) return NSVCD_ERROR_COUNT;
  movers[0] = props_character(props_add(world, &shapes[WALKER], 1, 1, &start), 40, 0.25f);
  for (size_t k = 0; k <= MOST; k++) things[k].kind = -1;
  things[0].kind = WALKER;
  count = 1;
  next = counts[0] = counts[1] = 0;
  walking[0] = walking[1] = 0;
  show(0);
  return NSVCD_OK;
}

static void drop(size_t k) {
  (void)nsvcd_world_remove(world, movers[k].id);
  movers[k] = movers[--count];
  things[k] = things[count];
  things[count].kind = -1;
}

// Whether there is room for it where it starts, about its centre of mass. It turns at random. Of too many the oldest goes.
int EXPORT(throw_thing)(size_t kind, float x, float y, float z, float to_x, float to_y,
                        float to_z) {
  double q[4];
  nsvcd_pose pose = {{x, y, z}, {0, 0, 0, 1}};
  shapes_quaternion(&rng, q);
  for (int k = 0; k < 4; k++) pose.rotation[k] = (float)q[k];
  if (count == MOST + 1) drop(1 + next++ % MOST);
  const size_t id = props_add(world, &shapes[kind], 1, 5, &pose);
  nsvcd_world_mover m = props_mover(id, &shapes[kind], 1, 5, 0.002f);
  if (!is_free(&m)) return (void)nsvcd_world_remove(world, id), 0;
  const nsvcd_velocity velocity = {{to_x, to_y, to_z},
                                   {3 * pose.rotation[2], 3 * pose.rotation[0], 2}};
  m.velocity = velocity;
  movers[count] = m;
  things[count].kind = (int)kind;
  show(count++);
  return 1;
}

// Metres a second, until told otherwise.
void EXPORT(throw_walk)(float x, float y) {
  walking[0] = x;
  walking[1] = y;
}

nsvcd_result EXPORT(throw_step)(float seconds) {
  nsvcd_step_options options = {{0, 0, -9.81f}, 0, 0};
  nsvcd_step_answer answer;
  memcpy(movers[0].velocity.linear, walking, sizeof walking);
  const nsvcd_result result =
      nsvcd_world_step(world, movers, count, &options, seconds, workspace, workspace_size, &answer);
  if (result) return result;
  counts[0] += answer.questions;
  counts[1] += answer.contacts;
  for (size_t k = count; k-- > 0;) {
    show(k);
    if (k > 0 && things[k].pose.position[2] < BOTTOM) drop(k);
  }
  return NSVCD_OK;
}

// How many of what can move are not proven to be apart from all else, as they stand.
size_t EXPORT(throw_overlaps)(void) {
  size_t overlaps = 0;
  for (size_t k = 0; k < count; k++) {
    nsvcd_world_mover m = movers[k];
    m.how.clearance = 0;
    overlaps += !is_free(&m);
  }
  return overlaps;
}

// One after the other, those that are not there too, and how many bytes each has.
const thing *EXPORT(throw_things)(void) {
  return things;
}
size_t EXPORT(throw_count)(void) {
  return MOST + 1;
}
size_t EXPORT(throw_size)(void) {
  return sizeof(thing);
}
// Since throw_init: questions, and contacts.
const size_t *EXPORT(throw_counts)(void) {
  return counts;
}
const shapes_mesh *EXPORT(throw_mesh)(size_t which) {
  return &meshes[which];
}
const char *EXPORT(throw_result_string)(nsvcd_result result) {
  return nsvcd_result_string(result);
}
