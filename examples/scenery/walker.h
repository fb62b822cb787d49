// walker.h - a character among the things of physics.h: along walls, up stairs and slopes, by casts
// of a capsule, each of them proven free; what is in its way it pushes.
//
//   physics_walker walker = {thing, 0.25f, 0.7f, 40, 0, 0};
//   physics_walk(world, &walker, 1.5f, 0, 1.0f / 60);  // and then physics_step
#ifndef NSVCD_SCENERY_WALKER_H
#define NSVCD_SCENERY_WALKER_H

#include "physics.h"

// A thing that weighs nothing, such as a capsule (nsvcd_encode_capsule), that goes where it wants
// to: along walls, up stairs and slopes.
typedef struct physics_walker {
  size_t thing;
  float step;      // metres: as high a stair it climbs
  float slope;     // the least cosine of ground that it stands on
  float strength;  // kilograms: what it pushes counts against that
  float fall;      // metres a second
  int stands;
} physics_walker;

PHYSICS_DEF float physics_cast(physics_world *w, size_t i, physics_vec way, physics_vec *normal) {
  nsvcd_pose to = w->things[i].pose;
  to.position[0] += way.x;
  to.position[1] += way.y;
  to.position[2] += way.z;
  *normal = physics_of(0, 0, 0);
  return physics_length(way) > PHYSICS_STILL ? physics_go(w, i, &to, normal) : 1;
}

// Gives what is in the way of the walker that speed.
PHYSICS_DEF void physics_shove(physics_world *w, const physics_walker *walker, physics_vec speed) {
  for (size_t k = 0; k < w->touch_count; k++) {
    const physics_seen s = physics_see(w, &w->touches[k]);
    if (w->touches[k].a != walker->thing || !(s.b->inverse_mass > 0)) continue;
    const float into = -physics_dot(physics_minus(speed, s.b->velocity), s.normal);
    const float fraction = 1 / (1 + 1 / (walker->strength * s.b->inverse_mass));
    if (!(into > 0)) continue;
    physics_wake(s.b);
    s.b->velocity = physics_plus(s.b->velocity, -into * fraction, s.normal);
  }
}

// Goes sideways, and along what it meets. Returns whether anything was met.
PHYSICS_DEF int physics_slide(physics_world *w, physics_walker *walker, physics_vec way,
                              physics_vec speed) {
  int met = 0;
  for (int round = 0; round < 3; round++) {
    physics_vec normal;
    const float fraction = physics_cast(w, walker->thing, way, &normal);
    if (fraction >= 1 || !(physics_length(normal) > 0)) return met;
    met = 1;
    physics_shove(w, walker, speed);
    way = physics_times(1 - fraction, way);
    normal.z = 0;
    const float length = physics_length(normal);
    if (!(length > 1e-3f)) return met;
    const float into = physics_dot(way, normal) / length;
    // a little off it, lest rounding hold it there
    way = physics_plus(way, (1e-4f - fminf(into, 0)) / length, normal);
  }
  return met;
}

// Does what is ahead rise by no more than a step in a step's length? Then an edge that the thing
// came down on is that of a stair. It is left there, a step ahead.
PHYSICS_DEF int physics_is_stair(physics_world *w, const physics_walker *walker, physics_vec way) {
  physics_vec normal;
  const float length = physics_length(way);
  return length > 0 &&
         physics_cast(w, walker->thing, physics_times(walker->step / length, way), &normal) >= 1;
}

// Takes a step up by `rise`, sideways, and down again. Returns 0 if that leads up what is too
// steep.
PHYSICS_DEF int physics_stride(physics_world *w, physics_walker *walker, physics_vec speed,
                               float rise, float seconds) {
  physics_thing *t = &w->things[walker->thing];
  const float height = t->pose.position[2];
  const physics_vec way = physics_times(seconds, speed);
  physics_vec normal;
  rise *= physics_cast(w, walker->thing, physics_of(0, 0, rise), &normal);
  physics_slide(w, walker, way, speed);
  const nsvcd_pose above = t->pose;
  const float drop = rise + walker->fall * seconds + 2e-3f;
  const float fraction = physics_cast(w, walker->thing, physics_of(0, 0, -drop), &normal);
  const nsvcd_pose landed = t->pose;
  int stands = fraction < 1 && normal.z >= walker->slope;
  if (fraction < 1 && !stands && rise > 0) {
    t->pose = above;
    stands = physics_is_stair(w, walker, way);
    t->pose = landed;
    if (!stands && landed.position[2] > height + 0.01f) return 0;
  }
  if (fraction < 1 && !stands) {  // down along what is too steep to stand on
    const float left = fmaxf((1 - fraction) * drop, 1e-3f);
    const physics_vec down = physics_of(left * normal.z * normal.x, left * normal.z * normal.y,
                                        left * (normal.z * normal.z - 1));
    physics_cast(w, walker->thing, down, &normal);
  }
  if (fraction >= 1 && walker->stands) {  // down a stair, if there is one
    const float more = physics_cast(w, walker->thing, physics_of(0, 0, -walker->step), &normal);
    stands = more < 1;
    if (!stands) t->pose = landed;
  }
  walker->stands = stands;
  return 1;
}

// One frame of walking: up by a step, sideways, and down again; if that would lead up what is too
// steep, along the ground alone.
PHYSICS_DEF void physics_walk(physics_world *w, physics_walker *walker, float x, float y,
                              float seconds) {
  physics_thing *t = &w->things[walker->thing];
  const nsvcd_pose start = t->pose;
  const physics_vec speed = physics_of(x, y, 0);
  walker->fall = walker->stands ? 0 : walker->fall - w->gravity.z * seconds;
  if (!walker->stands || !physics_stride(w, walker, speed, walker->step, seconds)) {
    t->pose = start;
    physics_stride(w, walker, speed, 0, seconds);
  }
  t->velocity = physics_times(
      1 / seconds, physics_minus(physics_from(t->pose.position), physics_from(start.position)));
}

#endif
