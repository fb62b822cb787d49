// In: bodies at their places. Out: one answer about one of them and all that is near it, and moves
// after which nothing overlaps.
//
// THE LAW OF A FRAME
//   Bodies move one after the other, in the caller's order, each over the whole frame, and each is
// proven against all others where they are then. So after every move no two bodies are within the
// clearance of each other, whoever moved last, if none were before. No share of time has to be
// agreed upon, and a pile is not held up by the one contact in it that comes first.
//   A driven body (nsvcd_world_drive: a lift, a door, a turntable) is the exception: it moves while
// the others do, over the same frame, and stops for nobody. Others ride on it and get out of its
// way. What cannot is told as caught: it is free of the driven body up to the time that it reached,
// and not farther.
#pragma once
#include "queries.h"

// no body: ids begin at 1
#define NSVCD_NOBODY 0
// the most contacts of an answer about a world
#define NSVCD_WORLD_CONTACTS 32

// Bodies in a tree of boxes, in the caller's memory, in which it stays.
typedef struct nsvcd_world nsvcd_world;

// A body of a world. Zero is the default of everything but `body` and the rotation of `pose`.
typedef struct nsvcd_world_body {
  // with triangles; kept
  const nsvcd_body *body;
  // where it is
  nsvcd_pose pose;
  // as those of nsvcd_mover. The pivot of what moves freely is its centre of mass
  float scale;
  float pivot[3];
  // bits: the groups that it belongs to, default the first; and the groups that it passes through.
  // Two bodies meet unless one passes through a group of the other's
  uint32_t groups, passes;
  // 1: it never moves by itself, like a level: pairs of two such bodies are not listed
  int fixed;
  // 1: it stops nothing. nsvcd_world_list tells what is in it
  int sensor;
} nsvcd_world_body;

// A contact with a body of the world.
typedef struct nsvcd_world_contact {
  // which body; `a` of the contact is the mover, and `b` this body
  size_t body;
  nsvcd_contact contact;
  // newton seconds, along the normal: what a slide took from the mover's momentum there; for a body
  // without a mass, metres a second
  float impulse;
} nsvcd_world_contact;

// A question about a mover and all bodies of a world.
typedef struct nsvcd_world_question {
  // the question. Its b stays empty. Its a may have no body: then it is that of `self`
  nsvcd_question question;
  // the body of the world that moves, which does not meet itself, and whose groups count; or nobody
  size_t self;
  // of a mover that is nobody in the world
  uint32_t groups, passes;
} nsvcd_world_question;

// What is known of a mover and all that it comes near. Numbers are as those of nsvcd_answer.
typedef struct nsvcd_world_answer {
  // HIT: it hits some body. UNDECIDED: of some body that is not known, and it hits none. FREE: it
  // is free of all
  nsvcd_verdict verdict;
  nsvcd_why why;
  // the body that is hit first, or else is undecided first
  size_t body;
  // it is free of all bodies before `low`, and in contact with one at `high`
  nsvcd_range time;
  // FIRST: where the mover may go. This pose, as it is in floats, and the way to it are proven to
  // be free of all bodies. It is the start if that is not free
  float safe_time;
  nsvcd_pose safe;
  // with a slop: how the mover was pushed out, of all that it touched at once
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

// Adds a body, moves it elsewhere, takes it out, or tells of it. Nothing is asked: whoever puts a
// body into another gets a world of bodies that overlap, and what starts so is hit at time 0.
//   body, pose  not NULL
//   id          of add: not NULL; set to the body's id, from 1 on, or left as it was on failure.
//               Ids of removed bodies are used again
//   threads     one at a time, and none may ask: what is caught of that is NSVCD_ERROR_WORLD
//   errors      ARGUMENT, BODY, VERSION, TRIANGLES, POSE, QUATERNION, SCALE, PIVOT, COUNT (there
//               is no room for more bodies), INDEX (`id` is no body's), WORLD
NSVCDDEF nsvcd_result nsvcd_world_add(nsvcd_world *world, const nsvcd_world_body *body,
                                      size_t *id);
NSVCDDEF nsvcd_result nsvcd_world_move(nsvcd_world *world, size_t id, const nsvcd_pose *pose);
NSVCDDEF nsvcd_result nsvcd_world_remove(nsvcd_world *world, size_t id);
NSVCDDEF nsvcd_result nsvcd_world_get(const nsvcd_world *world, size_t id,
                                      nsvcd_world_body *body);

// Drives a body in this frame, from where it is to a pose: by a line and a slerp, about its pivot.
// nsvcd_world_arrive ends the frame: all driven bodies are at their ends, and rest.
//   errors      ARGUMENT, POSE, QUATERNION, INDEX, WORLD
NSVCDDEF nsvcd_result nsvcd_world_drive(nsvcd_world *world, size_t id, const nsvcd_pose *to);
NSVCDDEF nsvcd_result nsvcd_world_arrive(nsvcd_world *world);

// Answers a question about a mover and all that it comes near, driven bodies as they move. Sensors
// are left out. HIT ends at the first body that is hit.
//   With a slop, a mover that touches several bodies at the start is pushed out of all of them at
// once, by nearly the shortest push-out that is long enough along each body's own.
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
// through or stands in. What is undecided counts as met.
//   question   its question asks HIT
//   ids        (most); in ascending order
//   count      not NULL; how many are met, which may be more than `most`
//   errors     those of nsvcd_world_sweep, ASK
NSVCDDEF nsvcd_result nsvcd_world_list(const nsvcd_world *world,
                                       const nsvcd_world_question *question, void *workspace,
                                       size_t workspace_size, size_t *ids, size_t most,
                                       size_t *count);

// Lists the pairs of bodies whose boxes, over this frame, come within a distance: who may meet
// whom.
//   pairs      (most)
//   count      not NULL; how many there are, which may be more than `most`
//   errors     ARGUMENT, DISTANCE (`distance`), WORLD
NSVCDDEF nsvcd_result nsvcd_world_pairs(const nsvcd_world *world, float distance,
                                        nsvcd_body_pair *pairs, size_t most, size_t *count);

// units of work of a slide's questions
#define NSVCD_DEFAULT_SLIDE_WORK 10000

// How a body slides. Zero means the default.
typedef struct nsvcd_slide_options {
  // metres: what it never comes nearer to anything than; default a two-hundredth of its radius. And
  // how much farther than that it comes to rest, or a part of that; default the same
  float clearance, margin;
  // kilograms, and (3) kg m^2, about the axes of its frame through its pivot. Without an inertia it
  // does not turn by what it meets; without a mass it is a character, whose impulses are speeds
  float mass, inertia[3];
  // of what it rubs against; and of what it hits faster than half a metre a second
  float friction, restitution;
  // a character: the direction up, unit; (0, 0, 0): it has none. It rides on what it stands on
  float up[3];
  // metres: as high a step it climbs; and the least cosine between up and the normal of a ground
  // that it stands on, default 0.7
  float step, slope;
  // how often in a frame it goes on after a contact; default 4. Before driven bodies four times as
  // often
  size_t rounds;
  // units of each question, as question.work; default NSVCD_DEFAULT_SLIDE_WORK. What takes more is
  // stopped before it is decided
  size_t work;
} nsvcd_slide_options;

// A body's speed: metres a second of its pivot, and radians a second, in the world.
typedef struct nsvcd_velocity {
  float linear[3], angular[3];
} nsvcd_velocity;

// What became of a body in a frame. The body's next slide takes it back: what rested then, and is
// told the same again while nothing near it has moved, rests without a question.
typedef struct nsvcd_slide_answer {
  // where the body is
  nsvcd_pose pose;
  // of the frame, that it could make use of
  float spent;
  // 1: it rests: it did not move at all, and its speed is 0
  int rests;
  // the body that it stands on, and the ground's normal; or nobody
  size_t ground;
  float ground_normal[3];
  // the driven body that it could not get out of the way of; or nobody
  size_t caught;
  // where it touches at the end, or within the margin; impulses as they were when it was there
  size_t contact_count;
  nsvcd_world_contact contacts[NSVCD_WORLD_CONTACTS];
  size_t questions, work;
  // what it was told, and when: the library's
  nsvcd_slide_options told;
  nsvcd_velocity given;
  float seconds;
  uint64_t clock;
} nsvcd_slide_answer;

// Moves a body of the world for a frame, at its speed: it goes as far as is proven free, loses the
// speed that points into what it meets, and goes on with what is left of the frame. Its speed is
// that which it has at the end. Gravity and other forces are the caller's to add to it before.
//   world      the body is moved in it. One that was driven is so no more
//   velocity   not NULL
//   seconds    of the frame
//   answer     not NULL; zeroed, or the one of the same body's slide before, which only ever saves
//              time. On failure it, the velocity and the body are as they were
//   errors     those of nsvcd_world_sweep; SPEED, TIMES (`seconds`), CLEARANCE (clearance, margin),
//              VALUE (a mass, an inertia, a friction, a restitution or a slope), AXIS (`up`),
//              DISTANCE (`step`)
//   source     sequential impulses (Catto 2006) for the contacts of one body; this library
//
// What is proven: where the body is at the end, it is farther than the clearance from every other
// body, and was so on its way there. Where something else has come nearer to it than that, it is
// pushed out, by at most four times the clearance, and meets nothing on that way. What a contact
// does to its speed is no proof, only physics: impulses are those of a body that meets others that
// rest or are driven. Whoever wants what is hit to move hands it the impulse.
NSVCDDEF nsvcd_result nsvcd_world_slide(nsvcd_world *world, size_t id,
                                        const nsvcd_slide_options *options, float seconds,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_velocity *velocity, nsvcd_slide_answer *answer);

// A body that a step moves. Zero is the default of everything but `id`.
typedef struct nsvcd_world_mover {
  size_t id;
  // how it slides
  nsvcd_slide_options how;
  // yours to change between two steps: what sleeps and is given a speed is awake
  nsvcd_velocity velocity;
  // kilograms: what a character pushes with; default 0: it pushes nothing. A character is whatever
  // has no mass in `how`
  float push_mass;
  // a second: the share of its speed, and of its spin, that it loses everywhere
  float damping, spin_damping;
  // 1: it sleeps: it stays where it is, and costs nothing. Yours to read, set and clear
  int asleep;
  // 1: it never falls asleep. Nor do characters
  int sleepless;
  // seconds for which it has been quiet: the library's
  float calm;
  // of its last slide
  nsvcd_slide_answer answer;
} nsvcd_world_mover;

// What acts on all movers of a step. Zero means the default.
typedef struct nsvcd_step_options {
  // metres a second squared; (0, 0, 0): there is none
  float gravity[3];
  // metres a second, default 0.15: what touches something, and of which no point is faster than
  // that, falls asleep after so many seconds, default 0.1
  float quiet, calm;
} nsvcd_step_options;

// What became of all movers in a frame.
typedef struct nsvcd_step_answer {
  // how many moved or could have, sleep at the end, and were caught
  size_t awake, asleep, caught;
  // of all slides
  size_t contacts, questions, work;
  // the body at fault, if something was refused; or nobody
  size_t refused;
} nsvcd_step_answer;

// Moves bodies of a world for a frame, and ends it: each is given gravity and slides, the lowest
// first, by its pivot and against gravity; what it hits has its part of the momentum then; who is
// quiet for long enough falls asleep; and what is driven arrives.
//   movers     (count), each of a body of its own; NULL if that is 0. In any order: what happens
//              depends on it only between bodies of the same height, or without gravity
//   options    NULL: the defaults
//   seconds    of the frame
//   answer     may be NULL. On failure only its `refused` is set, but with POSE all of it
//   allocates  nothing
//   threads    as nsvcd_world_move
//   errors     those of nsvcd_world_slide; INDEX (`id` is no body's, a fixed body's, or there
//              twice), VALUE (a gravity, a push mass or a damping), SPEED (`quiet` too), TIMES
//              (`calm` too). They are found before anything moves, and then everything is as it
//              was. But POSE (a body is about to leave the coordinates) is found then: that body
//              stays where it is, and all others have moved
//   source     sequential impulses (Catto 2006) for the pairs of a body and those that it met; this
//              library
//
// What is proven is proven as of slides: no two bodies overlap, if none did. The rest is physics:
//   Whoever stands on something driven, be it by way of others, is carried: it goes along at the
// same time, and slides afterwards, at the speed that it has besides. So stacks ride on lifts,
// platforms and turntables, as far as friction holds them. What a lift comes up into is carried
// too, and what is in the way of those who are. Going along is proven as any way is, but past what
// moves at the same time by half the clearance. Who cannot go along, and whoever stands on that,
// slides with the others, before all who are carried.
//   A mover that is driven (nsvcd_world_drive) goes where it is driven, for that frame, as one that
// nothing stops, and its velocity is left alone.
//   What two bodies give each other keeps their momentum along the normal, and gains no energy.
// What comes no faster than gravity speeds it up in two frames, or, unless it is a character, than
// twice `quiet`, gives nothing, or no pile would come to rest: such contacts only hold.
//   What has a friction is braked where it touches: it loses 0.3 of its speed a second, 1.2 of its
// spin, and 10 of both while it is nearly quiet.
//   What sleeps wakes when it is given something, when what it touches is moved, removed or faster
// than `quiet`, and when something is driven near it. Who is put to sleep before its first
// frame is woken by all of these but what it touches, which nobody knows.
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

// Computes the mass properties of a mesh. Exact, to rounding, where it is closed; that is held
// against what any closed surface adds up to. Of parts that overlap what they share counts twice.
//   mesh, mass  not NULL; left as it was on failure
//   allocates   nothing
//   errors      ARGUMENT, INDEX, NUMBER, EMPTY
//   source      integrals over the tetrahedra from a point to each triangle
NSVCDDEF nsvcd_result nsvcd_mesh_mass(const nsvcd_mesh *mesh, nsvcd_mass *mass);
