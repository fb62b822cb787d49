// throw.c - a room to throw things in, as a WebAssembly module for throw.js: scenery/physics.h
// moves the things and scenery/walker.h one who walks among them. Each move is proven free before it is
// made, so that no two ever overlap; throw_overlaps asks whether that is so.
//
// The module imports nothing, not even a clock. throw.js reads the structs in linear memory: all
// their fields have four bytes on wasm32.
#define NSVCD_NO_STDIO
#define NSVCD_NO_NETWORK
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#include "../scenery/level.h"
#include "../scenery/walker.h"

// throw.js counts on it.
_Static_assert(sizeof(physics_thing) == 4 * 24 && offsetof(physics_thing, asleep) == 4 * 20, "");

#define EXPORT(name) __attribute__((export_name(#name))) name

// ROOM is all of it; what comes after are its parts, to be drawn in colours of their own.
enum { KINDS = 9, WALKER = KINDS, ROOM, FLOOR, WALLS, BUILT, MESHES };
#define MOST 60  // thrown things at a time: then the oldest goes
#define CAPSULE_RADIUS 0.25f
#define CAPSULE_HALF 0.55f  // metres: half its axis
#define BOTTOM (-8.0f)      // metres: what fell as low as that is gone

static shapes_mesh meshes[MESHES];
static physics_shape shapes[ROOM + 1];
static physics_world *world;
static physics_walker walker;
static float walking[2];
static size_t thrown[MOST], next;
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
    nsvcd_encode_options options = {0};
    const shapes_mesh *m = &meshes[k];
    nsvcd_result result = NSVCD_ERROR_MEMORY;
    options.patch_radius = k == ROOM ? 0.2f : 0;
    if (!m->failed && k == WALKER)
      result = nsvcd_encode_capsule(from, to, CAPSULE_RADIUS, NULL, &shapes[k].body);
    else if (!m->failed)
      result = physics_encode(m->positions, m->vertices, m->indices, m->triangles, &options,
                              k != ROOM, &shapes[k]);
    if (result) return result;
  }
  return NSVCD_OK;
}

// ----------------------------------------------------------------------------------------- playing

// The room, and who walks there, and nothing else: at first, and again.
nsvcd_result EXPORT(throw_init)(void) {
  const nsvcd_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  const nsvcd_pose start = {{-4, 2.8f, 0.9f}, {0, 0, 0, 1}};
  const nsvcd_result result = shapes[ROOM].body ? NSVCD_OK : make_shapes();
  if (result) return result;
  free(world);
  world = physics_new(shapes, MOST + 2);
  if (!world) return NSVCD_ERROR_MEMORY;
  physics_add(world, ROOM, 1, 0, &origin);
  const physics_walker first = {physics_add(world, WALKER, 1, 0, &start), 0.25f, 0.7f, 40, 0, 0};
  walker = first;
  walking[0] = walking[1] = 0;
  for (size_t n = 0; n < MOST; n++) thrown[n] = PHYSICS_NOTHING;
  return NSVCD_OK;
}

// Whether there is room for it where it starts. It turns at random.
int EXPORT(throw_thing)(size_t kind, float x, float y, float z, float to_x, float to_y,
                        float to_z) {
  double q[4];
  nsvcd_pose pose = {{x, y, z}, {0, 0, 0, 1}};
  size_t *slot = &thrown[next % MOST];
  shapes_quaternion(&rng, q);
  for (int k = 0; k < 4; k++) pose.rotation[k] = (float)q[k];
  if (*slot != PHYSICS_NOTHING) physics_remove(world, *slot);
  *slot = physics_add(world, kind, 1, 5, &pose);
  if (*slot == PHYSICS_NOTHING) return 0;
  world->things[*slot].velocity = physics_of(to_x, to_y, to_z);
  world->things[*slot].spin = physics_of(3 * pose.rotation[2], 3 * pose.rotation[0], 2);
  next++;
  return 1;
}

// Metres a second, until told otherwise.
void EXPORT(throw_walk)(float x, float y) {
  walking[0] = x;
  walking[1] = y;
}

nsvcd_result EXPORT(throw_step)(float seconds) {
  physics_walk(world, &walker, walking[0], walking[1], seconds);
  const nsvcd_result result = physics_step(world, seconds);
  for (size_t n = 0; n < MOST; n++) {
    if (thrown[n] == PHYSICS_NOTHING) continue;
    if (world->things[thrown[n]].pose.position[2] > BOTTOM) continue;
    physics_remove(world, thrown[n]);
    thrown[n] = PHYSICS_NOTHING;
  }
  return result;
}

// How many of what can move are not proven to be apart from all else, as they stand.
size_t EXPORT(throw_overlaps)(void) {
  const physics_counts counts = world->counts;
  const float clearance = world->clearance;
  size_t overlaps = 0;
  world->clearance = 0;
  for (size_t i = 1; i < world->count; i++) {
    int is_free = 1;
    if (world->things[i].shape == PHYSICS_NOTHING) continue;
    physics_look(world, i, &world->things[i].pose);
    for (size_t k = 0; k < world->near_count; k++)
      is_free &= world->answers[k].verdict == NSVCD_FREE;
    overlaps += !is_free;
  }
  world->clearance = clearance;
  world->counts = counts;
  return overlaps;
}

const physics_thing *EXPORT(throw_things)(void) {
  return world->things;
}
size_t EXPORT(throw_count)(void) {
  return world->count;
}
// Since throw_init.
const physics_counts *EXPORT(throw_counts)(void) {
  return &world->counts;
}
const shapes_mesh *EXPORT(throw_mesh)(size_t which) {
  return &meshes[which];
}
const char *EXPORT(throw_result_string)(nsvcd_result result) {
  return nsvcd_result_string(result);
}
