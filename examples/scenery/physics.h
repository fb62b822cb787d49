// physics.h - rigid bodies on top of the public API, for the examples: things of any mesh fall,
// bounce, pile up and sleep, and no two of them ever overlap; walker.h has a character. Include
// neuralsvcd.h first. No part of the library.
//
// Things move one after the other, the lowest first, and each asks about its own way, while all the
// others rest where they are. So what is proven of it holds, whatever the others do afterwards: no
// share of time need be agreed upon, and a pile is not held up by the one contact in it that comes
// first. It goes to the earliest of its safe places, which is a clearance from everything.
//
// No question has a skin. Of one thing that touches several, each answer would lift it another way,
// and what lies between two others cannot be lifted off both. Instead things are held a little
// farther apart than the clearance, by their speeds: where things touched is remembered while they
// hardly move, so that what rests has no speed and nothing to ask, and what slides is not stopped
// by what it slides on. What was stopped right at its start asks for less of a clearance, until it
// has got away.
//
//   physics_world *world = physics_new(shapes, 100);
//   physics_add(world, LEVEL, 1, 0, &pose);                // weighs nothing: it never moves
//   size_t i = physics_add(world, CRATE, 1, 20, &pose);    // PHYSICS_NOTHING: something is there
//   world->things[i].velocity = thrown;                    // at any time
//   physics_step(world, 1.0f / 60);
//
// Metres, kilograms, seconds; up is z. Nothing here is global, prints, or knows of a clock.
#ifndef NSVCD_SCENERY_PHYSICS_H
#define NSVCD_SCENERY_PHYSICS_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#if defined(__GNUC__)
#define PHYSICS_DEF static __attribute__((unused))
#else
#define PHYSICS_DEF static
#endif

#define PHYSICS_NOTHING ((size_t)-1)
#define PHYSICS_NEAR 128    // things that one asks about in one go, at most
#define PHYSICS_TOUCHES 16  // places where a thing touches others, about
#define PHYSICS_ROUNDS 2    // times that a thing goes and bounces in a frame; what is left is lost
#define PHYSICS_ITERATIONS 20
#define PHYSICS_WORK 4000    // units a question: what takes more is stopped early
#define PHYSICS_STILL 2e-4f  // metres in a frame: nobody sees that, and it is not asked about
#define PHYSICS_SLOW 0.4f    // metres a second: what touches, and is slower, is braked,
#define PHYSICS_QUIET 0.15f  // and what is so slow
#define PHYSICS_CALM 12      // for so many frames sleeps

// ----------------------------------------------------------------------------------------- vectors

typedef struct physics_vec {
  float x, y, z;
} physics_vec;

PHYSICS_DEF physics_vec physics_of(float x, float y, float z) {
  const physics_vec out = {x, y, z};
  return out;
}
PHYSICS_DEF physics_vec physics_from(const float *p) {
  return physics_of(p[0], p[1], p[2]);
}
PHYSICS_DEF physics_vec physics_plus(physics_vec a, float s, physics_vec b) {
  return physics_of(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}
PHYSICS_DEF physics_vec physics_times(float s, physics_vec a) {
  return physics_of(s * a.x, s * a.y, s * a.z);
}
PHYSICS_DEF physics_vec physics_minus(physics_vec a, physics_vec b) {
  return physics_plus(a, -1, b);
}
PHYSICS_DEF float physics_dot(physics_vec a, physics_vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
PHYSICS_DEF physics_vec physics_cross(physics_vec a, physics_vec b) {
  return physics_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
PHYSICS_DEF float physics_length(physics_vec a) {
  return sqrtf(physics_dot(a, a));
}
// Turns a vector by a unit quaternion x y z w, or back by it.
PHYSICS_DEF physics_vec physics_turn(const float *q, physics_vec v, int back) {
  const physics_vec u = physics_times(back ? -1.0f : 1.0f, physics_from(q));
  const physics_vec c = physics_plus(physics_cross(u, v), q[3], v);
  return physics_plus(v, 2, physics_cross(u, c));
}

// ------------------------------------------------------------------------------------------- world

// Meshes are about their centres of mass: physics_encode sees to that.
typedef struct physics_shape {
  const nsvcd_body *body;
  physics_vec half;  // half the lengths of its box, for inertia
} physics_shape;

typedef struct physics_thing {
  size_t shape;  // PHYSICS_NOTHING: there is nothing
  float scale;
  float reach;  // radius of a sphere about its origin that contains it
  nsvcd_pose pose;
  physics_vec velocity, spin;   // metres and radians a second
  float inverse_mass;           // 0: it does not move by itself
  physics_vec inverse_inertia;  // about its own axes
  int asleep;
  int calm;     // for so many frames it has been slow
  int touched;  // this frame
  int pressed;  // how often it does without a fifth of the clearance
} physics_thing;

// Where two things touch. The points are in their own frames, the normal in that of b.
typedef struct physics_touch {
  size_t a, b;
  physics_vec on_a, on_b, normal;  // the normal goes from b to a
  float bounce;                    // metres a second: away from each other, as fast as that
  float pushed, carried;  // newton seconds along the normal: this frame, and at its beginning
  physics_vec rubbed;     // across it
} physics_touch;

typedef struct physics_counts {
  size_t questions, contacts, undecided;
  size_t pressed;  // stopped where they were
} physics_counts;

// Answers questions: nsvcd_sweep_batch, or who wants to time it or to look on.
typedef nsvcd_result physics_ask(void *user, const nsvcd_question *questions, size_t count,
                                 void *workspace, size_t size, nsvcd_answer *answers);

typedef struct physics_world {
  const physics_shape *shapes;
  physics_thing *things;
  size_t count, most;
  size_t *order;  // things, the lowest first
  physics_touch *touches;
  size_t touch_count;
  physics_vec gravity;
  float clearance, to;  // metres: see nsvcd_question
  float cushion;        // metres that things rest farther apart than the clearance
  float restitution, friction;
  physics_ask *ask;     // NULL: nsvcd_sweep_batch
  void *user;           // told to it
  nsvcd_result result;  // why a question was refused, the first; then nothing moves
  physics_counts counts;
  // the thing that is moving: its path, and what is near
  nsvcd_pose path[2];
  size_t near_count, near_things[PHYSICS_NEAR];
  nsvcd_question questions[PHYSICS_NEAR];
  nsvcd_answer answers[PHYSICS_NEAR];
  void *workspace;
  size_t workspace_size;
} physics_world;

// Room for so many things, in one allocation, given back by free(). NULL without memory.
PHYSICS_DEF physics_world *physics_new(const physics_shape *shapes, size_t most) {
  const size_t workspace = nsvcd_sweep_workspace_size(NULL);
  const size_t each =
      sizeof(physics_thing) + sizeof(size_t) + PHYSICS_TOUCHES * sizeof(physics_touch);
  physics_world *w = (physics_world *)calloc(1, sizeof *w + 64 + workspace + most * each);
  if (!w) return NULL;
  w->workspace = (void *)(((uintptr_t)(w + 1) + 15) / 16 * 16);  // for NSVCD_ALIGNMENT
  w->workspace_size = workspace;
  w->order = (size_t *)(void *)((char *)w->workspace + (workspace + 15) / 16 * 16);
  w->things = (physics_thing *)(void *)(w->order + most);
  w->touches = (physics_touch *)(void *)(w->things + most);
  w->shapes = shapes;
  w->most = most;
  w->gravity = physics_of(0, 0, -9.81f);
  w->clearance = 0.002f;
  w->cushion = 0.001f;
  w->to = 0.0001f;
  w->restitution = 0.3f;
  w->friction = 0.5f;
  return w;
}

// Moves a mesh to its centre of mass, if told to, and makes it a shape.
PHYSICS_DEF nsvcd_result physics_encode(double *positions, size_t vertices, const uint32_t *indices,
                                        size_t triangles, const nsvcd_encode_options *options,
                                        int centred, physics_shape *shape) {
  double volume = 0;
  double centre[3] = {0, 0, 0};
  double half[3] = {0, 0, 0};
  for (size_t i = 0; i < triangles && centred; i++) {
    const double *a = positions + 3 * indices[3 * i];
    const double *b = positions + 3 * indices[3 * i + 1];
    const double *c = positions + 3 * indices[3 * i + 2];
    const double six = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
    volume += six;
    for (int k = 0; k < 3; k++) centre[k] += six * (a[k] + b[k] + c[k]) / 4;
  }
  float *narrow = (float *)malloc((3 * vertices + 1) * sizeof *narrow);
  if (!narrow) return NSVCD_ERROR_MEMORY;
  for (size_t i = 0; i < 3 * vertices; i++) {
    if (volume > 0) positions[i] -= centre[i % 3] / volume;
    narrow[i] = (float)positions[i];
    half[i % 3] = fmax(half[i % 3], fabs(positions[i]));
  }
  nsvcd_mesh mesh;
  memset(&mesh, 0, sizeof mesh);
  mesh.positions = narrow;
  mesh.indices = (uint32_t *)(uintptr_t)indices;
  mesh.vertex_count = vertices;
  mesh.triangle_count = triangles;
  shape->half = physics_of((float)half[0], (float)half[1], (float)half[2]);
  const nsvcd_result result = nsvcd_encode(&mesh, options, NULL, NULL, 0, &shape->body);
  free(narrow);
  return result;
}

// ------------------------------------------------------------------------------------------ asking

// Does a thing on its way come near another?
PHYSICS_DEF int physics_is_near(const physics_world *w, const physics_thing *t,
                                const physics_thing *o) {
  const physics_vec from = physics_from(w->path[0].position);
  const physics_vec way = physics_minus(physics_from(w->path[1].position), from);
  const physics_vec to = physics_minus(physics_from(o->pose.position), from);
  const float square = physics_dot(way, way);
  const float along = square > 0 ? fminf(fmaxf(physics_dot(to, way) / square, 0), 1) : 0;
  const float reach = t->reach + o->reach + w->clearance;
  return physics_length(physics_plus(to, -along, way)) <= 1.0001f * reach;
}

// The clearance of a thing. If it was stopped where it was, it asks for less, and so gets away.
PHYSICS_DEF float physics_clearance(const physics_world *w, const physics_thing *t) {
  return w->clearance * powf(0.8f, (float)t->pressed);
}

PHYSICS_DEF void physics_question(const physics_world *w, size_t i, size_t other,
                                  nsvcd_question *q) {
  const physics_thing *t = &w->things[i];
  const physics_thing *o = &w->things[other];
  memset(q, 0, sizeof *q);
  q->a.body = w->shapes[t->shape].body;
  q->a.poses = w->path;
  q->a.count = 2;
  q->a.scale = t->scale;
  q->b.body = w->shapes[o->shape].body;
  q->b.poses = &o->pose;
  q->b.count = 1;
  q->b.scale = o->scale;
  q->ask = NSVCD_ASK_FIRST;
  q->to = w->to;
  q->clearance = physics_clearance(w, t);
  q->manifold = 1;
  q->work = PHYSICS_WORK;
}

// Asks the first `count` questions. 0: they were refused.
PHYSICS_DEF int physics_answer(physics_world *w, size_t count) {
  if (w->result) return 0;
  w->result =
      (w->ask
           ? w->ask(w->user, w->questions, count, w->workspace, w->workspace_size, w->answers)
           : nsvcd_sweep_batch(w->questions, count, w->workspace, w->workspace_size, w->answers));
  w->counts.questions += count;
  return w->result == NSVCD_OK;
}

// Asks about a thing's way from where it is, against all that is near it.
PHYSICS_DEF int physics_look(physics_world *w, size_t i, const nsvcd_pose *to) {
  w->path[0] = w->things[i].pose;
  w->path[1] = *to;
  w->near_count = 0;
  for (size_t k = 0; k < w->count && w->near_count < PHYSICS_NEAR; k++) {
    if (k == i || w->things[k].shape == PHYSICS_NOTHING) continue;
    if (!physics_is_near(w, &w->things[i], &w->things[k])) continue;
    physics_question(w, i, k, &w->questions[w->near_count]);
    w->near_things[w->near_count++] = k;
  }
  return w->near_count < PHYSICS_NEAR && physics_answer(w, w->near_count);
}

// Puts a thing there, if nothing is: its number, or PHYSICS_NOTHING. What weighs nothing is put
// there in any case.
PHYSICS_DEF size_t physics_add(physics_world *w, size_t shape, float scale, float mass,
                               const nsvcd_pose *pose) {
  size_t i = 0;
  while (i < w->count && w->things[i].shape != PHYSICS_NOTHING) i++;
  if (i == w->most) return PHYSICS_NOTHING;
  const nsvcd_body_facts facts = nsvcd_body_describe(w->shapes[shape].body);
  const physics_vec h = physics_times(scale, w->shapes[shape].half);
  physics_thing *t = &w->things[i];
  memset(t, 0, sizeof *t);
  t->shape = shape;
  t->scale = scale;
  t->reach = scale * (facts.radius + physics_length(physics_from(facts.centre)));
  t->pose = *pose;
  if (i == w->count) w->order[w->count++] = i;
  if (!(mass > 0)) return i;
  const physics_vec squares = physics_of(h.x * h.x, h.y * h.y, h.z * h.z);
  t->inverse_mass = 1 / mass;
  // the inertia of a box, no thinner than a tenth of its reach: slivers spin too wildly
  const float least = 0.01f * t->reach * t->reach;
  t->inverse_inertia = physics_of(3 / mass / (squares.y + squares.z + least),
                                  3 / mass / (squares.z + squares.x + least),
                                  3 / mass / (squares.x + squares.y + least));
  int is_free = physics_look(w, i, pose);
  for (size_t k = 0; k < w->near_count; k++) is_free &= w->answers[k].verdict == NSVCD_FREE;
  if (is_free) return i;
  t->shape = PHYSICS_NOTHING;
  return PHYSICS_NOTHING;
}

PHYSICS_DEF void physics_wake(physics_thing *t) {
  t->asleep = 0;
  t->calm = 0;
}

PHYSICS_DEF void physics_remove(physics_world *w, size_t i) {
  size_t left = 0;
  for (size_t k = 0; k < w->touch_count; k++) {
    const physics_touch *touch = &w->touches[k];
    if (touch->a == i) physics_wake(&w->things[touch->b]);
    if (touch->b == i) physics_wake(&w->things[touch->a]);
    if (touch->a != i && touch->b != i) w->touches[left++] = *touch;
  }
  w->touch_count = left;
  w->things[i].shape = PHYSICS_NOTHING;
}

// -------------------------------------------------------------------------------------- impulses

PHYSICS_DEF int physics_moves(const physics_thing *t) {
  return t->shape != PHYSICS_NOTHING && t->inverse_mass > 0 && !t->asleep;
}
// Metres a second that no point of it exceeds.
PHYSICS_DEF float physics_quickness(const physics_thing *t) {
  return physics_length(t->velocity) + t->reach * physics_length(t->spin);
}
PHYSICS_DEF physics_vec physics_spun(const physics_thing *t, physics_vec turn) {
  physics_vec own = physics_turn(t->pose.rotation, turn, 1);
  own.x *= t->inverse_inertia.x;
  own.y *= t->inverse_inertia.y;
  own.z *= t->inverse_inertia.z;
  return physics_turn(t->pose.rotation, own, 0);
}
// The change of speed at an arm, along n, by a push there.
PHYSICS_DEF float physics_give(const physics_thing *t, physics_vec arm, physics_vec n) {
  const physics_vec turn = physics_cross(arm, n);
  return physics_moves(t) ? t->inverse_mass + physics_dot(turn, physics_spun(t, turn)) : 0;
}
PHYSICS_DEF void physics_push(physics_thing *t, physics_vec arm, physics_vec push) {
  if (!physics_moves(t)) return;
  t->velocity = physics_plus(t->velocity, t->inverse_mass, push);
  t->spin = physics_plus(t->spin, 1, physics_spun(t, physics_cross(arm, push)));
}
PHYSICS_DEF physics_vec physics_speed(const physics_thing *t, physics_vec arm) {
  return physics_plus(t->velocity, 1, physics_cross(t->spin, arm));
}

// A touch as it is now.
typedef struct physics_seen {
  physics_thing *a, *b;
  physics_vec arm_a, arm_b, normal, way;  // the way goes from b's point to a's
} physics_seen;

PHYSICS_DEF physics_seen physics_see(const physics_world *w, const physics_touch *touch) {
  physics_seen s;
  s.a = &w->things[touch->a];
  s.b = &w->things[touch->b];
  s.arm_a = physics_turn(s.a->pose.rotation, touch->on_a, 0);
  s.arm_b = physics_turn(s.b->pose.rotation, touch->on_b, 0);
  s.normal = physics_turn(s.b->pose.rotation, touch->normal, 0);
  s.way = physics_minus(physics_plus(physics_from(s.a->pose.position), 1, s.arm_a),
                        physics_plus(physics_from(s.b->pose.position), 1, s.arm_b));
  return s;
}

// How far apart things rest.
PHYSICS_DEF float physics_rest(const physics_world *w) {
  return w->clearance + w->cushion;
}

// One touch: stops what approaches, or throws it back, and rubs.
PHYSICS_DEF void physics_respond(const physics_world *w, physics_touch *touch, float seconds) {
  const physics_seen s = physics_see(w, touch);
  const physics_vec n = s.normal;
  const float give = physics_give(s.a, s.arm_a, n) + physics_give(s.b, s.arm_b, n);
  if (!(give > 0)) return;
  const physics_vec speed = physics_minus(physics_speed(s.a, s.arm_a), physics_speed(s.b, s.arm_b));
  // it may come as near as things rest; what is nearer is to leave slowly
  const float left = physics_dot(s.way, n) - physics_rest(w);
  const float least = (left > 0 ? -left : -0.2f * left) / seconds + touch->bounce;
  const float before = touch->pushed;
  touch->pushed = fmaxf(before + (least - physics_dot(speed, n)) / give, 0);
  physics_vec push = physics_times(touch->pushed - before, n);
  const physics_vec slide = physics_plus(speed, -physics_dot(speed, n), n);
  const float slip = physics_length(slide);
  if (slip > 1e-6f) {
    const physics_vec u = physics_times(1 / slip, slide);
    const float across = physics_give(s.a, s.arm_a, u) + physics_give(s.b, s.arm_b, u);
    physics_vec rubbed = physics_plus(touch->rubbed, -slip / across, u);
    const float most = w->friction * touch->pushed;
    const float length = physics_length(rubbed);
    if (length > most) rubbed = physics_times(most / length, rubbed);
    push = physics_plus(push, 1, physics_minus(rubbed, touch->rubbed));
    touch->rubbed = rubbed;
  }
  physics_push(s.a, s.arm_a, push);
  physics_push(s.b, s.arm_b, physics_times(-1, push));
}

// Solves all touches, or those of one thing.
PHYSICS_DEF void physics_solve(physics_world *w, size_t only, float seconds) {
  for (int round = 0; round < PHYSICS_ITERATIONS; round++) {
    for (size_t k = 0; k < w->touch_count; k++) {
      physics_touch *touch = &w->touches[k];
      if (only == PHYSICS_NOTHING || touch->a == only || touch->b == only)
        physics_respond(w, touch, seconds);
    }
  }
}

// Forgets what no longer touches: touches are known from the frame in which things came near each
// other, and hold as long as these hardly move. What slept on something that left wakes up.
PHYSICS_DEF void physics_refresh(physics_world *w) {
  size_t left = 0;
  for (size_t i = 0; i < w->count; i++) w->things[i].touched = 0;
  for (size_t k = 0; k < w->touch_count; k++) {
    physics_touch *touch = &w->touches[k];
    const physics_seen s = physics_see(w, touch);
    const float apart = physics_dot(s.way, s.normal);
    const float aside = physics_length(physics_plus(s.way, -apart, s.normal));
    const float most = physics_rest(w) + 0.0015f;
    if (apart > most) {
      physics_wake(s.a);
      physics_wake(s.b);
    }
    if (apart > most || apart < 0 || aside > 0.008f) continue;
    s.a->touched = s.b->touched = 1;
    touch->bounce = touch->pushed = 0;
    touch->rubbed = physics_of(0, 0, 0);
    w->touches[left++] = *touch;
  }
  w->touch_count = left;
}

// A place where two things touch, in place of one that is near it, or else of one more.
PHYSICS_DEF physics_touch *physics_place(physics_world *w, const physics_touch *touch) {
  const float same = 0.1f * fminf(w->things[touch->a].reach, w->things[touch->b].reach);
  for (size_t k = 0; k < w->touch_count; k++) {
    physics_touch *t = &w->touches[k];
    if (t->a == touch->a && t->b == touch->b &&
        physics_length(physics_minus(t->on_a, touch->on_a)) < same)
      return t;
    if (t->a == touch->b && t->b == touch->a &&
        physics_length(physics_minus(t->on_b, touch->on_a)) < same)
      return t;
  }
  if (w->touch_count == PHYSICS_TOUCHES * w->most) return NULL;
  memset(&w->touches[w->touch_count], 0, sizeof *touch);
  return &w->touches[w->touch_count++];
}

// Takes what an answer tells of a contact for the touches of two things. What touched before and is
// not told of still holds: an answer is about what comes first.
PHYSICS_DEF void physics_touch_of(physics_world *w, size_t i, size_t other,
                                  const nsvcd_answer *answer) {
  physics_thing *a = &w->things[i];
  physics_thing *b = &w->things[other];
  const nsvcd_contact *contacts = answer->contact_count ? answer->contacts : &answer->nearest;
  const size_t count = answer->contact_count ? answer->contact_count : 1;
  for (size_t k = 0; k < count; k++) {
    const physics_vec n = physics_from(contacts[k].normal);
    const physics_vec on_b = physics_from(contacts[k].point);
    const physics_vec on_a = physics_plus(on_b, contacts[k].gap, n);
    const physics_vec arm_a = physics_minus(on_a, physics_from(a->pose.position));
    const physics_vec arm_b = physics_minus(on_b, physics_from(b->pose.position));
    const physics_vec speed = physics_minus(physics_speed(a, arm_a), physics_speed(b, arm_b));
    const float into = -physics_dot(speed, n);
    physics_touch touch;
    if (!(physics_length(n) > 0.5f)) continue;
    memset(&touch, 0, sizeof touch);
    touch.a = i;
    touch.b = other;
    touch.on_a = physics_turn(a->pose.rotation, arm_a, 1);
    touch.on_b = physics_turn(b->pose.rotation, arm_b, 1);
    touch.normal = physics_turn(b->pose.rotation, n, 1);
    touch.bounce = into > 0.5f ? w->restitution * into : 0;
    physics_touch *place = physics_place(w, &touch);
    if (place) {
      touch.carried = place->carried;
      *place = touch;
    }
    if (into > 0.2f && b->asleep) physics_wake(b);
  }
  a->touched = b->touched = 1;
  w->counts.contacts++;
}

// ------------------------------------------------------------------------------------------ moving

// Where a thing is after some time.
PHYSICS_DEF nsvcd_pose physics_aim(const physics_thing *t, float seconds) {
  nsvcd_pose out = t->pose;
  const float angle = physics_length(t->spin) * seconds;
  const float s = angle > 1e-9f ? sinf(angle / 2) * seconds / angle : 0;
  const float c = cosf(angle / 2);
  const physics_vec u = physics_times(s, t->spin);
  const physics_vec v = physics_from(t->pose.rotation);
  const float q = t->pose.rotation[3];
  const physics_vec turned =
      physics_plus(physics_plus(physics_times(c, v), q, u), 1, physics_cross(u, v));
  const float w = c * q - physics_dot(u, v);
  const float length = sqrtf(physics_dot(turned, turned) + w * w);
  out.rotation[0] = turned.x / length;
  out.rotation[1] = turned.y / length;
  out.rotation[2] = turned.z / length;
  out.rotation[3] = w / length;
  out.position[0] += seconds * t->velocity.x;
  out.position[1] += seconds * t->velocity.y;
  out.position[2] += seconds * t->velocity.z;
  return out;
}

// The share of the way that all answers leave free, and who ends it.
PHYSICS_DEF float physics_share(const physics_world *w, size_t *by) {
  float fraction = 1;
  *by = PHYSICS_NOTHING;
  for (size_t k = 0; k < w->near_count; k++) {
    const nsvcd_answer *answer = &w->answers[k];
    if (answer->verdict == NSVCD_FREE || (*by != PHYSICS_NOTHING && answer->safe.time >= fraction))
      continue;
    fraction = answer->safe.time;
    *by = k;
  }
  return fraction;
}

// Notes as touches what stopped a thing, or was about to.
PHYSICS_DEF void physics_meet(physics_world *w, size_t i, float fraction) {
  physics_thing *t = &w->things[i];
  int is_pressed = 0;
  for (size_t k = 0; k < w->near_count; k++) {
    const nsvcd_answer *answer = &w->answers[k];
    w->counts.undecided += answer->verdict == NSVCD_UNDECIDED;
    if (answer->verdict != NSVCD_FREE && answer->safe.time <= fraction + 0.02f)
      physics_touch_of(w, i, w->near_things[k], answer);
    is_pressed |=
        !(answer->time.low > 0) && (!(answer->time.high > 0) || answer->verdict == NSVCD_UNDECIDED);
  }
  if (is_pressed) w->counts.pressed++;
  t->pressed = is_pressed ? (t->pressed < 20 ? t->pressed + 1 : 20) : t->pressed - (t->pressed > 0);
}

// Takes a thing towards a pose as far as that is proven free. Returns the share of the way that it
// went, and the normal of what it met there: 0 if nothing was met.
PHYSICS_DEF float physics_go(physics_world *w, size_t i, const nsvcd_pose *to,
                             physics_vec *normal) {
  size_t by;
  *normal = physics_of(0, 0, 0);
  if (!physics_look(w, i, to)) return 0;
  const float fraction = physics_share(w, &by);
  w->things[i].pose = by == PHYSICS_NOTHING ? *to : w->answers[by].safe.a;
  if (by != PHYSICS_NOTHING) *normal = physics_from(w->answers[by].nearest.normal);
  physics_meet(w, i, fraction);
  return fraction;
}

// A way off all that a thing touches nearer than things rest.
PHYSICS_DEF nsvcd_pose physics_off(const physics_world *w, size_t i) {
  nsvcd_pose to = w->things[i].pose;
  physics_vec off = {0, 0, 0};
  for (int round = 0; round < 3; round++) {
    for (size_t k = 0; k < w->touch_count; k++) {
      const physics_touch *touch = &w->touches[k];
      if (touch->a != i && touch->b != i) continue;
      const physics_seen s = physics_see(w, touch);
      const physics_vec n = physics_times(touch->a == i ? 1.0f : -1.0f, s.normal);
      const float lacks = physics_rest(w) - physics_dot(s.way, s.normal) - physics_dot(off, n);
      if (lacks > 0) off = physics_plus(off, lacks, n);
    }
  }
  const float length = physics_length(off);
  off = physics_times(length > w->cushion ? w->cushion / length : 1, off);
  to.position[0] += off.x;
  to.position[1] += off.y;
  to.position[2] += off.z;
  return to;
}

// A frame of one thing: goes, bounces, goes on. What was stopped where it was goes off that first.
// Time that is left then is lost, and so is the speed that it could not make use of.
PHYSICS_DEF void physics_move(physics_world *w, size_t i, float seconds) {
  physics_thing *t = &w->things[i];
  physics_vec normal;
  float left = seconds;
  const int rounds = physics_quickness(t) > PHYSICS_SLOW ? PHYSICS_ROUNDS : 1;
  for (int round = 0; round < rounds && left > 0.02f * seconds; round++) {
    const float turn = physics_length(t->spin) * left;
    if (physics_quickness(t) * left < PHYSICS_STILL) {
      t->velocity = t->spin = physics_of(0, 0, 0);
      return;
    }
    if (turn > 2.5f) t->spin = physics_times(2.5f / turn, t->spin);
    nsvcd_pose to = physics_aim(t, left);
    const float fraction = physics_go(w, i, &to, &normal);
    left *= 1 - fraction;
    if (fraction >= 1) return;
    physics_solve(w, i, seconds);
    if (fraction > 0.01f) continue;
    to = physics_off(w, i);
    physics_go(w, i, &to, &normal);
  }
  t->velocity = physics_times(1 - left / seconds, t->velocity);
  t->spin = physics_times(1 - left / seconds, t->spin);
}

// Puts to sleep what has been slow for a while, if what it touches is slow as well.
PHYSICS_DEF void physics_calm(physics_world *w) {
  for (size_t i = 0; i < w->count; i++) {
    physics_thing *t = &w->things[i];
    if (!physics_moves(t)) continue;
    t->calm = t->touched && physics_quickness(t) < PHYSICS_QUIET ? t->calm + 1 : 0;
  }
  for (size_t k = 0; k < w->touch_count; k++) {
    physics_thing *a = &w->things[w->touches[k].a];
    physics_thing *b = &w->things[w->touches[k].b];
    const int least = PHYSICS_CALM / 2;
    if (physics_moves(a) && a->calm < least && b->calm > least && !b->asleep) b->calm = least;
    if (physics_moves(b) && b->calm < least && a->calm > least && !a->asleep) a->calm = least;
  }
  for (size_t i = 0; i < w->count; i++) {
    physics_thing *t = &w->things[i];
    if (!physics_moves(t) || t->calm < PHYSICS_CALM) continue;
    t->asleep = 1;
    t->velocity = t->spin = physics_of(0, 0, 0);
  }
}

// The lowest first: what is to fall on something finds it where it will be.
PHYSICS_DEF void physics_sort(physics_world *w) {
  for (size_t n = 1; n < w->count; n++) {
    const size_t i = w->order[n];
    const float height = w->things[i].pose.position[2];
    size_t k = n;
    for (; k > 0 && w->things[w->order[k - 1]].pose.position[2] > height; k--)
      w->order[k] = w->order[k - 1];
    w->order[k] = i;
  }
}

// One frame. What was refused, if a question was: then no thing has moved on.
PHYSICS_DEF nsvcd_result physics_step(physics_world *w, float seconds) {
  physics_refresh(w);
  for (size_t i = 0; i < w->count; i++) {
    physics_thing *t = &w->things[i];
    if (!physics_moves(t)) continue;
    t->velocity = physics_plus(t->velocity, seconds, w->gravity);
    if (!t->touched) continue;
    const int slow = physics_quickness(t) < PHYSICS_SLOW;
    t->velocity = physics_times(slow ? 0.85f : 0.995f, t->velocity);
    t->spin = physics_times(slow ? 0.85f : 0.98f, t->spin);
  }
  for (size_t k = 0; k < w->touch_count; k++) {  // what carried things carries them again
    physics_touch *touch = &w->touches[k];
    const physics_seen seen = physics_see(w, touch);
    touch->pushed = 0.9f * touch->carried;
    physics_push(seen.a, seen.arm_a, physics_times(touch->pushed, seen.normal));
    physics_push(seen.b, seen.arm_b, physics_times(-touch->pushed, seen.normal));
  }
  physics_solve(w, PHYSICS_NOTHING, seconds);
  for (size_t k = 0; k < w->touch_count; k++) w->touches[k].carried = w->touches[k].pushed;
  physics_sort(w);
  for (size_t n = 0; n < w->count && !w->result; n++) {
    if (physics_moves(&w->things[w->order[n]])) physics_move(w, w->order[n], seconds);
  }
  physics_calm(w);
  return w->result;
}

#endif
