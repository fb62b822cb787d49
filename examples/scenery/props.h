// props.h - what a game adds to nsvcd_world_slide, for the examples: things of any mesh that fall,
// bounce, pile up, push each other and sleep. Include neuralsvcd.h and extras/neuralsvcd_world.h
// first. No part of the library.
//
// That no two overlap is the library's: things slide one after the other, the lowest first. Here is
// the rest of a frame: gravity, brakes, who gets the impulse of a hit, and who sleeps.
//
//   props_world *w = props_new(100);
//   props_add(w, &level, LEVEL, 1, 0, &pose);               // weighs nothing: it never moves
//   size_t id = props_add(w, &crate, CRATE, 1, 20, &pose);  // NSVCD_NOBODY: something is there
//   w->things[id].velocity.linear[0] = 3;                   // at any time
//   props_step(w, 1.0f / 60);
//
// Metres, kilograms, seconds; up is z. Nothing here is global, prints, or knows of a clock.
#ifndef NSVCD_SCENERY_PROPS_H
#define NSVCD_SCENERY_PROPS_H

#include "shapes.h"

#define PROPS_GRAVITY 9.81f
#define PROPS_HIT 0.3f     // metres a second: what comes slower rests, or slides, on what it meets
#define PROPS_SLOW 0.4f    // what touches, and is slower, is braked,
#define PROPS_QUIET 0.15f  // and what is so slow
#define PROPS_CALM 6       // for so many frames sleeps
#define PROPS_WORK 2000    // units a question: what takes more is stopped early

// Meshes are about their centres of mass: props_encode sees to that.
typedef struct props_shape {
  const nsvcd_body *body;
  float half[3];  // half the lengths of its box, for inertia
} props_shape;

// A thing: first what throw.js reads.
typedef struct props_thing {
  int kind;  // the caller's; -1: there is nothing
  int asleep;
  nsvcd_pose pose;
  float scale;
  // 0: it never moves. A character's, which has none in `slide`, is what it pushes with
  float mass;
  float reach;  // metres: no point is farther from its centre
  int calm;     // for so many frames it has been slow
  nsvcd_velocity velocity;
  nsvcd_slide_options slide;
  nsvcd_slide_answer answer;
} props_thing;

typedef struct props_world {
  nsvcd_world *world;
  props_thing *things;  // (most + 1), by the ids that they have in the world
  size_t *order;        // (count) ids, the lowest first
  size_t count, most;   // things that are there
  size_t counts[2];     // questions, and contacts
  float gap;  // metres: what things never come nearer to each other than; zero, as the library's
  void *workspace;
  size_t workspace_size;
} props_world;

// Room for so many things, given back by free(). NULL without memory.
SHAPES_DEF props_world *props_new(size_t most) {
  const size_t size = nsvcd_world_size(most);
  const size_t workspace = (nsvcd_sweep_workspace_size(NULL) + 63) / 64 * 64;
  const size_t each = sizeof(props_thing) + sizeof(size_t);
  props_world *w =
      (props_world *)calloc(1, sizeof *w + 64 + workspace + size + (most + 1) * each + 64);
  if (!w) return NULL;
  w->workspace = (void *)(((uintptr_t)(w + 1) + 63) / 64 * 64);
  w->workspace_size = workspace;
  char *memory = (char *)w->workspace + workspace;
  w->things = (props_thing *)(void *)(memory + (size + 63) / 64 * 64);
  w->order = (size_t *)(void *)(w->things + most + 1);
  w->most = most;
  for (size_t id = 0; id <= most; id++) w->things[id].kind = -1;
  if (nsvcd_world_begin(memory, size, most, &w->world) == NSVCD_OK) return w;
  free(w);
  return NULL;
}

// Encodes a mesh; moves it to its centre of mass before that, if told to.
SHAPES_DEF nsvcd_result props_encode(shapes_mesh *mesh, const nsvcd_encode_options *options,
                                     int centred, props_shape *shape) {
  double volume = 0;
  double centre[3] = {0, 0, 0};
  for (size_t i = 0; i < mesh->triangles && centred; i++) {
    const double *a = mesh->positions + 3 * mesh->indices[3 * i];
    const double *b = mesh->positions + 3 * mesh->indices[3 * i + 1];
    const double *c = mesh->positions + 3 * mesh->indices[3 * i + 2];
    const double six = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
    volume += six;
    for (int k = 0; k < 3; k++) centre[k] += six * (a[k] + b[k] + c[k]) / 4;
  }
  float *narrow = (float *)malloc((3 * mesh->vertices + 1) * sizeof *narrow);
  memset(shape, 0, sizeof *shape);
  if (!narrow || mesh->failed) return free(narrow), NSVCD_ERROR_MEMORY;
  for (size_t i = 0; i < 3 * mesh->vertices; i++) {
    if (volume > 0) mesh->positions[i] -= centre[i % 3] / volume;
    narrow[i] = (float)mesh->positions[i];
    shape->half[i % 3] = fmaxf(shape->half[i % 3], fabsf(narrow[i]));
  }
  nsvcd_mesh given;
  memset(&given, 0, sizeof given);
  given.positions = narrow;
  given.indices = mesh->indices;
  given.vertex_count = mesh->vertices;
  given.triangle_count = mesh->triangles;
  const nsvcd_result result = nsvcd_encode(&given, options, NULL, NULL, 0, &shape->body);
  free(narrow);
  return result;
}

// Puts a thing there, if nothing is: its id, or NSVCD_NOBODY.
SHAPES_DEF size_t props_add(props_world *w, const props_shape *shape, int kind, float scale,
                            float mass, const nsvcd_pose *pose) {
  nsvcd_world_body given;
  nsvcd_world_question question;
  nsvcd_world_answer answer;
  size_t id = NSVCD_NOBODY;
  memset(&given, 0, sizeof given);
  memset(&question, 0, sizeof question);
  given.body = shape->body;
  given.pose = *pose;
  given.scale = scale;
  given.fixed = !(mass > 0);
  if (nsvcd_world_add(w->world, &given, &id)) return NSVCD_NOBODY;
  question.self = id;
  question.question.clearance = w->gap;
  if (!given.fixed &&
      (nsvcd_world_sweep(w->world, &question, w->workspace, w->workspace_size, &answer) ||
       answer.verdict != NSVCD_FREE)) {
    nsvcd_world_remove(w->world, id);
    return NSVCD_NOBODY;
  }
  props_thing *t = &w->things[id];
  memset(t, 0, sizeof *t);
  t->kind = kind;
  t->pose = *pose;
  t->scale = scale;
  t->mass = mass;
  float squares[3], sum = 0;
  for (int k = 0; k < 3; k++) sum += squares[k] = scale * scale * shape->half[k] * shape->half[k];
  t->reach = sqrtf(sum);
  t->slide.mass = mass;
  t->slide.friction = 0.5f;
  t->slide.restitution = 0.3f;
  t->slide.clearance = w->gap;
  t->slide.margin = 0.5f * w->gap;
  t->slide.work = PROPS_WORK;
  // the inertia of a box, no thinner than a tenth of its reach: slivers spin too wildly
  for (int k = 0; k < 3; k++) t->slide.inertia[k] = mass / 3 * (1.01f * sum - squares[k]);
  w->order[w->count++] = id;
  return id;
}

// Makes a thing a character: it goes where it wants to, stays upright, climbs steps of that height,
// and pushes with its mass what is in its way. Its velocity along x and y is the caller's.
SHAPES_DEF void props_make_walker(props_thing *t, float step) {
  memset(&t->slide, 0, sizeof t->slide);
  t->slide.up[2] = 1;
  t->slide.step = step;
}

SHAPES_DEF void props_wake(props_thing *t) {
  t->asleep = t->calm = 0;
}

// Does it touch what has this id?
SHAPES_DEF int props_touches(const props_thing *t, size_t id) {
  for (size_t k = 0; k < t->answer.contact_count; k++)
    if (t->answer.contacts[k].body == id) return 1;
  return 0;
}

SHAPES_DEF void props_remove(props_world *w, size_t id) {
  size_t left = 0;
  if (nsvcd_world_remove(w->world, id)) return;
  w->things[id].kind = -1;
  for (size_t n = 0; n < w->count; n++) {
    if (props_touches(&w->things[w->order[n]], id)) props_wake(&w->things[w->order[n]]);
    if (w->order[n] != id) w->order[left++] = w->order[n];
  }
  w->count = left;
}

SHAPES_DEF int props_walks(const props_thing *t) {
  return !(t->slide.mass > 0);
}

SHAPES_DEF void props_cross(const float *a, const float *b, float *out) {
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    out[k] = a[i] * b[j] - a[j] * b[i];
  }
}
SHAPES_DEF float props_dot(const float *a, const float *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
// Metres a second that no point of it exceeds.
SHAPES_DEF float props_speed(const props_thing *t) {
  const float *spin = t->velocity.angular;
  const float *v = t->velocity.linear;
  return sqrtf(props_dot(v, v)) + t->reach * sqrtf(props_dot(spin, spin));
}
// Turns a vector as a thing is turned; way: 1, or -1 for back.
SHAPES_DEF void props_turn(const props_thing *t, float way, float *v) {
  const float *q = t->pose.rotation;
  float once[3], twice[3];
  props_cross(q, v, once);
  for (int k = 0; k < 3; k++) once[k] = way * once[k] + q[3] * v[k];
  props_cross(q, once, twice);
  for (int k = 0; k < 3; k++) v[k] += 2 * way * twice[k];
}

// A point of the world at which two things push each other: what an impulse of 1 does to one there.
typedef struct props_place {
  const float *along;
  float arm[3], spin[3];  // from its centre; how much faster it turns
  float give;             // how much faster the point goes
} props_place;

SHAPES_DEF props_place props_place_of(const props_thing *t, const nsvcd_contact *contact) {
  props_place out;
  float there[3];
  out.along = contact->normal;
  for (int k = 0; k < 3; k++) out.arm[k] = contact->point[k] - t->pose.position[k];
  props_cross(out.arm, out.along, out.spin);
  props_turn(t, -1, out.spin);
  for (int k = 0; k < 3; k++)
    out.spin[k] = t->slide.inertia[k] > 0 ? out.spin[k] / t->slide.inertia[k] : 0;
  props_turn(t, 1, out.spin);
  props_cross(out.spin, out.arm, there);
  out.give = 1 / t->mass + props_dot(there, out.along);
  return out;
}
SHAPES_DEF float props_speed_at(const nsvcd_velocity *v, const props_place *at) {
  float there[3];
  props_cross(v->angular, at->arm, there);
  return props_dot(v->linear, at->along) + props_dot(there, at->along);
}
SHAPES_DEF void props_push(nsvcd_velocity *v, float mass, const props_place *at, float impulse) {
  for (int k = 0; k < 3; k++) {
    v->linear[k] += impulse * at->along[k] / mass;
    v->angular[k] += impulse * at->spin[k];
  }
}

// A slide's impulses are those of a thing that meets what rests. What was hit gets its share of
// them, as two that meet alone do, and the thing goes after it. came: its velocity before.
SHAPES_DEF void props_hand_on(props_world *w, props_thing *t, nsvcd_velocity came) {
  for (size_t k = 0; k < t->answer.contact_count; k++) {
    const nsvcd_world_contact *c = &t->answer.contacts[k];
    props_thing *hit = &w->things[c->body];
    if (props_walks(hit) || !(c->impulse > 0)) continue;
    const float impulse = c->impulse * (props_walks(t) ? t->mass : 1);
    const props_place own = props_place_of(t, &c->contact);
    const props_place other = props_place_of(hit, &c->contact);
    const float into = props_speed_at(&hit->velocity, &other) - props_speed_at(&came, &own);
    if (!(into > PROPS_HIT)) continue;
    const float bounce = t->slide.restitution * into;
    const float handed = fminf(impulse * own.give, into + bounce) / (own.give + other.give);
    props_push(&hit->velocity, hit->mass, &other, -handed);
    props_push(&came, t->mass, &own, handed);
    props_wake(hit);
    if (props_walks(t)) continue;
    const float apart = props_speed_at(&t->velocity, &own) - props_speed_at(&hit->velocity, &other);
    const float back = fminf(impulse - handed, (apart - bounce) / own.give);
    if (back > 0) props_push(&t->velocity, t->mass, &own, -back);
  }
}

// Puts to sleep what has been slow for a while, and wakes what lies on what moves.
SHAPES_DEF void props_calm(props_world *w) {
  for (size_t n = 0; n < w->count; n++) {
    props_thing *t = &w->things[w->order[n]];
    if (props_walks(t)) continue;
    for (size_t k = 0; k < t->answer.contact_count && t->asleep; k++) {
      const props_thing *other = &w->things[t->answer.contacts[k].body];
      if (props_speed(other) > PROPS_QUIET && !props_walks(other)) props_wake(t);
    }
    t->calm = t->answer.contact_count && props_speed(t) < PROPS_QUIET ? t->calm + 1 : 0;
    t->asleep = t->calm >= PROPS_CALM;
    if (t->asleep) memset(&t->velocity, 0, sizeof t->velocity);
  }
}

// The lowest first: what is to fall on something finds it where it will be.
SHAPES_DEF void props_sort(props_world *w) {
  for (size_t n = 1; n < w->count; n++) {
    const size_t id = w->order[n];
    const float height = w->things[id].pose.position[2];
    size_t k = n;
    for (; k > 0 && w->things[w->order[k - 1]].pose.position[2] > height; k--)
      w->order[k] = w->order[k - 1];
    w->order[k] = id;
  }
}

// One frame. What was refused, if a question was: then the frame ended there.
SHAPES_DEF nsvcd_result props_step(props_world *w, float seconds) {
  props_sort(w);
  for (size_t n = 0; n < w->count; n++) {
    props_thing *t = &w->things[w->order[n]];
    if (t->asleep || !(t->mass > 0)) continue;
    const int touched = t->answer.contact_count > 0 && !props_walks(t);
    const float brake = touched && props_speed(t) < PROPS_SLOW ? 0.85f : 1;
    t->velocity.linear[2] -= seconds * PROPS_GRAVITY;
    for (int k = 0; k < 3; k++) {
      t->velocity.linear[k] *= touched ? fminf(brake, 0.995f) : 1;
      t->velocity.angular[k] *= touched ? fminf(brake, 0.98f) : 1;
    }
    const nsvcd_velocity before = t->velocity;
    const nsvcd_result result =
        nsvcd_world_slide(w->world, w->order[n], &t->slide, seconds, w->workspace,
                          w->workspace_size, &t->velocity, &t->answer);
    if (result) return result;
    t->pose = t->answer.pose;
    w->counts[0] += t->answer.questions;
    w->counts[1] += t->answer.contact_count;
    props_hand_on(w, t, before);
  }
  props_calm(w);
  return NSVCD_OK;
}

#endif
