// In: bodies at their places. Out: a world of them; who may meet whom.
#pragma once
#include "../interface/worlds.h"
#include "../ground/memory.h"
#include "tree.h"

// metres, as a fraction of a body's longest half: how much larger its box in the tree is than it
// need be
#define NSVCD__LOOSE 0.1

// A body of a world. It has one pose, or, driven, two: where it is, and where it will be.
typedef struct nsvcd__resident {
  nsvcd_world_body given;  // without a body: nobody
  nsvcd_pose to;
  int is_driven;
  nsvcd__shape_box shape;
  // over this frame
  nsvcd__box box;
  // when it came to where it is, on the world's clock
  uint64_t moved;
  // how often a slide has moved it
  uint64_t slides;
  uint32_t next_free;
  // which of a step's movers it was last
  uint32_t mover;
  // during that step: the driven body that carries it; that it is in the way of what this one
  // carries; or that it cannot be carried
  uint32_t carrier, joins;
  int stays;
  // when its way along was proven to be free, on the world's clock; metres and radians a second of
  // it; and its speed besides
  uint64_t proven;
  nsvcd__d3 goes, turns, slips;
  // of the last slides of steps: in how many it stood where it was, up to 2
  int stood;
} nsvcd__resident;

// One of a step's movers, and how high it is.
typedef struct nsvcd__turn {
  float height;
  uint32_t mover;
} nsvcd__turn;

struct nsvcd_world {
  nsvcd__box_tree tree;
  // (most + 1), from 1 on
  nsvcd__resident *residents;
  // free: the first of those that are nobody
  uint32_t most, count, free;
  // odd while it is being changed. Volatile, so that who asks at the same time may see that
  volatile uint32_t changes;
  // of all moves
  uint64_t clock;
  // (most): the order of the last step, and of how many movers it is
  nsvcd__turn *turns;
  uint32_t turn_count;
};

static size_t nsvcd__world_layout(size_t most, char *base, nsvcd_world **world) {
  uint64_t used = 0;
  nsvcd_world *w = NSVCD__TAKE_ROWS(nsvcd_world, 1, base, &used);
  nsvcd__resident *residents = NSVCD__TAKE_ROWS(nsvcd__resident, most + 1, base, &used);
  nsvcd__branch *nodes = NSVCD__TAKE_ROWS(nsvcd__branch, 2 * most, base, &used);
  nsvcd__turn *turns = NSVCD__TAKE_ROWS(nsvcd__turn, most, base, &used);
  if (w) {
    memset(w, 0, sizeof *w);
    w->residents = residents;
    w->turns = turns;
    w->most = (uint32_t)most;
    nsvcd__tree_begin(&w->tree, nodes, w->most);
    *world = w;
  }
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_world_size(size_t most) {
  if (most < 1 || most > 0x7ffffffe) return 0;
  return nsvcd__world_layout(most, NULL, NULL);
}

NSVCDDEF nsvcd_result nsvcd_world_begin(void *memory, size_t size, size_t most,
                                        nsvcd_world **world) {
  const size_t needed = nsvcd_world_size(most);
  if (!world) return NSVCD_ERROR_ARGUMENT;
  if (needed == 0) return NSVCD_ERROR_COUNT;
  if (!memory || !nsvcd__is_aligned(memory) || size < needed) return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__world_layout(most, (char *)memory, world);
  return NSVCD_OK;
}

// The body of an id, or NULL.
static nsvcd__resident *nsvcd__resident_of(const nsvcd_world *world, size_t id) {
  nsvcd__resident *r = id > 0 && id <= world->count ? &world->residents[id] : NULL;
  return r && r->given.body ? r : NULL;
}

static nsvcd_mover nsvcd__mover_of(const nsvcd__resident *r) {
  nsvcd_mover out;
  memset(&out, 0, sizeof out);
  out.body = r->given.body;
  out.poses = &r->given.pose;
  out.count = 1;
  out.scale = r->given.scale;
  memcpy(out.pivot, r->given.pivot, sizeof out.pivot);
  return out;
}

// Begins a change of the world, if there is none already, or ends it.
static int nsvcd__world_opens(nsvcd_world *world) {
  if (world->changes & 1) return 0;
  world->changes++;
  return 1;
}
static nsvcd_result nsvcd__world_closes(nsvcd_world *world, nsvcd_result result) {
  world->changes++;
  return result;
}

// Puts a body into the tree, or where it is now.
static void nsvcd__update_box(nsvcd_world *world, uint32_t id, int is_new) {
  nsvcd__resident *r = &world->residents[id];
  nsvcd__branch *leaf = &world->tree.nodes[id];
  const nsvcd_pose way[2] = {r->given.pose, r->to};
  const nsvcd__d3 half = r->shape.half;
  r->box = nsvcd__box_of_way(&r->shape, way, r->is_driven ? 2 : 1, 0);
  r->moved = ++world->clock;
  const nsvcd__box both = nsvcd__box_over(leaf->box, r->box);
  const int is_within = !nsvcd__f3_exceeds(both.high, leaf->box.high) &&
                        !nsvcd__f3_exceeds(leaf->box.low, both.low);
  if (!is_new && is_within) return;
  if (!is_new) nsvcd__tree_remove(&world->tree, id);
  const double longest = nsvcd__max(nsvcd__max(half.x, half.y), half.z);
  const double more = r->given.fixed ? 0 : NSVCD__LOOSE * longest;
  nsvcd__tree_insert(&world->tree, id, nsvcd__box_around(r->box, more));
}

static nsvcd_result nsvcd__world_body_check(const nsvcd_world_body *given) {
  const nsvcd_body *body = NULL;
  const nsvcd_result result = nsvcd_body_trust(given->body, SIZE_MAX, &body);
  if (result) return result;
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  const float scale = given->scale;
  if (!facts.triangles) return NSVCD_ERROR_TRIANGLES;
  if (!nsvcd__is_finite(scale) || scale < 0) return NSVCD_ERROR_SCALE;
  const int fits = scale >= NSVCD_MIN_SCALE && scale <= NSVCD_MAX_SCALE &&
                   scale * facts.radius >= NSVCD_MIN_RADIUS &&
                   scale * facts.extent <= 2 * NSVCD_MAX_COORDINATE;
  if (scale > 0 && !fits) return NSVCD_ERROR_SCALE;
  const float most = NSVCD_MAX_COORDINATE / (scale > 1 ? scale : 1);
  if (!nsvcd__in_range(given->pivot, 3, most)) return NSVCD_ERROR_PIVOT;
  return nsvcd__poses_check(&given->pose, 1);
}

NSVCDDEF nsvcd_result nsvcd_world_add(nsvcd_world *world, const nsvcd_world_body *body,
                                      size_t *id) {
  if (!world || !body || !id) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__world_opens(world)) return NSVCD_ERROR_WORLD;
  const nsvcd_result result = nsvcd__world_body_check(body);
  const int has_room = world->free || world->count < world->most;
  if (result || !has_room)
    return nsvcd__world_closes(world, result ? result : NSVCD_ERROR_COUNT);
  const uint32_t n = world->free ? world->free : world->count + 1;
  nsvcd__resident *r = &world->residents[n];
  if (world->free) world->free = r->next_free;
  if (n > world->count) world->count = n;
  memset(r, 0, sizeof *r);
  r->given = *body;
  if (!body->groups) r->given.groups = 1;
  const nsvcd_mover mover = nsvcd__mover_of(r);
  r->shape = nsvcd__shape_box_of(&mover);
  nsvcd__update_box(world, n, 1);
  *id = n;
  return nsvcd__world_closes(world, NSVCD_OK);
}

NSVCDDEF nsvcd_result nsvcd_world_remove(nsvcd_world *world, size_t id) {
  if (!world) return NSVCD_ERROR_ARGUMENT;
  nsvcd__resident *r = nsvcd__resident_of(world, id);
  if (!r) return NSVCD_ERROR_INDEX;
  if (!nsvcd__world_opens(world)) return NSVCD_ERROR_WORLD;
  nsvcd__tree_remove(&world->tree, (uint32_t)id);
  r->given.body = NULL;
  r->next_free = world->free;
  world->free = (uint32_t)id;
  return nsvcd__world_closes(world, NSVCD_OK);
}

// Has a body at a pose or, driven, on its way there.
static nsvcd_result nsvcd__world_place(nsvcd_world *world, size_t id, const nsvcd_pose *pose,
                                       int is_driven) {
  if (!world || !pose) return NSVCD_ERROR_ARGUMENT;
  nsvcd__resident *r = nsvcd__resident_of(world, id);
  if (!r) return NSVCD_ERROR_INDEX;
  const nsvcd_result result = nsvcd__poses_check(pose, 1);
  if (result) return result;
  if (!nsvcd__world_opens(world)) return NSVCD_ERROR_WORLD;
  *(is_driven ? &r->to : &r->given.pose) = *pose;
  r->is_driven = is_driven;
  nsvcd__update_box(world, (uint32_t)id, 0);
  return nsvcd__world_closes(world, NSVCD_OK);
}

NSVCDDEF nsvcd_result nsvcd_world_move(nsvcd_world *world, size_t id, const nsvcd_pose *pose) {
  return nsvcd__world_place(world, id, pose, 0);
}

NSVCDDEF nsvcd_result nsvcd_world_drive(nsvcd_world *world, size_t id, const nsvcd_pose *to) {
  return nsvcd__world_place(world, id, to, 1);
}

NSVCDDEF nsvcd_result nsvcd_world_arrive(nsvcd_world *world) {
  if (!world) return NSVCD_ERROR_ARGUMENT;
  for (size_t id = 1; id <= world->count; id++) {
    const nsvcd__resident *r = nsvcd__resident_of(world, id);
    if (!r || !r->is_driven) continue;
    const nsvcd_pose to = r->to;
    const nsvcd_result result = nsvcd__world_place(world, id, &to, 0);
    if (result) return result;
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_world_get(const nsvcd_world *world, size_t id,
                                      nsvcd_world_body *body) {
  if (!world || !body) return NSVCD_ERROR_ARGUMENT;
  const nsvcd__resident *r = nsvcd__resident_of(world, id);
  if (!r) return NSVCD_ERROR_INDEX;
  *body = r->given;
  return NSVCD_OK;
}

static int nsvcd__groups_meet(uint32_t groups, uint32_t passes,
                              const nsvcd_world_body *other) {
  return !(groups & other->passes) && !(other->groups & passes);
}

NSVCDDEF nsvcd_result nsvcd_world_pairs(const nsvcd_world *world, float distance,
                                        nsvcd_body_pair *pairs, size_t most, size_t *count) {
  if (!world || !count || (most > 0 && !pairs)) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__is_length(distance)) return NSVCD_ERROR_DISTANCE;
  const uint32_t changes = world->changes;
  size_t found = 0;
  for (uint32_t id = 1; id <= world->count; id++) {
    const nsvcd__resident *a = nsvcd__resident_of(world, id);
    if (!a) continue;
    const nsvcd__box box = nsvcd__box_around(a->box, (double)distance);
    for (uint32_t n = 0; (n = nsvcd__tree_next(&world->tree, n, &box)) != 0;) {
      const nsvcd__resident *b = &world->residents[n];
      if (n <= id || (a->given.fixed && b->given.fixed)) continue;
      if (!nsvcd__boxes_meet(&box, &b->box)) continue;
      if (!nsvcd__groups_meet(a->given.groups, a->given.passes, &b->given)) continue;
      if (found < most) {
        pairs[found].a = id;
        pairs[found].b = n;
      }
      found++;
    }
  }
  if ((changes & 1) || changes != world->changes) return NSVCD_ERROR_WORLD;
  *count = found;
  return NSVCD_OK;
}
