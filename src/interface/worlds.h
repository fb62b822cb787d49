// In: bodies at their places. Out: one answer about one of them and all that is near it, and moves
// after which nothing overlaps.
//
// THE LAW OF A FRAME
//   Bodies move one after the other, in the caller's order, each over the whole frame, and each
// move is proven against all others where they are at that moment. So no move ends in an overlap,
// whatever the order, if there was none before. There is no time of impact for the world as a
// whole: a contact somewhere in a pile does not cut the frame short for the others.
//   A driven body (nsvcd_world_drive: a lift, a door, a turntable) is the exception: it moves while
// the others do, over the same frame, and stops for nobody. Others ride on it and get out of its
// way. One that cannot is reported as caught: it is free of the driven body for as much of the
// frame as it has `spent`, and may overlap it from then on.
#pragma once
#include "queries.h"

// no body: ids begin at 1
#define NSVCD_NOBODY 0
// the most contacts of an answer about a world
#define NSVCD_WORLD_CONTACTS 32

// Bodies in a tree of boxes. It lives in the caller's memory, and stays there. Its bytes, copied
// and put back into their place, are the world as it was: with its movers, a saved state.
typedef struct nsvcd_world nsvcd_world;

// A body of a world. Zero is the default of everything but `body` and the rotation of `pose`.
typedef struct nsvcd_world_body {
  // with triangles; kept, not copied
  const nsvcd_body *body;
  // where it is
  nsvcd_pose pose;
  // as in nsvcd_mover. For a body that moves freely the pivot has to be its centre of mass
  float scale;
  float pivot[3];
  // bits: the groups that it belongs to, default the first; and the groups that it passes through.
  // Two bodies meet unless either passes through a group that the other belongs to
  uint32_t groups, passes;
  // 1: like a level, it moves only if moved or driven. Pairs of two such bodies are not listed
  int fixed;
  // 1: it stops nothing. nsvcd_world_list with it as `self` tells what is in it
  int sensor;
} nsvcd_world_body;

// A contact with a body of the world.
typedef struct nsvcd_world_contact {
  // which body; `a` of the contact is the mover, and `b` this body
  size_t body;
  nsvcd_contact contact;
  // newton seconds, along the normal: what the mover lost of its momentum there, in a slide; metres
  // a second, of its speed, if it has no mass
  float impulse;
} nsvcd_world_contact;

// A question about a mover and all bodies of a world.
typedef struct nsvcd_world_question {
  // its b stays empty. If its a has no body, it is that of `self`; no poses, it is where `self` is
  nsvcd_question question;
  // the body of the world that moves, which does not meet itself, and whose groups count; or nobody
  size_t self;
  // of a mover that is nobody in the world
  uint32_t groups, passes;
} nsvcd_world_question;

// What is known of a mover and all that it comes near. Numbers are as those of nsvcd_answer.
typedef struct nsvcd_world_answer {
  // HIT: it hits some body. UNDECIDED: it is known to hit none, but not to be free of all. FREE: it
  // is free of all
  nsvcd_verdict verdict;
  nsvcd_why why;
  // the body that is hit first (asked HIT: one that is hit), or else is undecided first
  size_t body;
  // it is free of all bodies before `low`, and in contact with one at `high`
  nsvcd_range time;
  // FIRST: where the mover may go. This pose, as it is in floats, and the way to it are proven to
  // be free of all bodies. It is the start if that is not free
  float safe_time;
  nsvcd_pose safe;
  // with a slop: by how much, and along what, it was pushed out of what it touched at the start
  float depth, push_out[3];
  // FIRST: contacts of all that touch at the safe pose, one with each body, or all with `manifold`
  size_t contact_count;
  nsvcd_world_contact contacts[NSVCD_WORLD_CONTACTS];
  // questions about two bodies, and units that their proofs took
  size_t questions, work;
} nsvcd_world_answer;

// Bytes of a world of at most so many bodies, up to 2^31 - 2; 0 if there can be none.
NSVCDDEF size_t nsvcd_world_size(size_t most);

// Makes a world without bodies.
//   memory     (size) bytes, nsvcd_world_size(most) or more, not NULL, aligned to NSVCD_ALIGNMENT
//   world      not NULL; set to the world, or left as it was on failure
//   errors     ARGUMENT, COUNT (`most`), WORKSPACE
NSVCDDEF nsvcd_result nsvcd_world_begin(void *memory, size_t size, size_t most,
                                        nsvcd_world **world);

// Adds a body, moves it elsewhere, takes it out, or tells of it. Nothing is checked for overlap:
// bodies that are put into each other are hit at time 0 when they are asked about.
//   body, pose  not NULL
//   id          of add: not NULL; set to the body's id, from 1 on, or left as it was on failure.
//               Ids of removed bodies are used again
//   threads     one at a time, and none may ask meanwhile. NSVCD_ERROR_WORLD if that is noticed
//   errors      ARGUMENT, BODY, VERSION, TRIANGLES, POSE, QUATERNION, SCALE, PIVOT, COUNT (there
//               is no room for more bodies), INDEX (`id` is no body's), WORLD
NSVCDDEF nsvcd_result nsvcd_world_add(nsvcd_world *world, const nsvcd_world_body *body,
                                      size_t *id);
NSVCDDEF nsvcd_result nsvcd_world_move(nsvcd_world *world, size_t id, const nsvcd_pose *pose);
NSVCDDEF nsvcd_result nsvcd_world_remove(nsvcd_world *world, size_t id);
NSVCDDEF nsvcd_result nsvcd_world_get(const nsvcd_world *world, size_t id,
                                      nsvcd_world_body *body);

// Drives a body in this frame, from where it is to a pose: by a line and a slerp, about its pivot.
// nsvcd_world_arrive ends the frame: all driven bodies are put at their ends, and rest.
//   threads     as nsvcd_world_move
//   errors      ARGUMENT, POSE, QUATERNION, INDEX, WORLD
NSVCDDEF nsvcd_result nsvcd_world_drive(nsvcd_world *world, size_t id, const nsvcd_pose *to);
NSVCDDEF nsvcd_result nsvcd_world_arrive(nsvcd_world *world);

// Answers a question about a mover and all that it comes near, driven bodies as they move. Sensors
// are left out. HIT stops at any body that is hit, which need not be the first on the way.
//   With a slop, a mover that touches several bodies at the start is pushed out of all of them at
// once, by nearly the shortest vector that goes far enough along the push-out of each.
//   workspace  (workspace_size) bytes, nsvcd_sweep_workspace_size(NULL), not NULL, aligned
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    any number may ask while none changes the world; each needs a workspace of its own
//   errors     those of nsvcd_sweep; METHOD (the network is asked), INDEX (`self`), ARGUMENT (b is
//              not empty), WORLD
NSVCDDEF nsvcd_result nsvcd_world_sweep(const nsvcd_world *world,
                                        const nsvcd_world_question *question, void *workspace,
                                        size_t workspace_size, nsvcd_world_answer *answer);

// Lists all bodies that a mover meets on its way, sensors too: those that it passes over, shoots
// through or stands in. What is undecided counts as met. A sensor as `self`, which rests, sees who
// is in it now: ask about what is fast with its way of the frame.
//   question   its question asks HIT
//   ids        (most); in ascending order
//   count      not NULL; how many are met, which may be more than `most`
//   errors     those of nsvcd_world_sweep, ASK
NSVCDDEF nsvcd_result nsvcd_world_list(const nsvcd_world *world,
                                       const nsvcd_world_question *question, void *workspace,
                                       size_t workspace_size, size_t *ids, size_t most,
                                       size_t *count);

// Lists the pairs of bodies whose boxes come within a distance; of a driven one that is the box of
// its way in this frame.
//   pairs      (most)
//   count      not NULL; how many there are, which may be more than `most`
//   errors     ARGUMENT, DISTANCE (`distance`), WORLD
NSVCDDEF nsvcd_result nsvcd_world_pairs(const nsvcd_world *world, float distance,
                                        nsvcd_body_pair *pairs, size_t most, size_t *count);

// units of work of a slide's questions
#define NSVCD_DEFAULT_SLIDE_WORK 10000

// How a body slides. Zero means the default.
typedef struct nsvcd_slide_options {
  // metres: it never comes nearer to anything than the clearance, by default a two-hundredth of its
  // reach from its pivot. It comes to rest farther by up to the margin, by default the clearance
  float clearance, margin;
  // kilograms, and (3) kg m^2, about the axes of its frame through its pivot. Without an inertia
  // contacts do not turn it; without a mass it is a character, whose impulses are speeds
  float mass, inertia[3];
  // coefficients, whatever it meets. It bounces off what it hits faster than 0.5 metres a second
  float friction, restitution;
  // unit, of a character; (0, 0, 0): none. With it, it rides on what it stands on, and keeps no
  // speed upwards from walking up something: one that it is given is a jump
  float up[3];
  // metres: the highest step that it climbs, from what it stands on or else from its lowest point,
  // and walks down without a fall; and the least cosine between up and the normal of a ground that
  // it stands on, default 0.7. An edge that bears round feet at such a normal is no step
  float step, slope;
  // ways that it goes in a frame, from contact to contact, at most; default 4. Where it meets a
  // driven body, four times as many
  size_t rounds;
  // units of each question, as question.work; default NSVCD_DEFAULT_SLIDE_WORK. What takes more is
  // stopped before it is decided
  size_t work;
} nsvcd_slide_options;

// A body's speed: metres a second of its pivot, and radians a second, in the world.
typedef struct nsvcd_velocity {
  float linear[3], angular[3];
} nsvcd_velocity;

// What became of a body in a frame. Hand it to the body's next slide: if the body rested, is told
// the same again, and nothing near it has moved, it rests without a question.
typedef struct nsvcd_slide_answer {
  // where the body is
  nsvcd_pose pose;
  // the part of the frame that it could use, up to 1. Its speed is less by the same factor
  float spent;
  // 1: it rests: it did not move at all, and its speed is 0
  int rests;
  // the body that it stands on, and the ground's normal, steep on the edge of a step; or nobody
  size_t ground;
  float ground_normal[3];
  // the driven body that it could not get out of the way of; or nobody
  size_t caught;
  // first those that took impulses on its way, then all within the margin at the end, some again
  size_t contact_count;
  nsvcd_world_contact contacts[NSVCD_WORLD_CONTACTS];
  size_t questions, work;
  // what it was told, and when: for the library only
  nsvcd_slide_options told;
  nsvcd_velocity given;
  float seconds;
  uint64_t clock, slides;
} nsvcd_slide_answer;

// Moves a body of the world for a frame, at its speed: it goes as far as is proven free, loses the
// speed that points into what it meets, and goes on with what is left of the frame. Gravity is the
// caller's to add before.
//   world      the body is moved in it; if it was driven, that ends it
//   velocity   not NULL; becomes the speed at the end
//   seconds    of the frame
//   answer     not NULL; zeroed, or that of the same body's slide before in this world, which saves
//              time. On failure it, the velocity and the body are as they were
//   errors     those of nsvcd_world_sweep; SPEED, TIMES (`seconds`), CLEARANCE (clearance, margin),
//              VALUE (a mass, an inertia, a friction, a restitution or a slope), AXIS (`up`),
//              DISTANCE (`step`)
//   source     sequential impulses (Catto 2006) for the contacts of one body; this library
//
// What is proven: where the body is at the end, it is farther than the clearance from every other
// body, and was so on its way there. If something had come nearer to it than that, or is in it by
// no more than that, it is pushed out, if there is room, by at most four clearances and three
// margins, and meets nothing else on that way. What is deeper in something stays where it is: its
// `spent` is 0. To get it out ask nsvcd_world_sweep, FIRST, with a slop, and move it to `safe`.
// What a contact does to its speed is not proven, it is physics: the others are taken to rest, or
// to be driven. To move what is hit, give it the impulse, as nsvcd_world_step does. What spins
// keeps its spin, as a ball does: there is no gyroscopic moment.
NSVCDDEF nsvcd_result nsvcd_world_slide(nsvcd_world *world, size_t id,
                                        const nsvcd_slide_options *options, float seconds,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_velocity *velocity, nsvcd_slide_answer *answer);

// A body that a step moves. Zero is the default of everything but `id`.
typedef struct nsvcd_world_mover {
  size_t id;
  // how it slides
  nsvcd_slide_options how;
  // yours to change between two steps. A sleeper that is given a speed wakes
  nsvcd_velocity velocity;
  // kilograms with which a character, which has no mass in `how`, pushes others; 0: it does not
  float push_mass;
  // a second: the rates at which it loses speed, and spin, wherever it is
  float damping, spin_damping;
  // 1: it sleeps: it stays where it is, and costs next to nothing. Yours to read, set and clear
  int asleep;
  // 1: it never falls asleep, as characters never do
  int sleepless;
  // seconds for which it has been quiet: for the library only
  float calm;
  // of its last slide
  nsvcd_slide_answer answer;
} nsvcd_world_mover;

// What acts on all movers of a step. Zero means the default.
typedef struct nsvcd_step_options {
  // metres a second squared; (0, 0, 0): there is none
  float gravity[3];
  // what touches something and has no point faster than `quiet`, default 0.15 metres a second, for
  // `calm` seconds, default 0.1, falls asleep
  float quiet, calm;
} nsvcd_step_options;

// What became of all movers in a frame.
typedef struct nsvcd_step_answer {
  // how many slid; how many sleep at the end, some of which slid; how many were caught
  size_t awake, asleep, caught;
  // of all slides
  size_t contacts, questions, work;
  // the body at fault, if something was refused; or nobody
  size_t refused;
} nsvcd_step_answer;

// Moves bodies of a world for a frame, and ends it. Each is given gravity and slides, the one whose
// pivot is lowest first, and what it hits gets its part of the momentum at once. Then what has been
// quiet for long enough falls asleep, and what is driven arrives.
//   movers     (count), each of a body of its own; NULL if that is 0. Their order matters only to
//              bodies of the same height, or without gravity
//   options    NULL: the defaults
//   seconds    of the frame
//   answer     may be NULL. On failure only its `refused` is set, with POSE all of it
//   allocates  nothing
//   threads    as nsvcd_world_move
//   errors     those of nsvcd_world_slide; INDEX (`id` is no body's, a fixed body's, or there
//              twice), VALUE (a gravity, a push mass or a damping), SPEED (`quiet` too), TIMES
//              (`calm` too): all of these leave everything as it was. POSE (a body is about to
//              leave the coordinates): that body stays where it is, and all others have moved
//   source     sequential impulses (Catto 2006) for the pairs of a body and those that it met; this
//              library
//
// What is proven is what slides prove: no two bodies overlap, if none did. The rest is physics:
//   A mover that stands on something driven, directly or by way of others, is carried: it goes
// along with it, then slides at the speed that it has relative to it. So stacks ride on lifts,
// platforms and turntables, as far as friction holds them. A mover that a lift comes up into is
// carried too, and so is what is in the way of riders. Going along is proven like any way, but past
// what moves at the same time it keeps only half the clearance. A mover that cannot go along, and
// all that stands on it, slides in the world, before those that are carried.
//   A mover that is driven (nsvcd_world_drive) goes where it is driven, for that frame, stops for
// nothing, and keeps its velocity.
//   What two bodies give each other keeps their momentum along the normal, and gains no energy. An
// approach no faster than two frames of gravity, or, of a mover with a mass, than twice `quiet`,
// gives nothing, or no pile would come to rest: such contacts only hold. A mover with a mass that
// could hardly move, in this frame and the one before, gives to its sides only.
//   A mover with a mass and a friction that touches something is braked: its speed falls at a rate
// of 0.3 a second and its spin at 1.2, and both at 10 below 2.7 times `quiet`.
//   A sleeper wakes when it is pushed, moved or given a speed, when what it touches is moved,
// removed or faster than `quiet`, and when something is driven near it. One that was put to sleep
// before its first frame has no contacts yet to be woken by.
NSVCDDEF nsvcd_result nsvcd_world_step(nsvcd_world *world, nsvcd_world_mover *movers,
                                       size_t count, const nsvcd_step_options *options,
                                       float seconds, void *workspace, size_t workspace_size,
                                       nsvcd_step_answer *answer);

// A mesh as a solid of one density.
typedef struct nsvcd_mass {
  // cubic metres
  float volume;
  // the centre of mass: the pivot of what moves freely
  float centre[3];
  // square metres: moments of inertia about the axes of its frame through that centre, of a
  // kilogram. Times the mass, and the scale squared, they are those of nsvcd_slide_options
  float inertia[3];
  // 1: the mesh is open, inside out or flat, and all of this is that of its box
  int is_of_box;
} nsvcd_mass;

// Computes the mass properties of a mesh: exactly, to rounding, if it is closed, which is tested by
// sums that hold for every closed surface. What parts that overlap share counts twice.
//   mesh, mass  not NULL; left as it was on failure
//   allocates   nothing
//   errors      ARGUMENT, INDEX, NUMBER, EMPTY
//   source      integrals over the tetrahedra from a point to each triangle
NSVCDDEF nsvcd_result nsvcd_mesh_mass(const nsvcd_mesh *mesh, nsvcd_mass *mass);
