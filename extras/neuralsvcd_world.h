// neuralsvcd_world.h - v0.3.0 - one body against all others: a world for games and simulations
// SPDX-License-Identifier: MIT
//
// nsvcd_world_sweep answers a question about one mover and all that it comes near; and
// nsvcd_world_slide moves a body for a frame: it goes, loses the speed that points into what it
// meets, and goes on, and no two bodies ever overlap. It stands on the public functions of
// neuralsvcd.h. In ONE C or C++ file:
//
//   #define NEURALSVCD_WORLD_IMPLEMENTATION
//   #include "extras/neuralsvcd_world.h"
//
// CONTENTS: a room's name ends a line of dashes. Each uses only those above it.
//   interface: what a program sees
//     worlds          a world, questions about one body and all others, slides
//   ground: numbers and memory
//     compiler        what is asked of the compiler; libc and libm
//     angles          sines and angles, by libm or computed here
//     bits            bits and sizes
//     valid           is what a caller hands over in order?
//     points          vectors of three, of floats and of doubles
//     rotations       quaternions and matrices, of floats and of doubles
//     motions         between two poses: lines and slerps, in double
//     memory          the allocator; the rows of a workspace
//   world: one body against all others
//     boxes           boxes about bodies on their ways
//     tree            boxes that meet a box
//     world           bodies at their places; who may meet whom
//     ask             a mover against all that it comes near
//     respond         what contacts leave of a speed
//     ways            contacts, and ways as far as they are free
//     walk            characters: grounds, walls and steps
//     slide           a frame of a body
//     momentum        what bodies that meet give each other
//     carry           who goes along with lifts
//     step            a frame of all
//     mass            the mass of a mesh
//
#ifndef NEURALSVCD_WORLD_H
#define NEURALSVCD_WORLD_H
#ifndef NEURALSVCD_H  // include it first where it stands elsewhere
#include "../neuralsvcd.h"
#endif
#ifdef NSVCD_NO_PROOF
#error "neuralsvcd_world.h: proofs are all it does, and NSVCD_NO_PROOF leaves them out"
#endif

// ================================================================== interface: what a program sees
#ifdef __cplusplus
extern "C" {
#endif

// -------------------------------------------------------------------------------- interface/worlds
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
#ifdef __cplusplus
}
#endif
#endif  // NEURALSVCD_WORLD_H

// ================================================================================== IMPLEMENTATION
#if defined(NEURALSVCD_WORLD_IMPLEMENTATION) && !defined(NEURALSVCD_WORLD_IMPLEMENTED)
#define NEURALSVCD_WORLD_IMPLEMENTED
#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // of ground, not all is needed
#endif

// ====================================================================== ground: numbers and memory

// --------------------------------------------------------------------------------- ground/compiler
#ifndef NSVCD__HAS_GROUND_COMPILER
#define NSVCD__HAS_GROUND_COMPILER
// In: the compiler at hand. Out: libc and libm, and how functions are inlined.

#ifdef __TINYC__  // 0.9.27: if a struct and a float, both returned by calls, are passed together
#error "neuralsvcd.h: tcc passes arguments wrongly, and certificates would be false"
#endif
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifndef NSVCD_NO_STDIO
#include <stdio.h>
#endif
// NSVCD_ONE_PATH: nothing may be fused or computed more exactly than it is written.
#ifdef NSVCD_ONE_PATH
#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || \
    (FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16)
#error \
    "neuralsvcd.h: NSVCD_ONE_PATH: not with -ffast-math, nor where floats are computed in double"
#endif
// gcc has a flag for that, and a pragma that slows everything down tenfold.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif
#endif
// For functions in which sums and differences of products stand side by side: there gcc 12 fuses
// whatever it is told (vfmaddsub).
#if defined(NSVCD_ONE_PATH) && defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNFUSED \
  static __attribute__((noinline, unused, optimize("no-tree-slp-vectorize")))
#else
#define NSVCD__UNFUSED static inline
#endif
// For functions that take less stack and flash if they are inlined.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__FORCE_INLINE static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define NSVCD__FORCE_INLINE static __forceinline
#else
#define NSVCD__FORCE_INLINE static inline
#endif
// For functions whose loops over constant arguments must be unrolled. Left to itself, gcc may not
// inline them, and the decoder takes four times as long (tests/bench/PERFORMANCE.md).
#ifdef __OPTIMIZE_SIZE__
#define NSVCD__INLINE static inline
#else
#define NSVCD__INLINE NSVCD__FORCE_INLINE
#endif
// For functions whose stack would add up in a caller.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__NOINLINE __attribute__((noinline))
#elif defined(_MSC_VER)
#define NSVCD__NOINLINE __declspec(noinline)
#else
#define NSVCD__NOINLINE
#endif
#if defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNROLL _Pragma("GCC unroll 8")  // at -O2 too, so that sums stay in registers
#define NSVCD__O3 __attribute__((optimize("O3")))  // short loops, that -O2 leaves as they are
#else
#define NSVCD__UNROLL
#define NSVCD__O3
#endif
#endif  // NSVCD__HAS_GROUND_COMPILER

// ----------------------------------------------------------------------------------- ground/angles
#ifndef NSVCD__HAS_GROUND_ANGLES
#define NSVCD__HAS_GROUND_ANGLES
// In: angles up to a quarter turn, and lengths. Out: sines, and angles. By libm; with
// NSVCD_ONE_PATH computed here, because libm's last digit differs between machines.

#ifdef NSVCD_ONE_PATH
// sin x for 0 <= x <= pi / 2, to 1e-15: the rest of the series is below 2e-18.
static inline double nsvcd__sin(double x) {
  const double square = x * x;
  double sum = 1;
  for (int n = 20; n > 0; n -= 2) sum = 1 - sum * (square / (n * (n + 1)));
  return x * sum;
}
// The angle of a vector (x, y), x, y >= 0, to 1e-15. tan(a / 2) = tan a / (1 + sqrt(1 + tan^2 a))
// halves it twice, to below 0.2, where the rest of the series is below 1e-18.
static inline double nsvcd__atan2(double y, double x) {
  const int steep = y > x;
  const double slope = steep ? x / y : x > 0 ? y / x : 0;
  double t = slope;
  double sum = 0;
  for (int n = 0; n < 2; n++) t = t / (1 + sqrt(1 + t * t));
  for (int n = 25; n > 0; n -= 2) sum = 1.0 / n - sum * (t * t);
  return steep ? 1.57079632679489662 - 4 * t * sum : 4 * t * sum;
}
static inline float nsvcd__sinf(float x) {
  return (float)nsvcd__sin((double)x);
}
// For 0 <= x < 1.
static inline float nsvcd__asinf(float x) {
  const double sine = (double)x;
  return (float)nsvcd__atan2(sine, sqrt(1 - sine * sine));
}
#else
#define nsvcd__sin sin
#define nsvcd__atan2 atan2
#define nsvcd__sinf sinf
#define nsvcd__asinf asinf
#endif
#endif  // NSVCD__HAS_GROUND_ANGLES

// ------------------------------------------------------------------------------------- ground/bits
#ifndef NSVCD__HAS_GROUND_BITS
#define NSVCD__HAS_GROUND_BITS
// In: whole numbers, and floats. Out: bits that are set, sizes rounded up, floats as bits.

// The index of the lowest bit that is set, of a number that is not 0.
static size_t nsvcd__low_bit(uint64_t bits) {
#if defined(__GNUC__) || defined(__clang__)
  return (size_t)__builtin_ctzll(bits);
#else
  size_t n = 0;
  while (!(bits >> n & 1)) n++;
  return n;
#endif
}

static size_t nsvcd__bit_count(uint64_t bits) {
#if defined(__GNUC__) || defined(__clang__)
  return (size_t)__builtin_popcountll(bits);
#else
  size_t n = 0;
  for (; bits; bits &= bits - 1) n++;
  return n;
#endif
}

static size_t nsvcd__round_up(size_t n, size_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

// |x| as bits, which are ordered as |x| is; infinity and NaN are above all numbers.
static uint32_t nsvcd__magnitude(float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits & 0x7fffffffu;
}
static inline int nsvcd__is_finite(float x) {
  return nsvcd__magnitude(x) < 0x7f800000u;
}
#endif  // NSVCD__HAS_GROUND_BITS

// ------------------------------------------------------------------------------------ ground/valid
#ifndef NSVCD__HAS_GROUND_VALID
#define NSVCD__HAS_GROUND_VALID
// In: what a caller passes. Out: is it valid?

#define NSVCD__MAX_COUNT 0x7fffffffu  // vertices and triangles: 2^31 - 1

static int nsvcd__is_aligned(const void *memory) {
  return ((uintptr_t)memory & (NSVCD_ALIGNMENT - 1)) == 0;
}

// Are numbers finite, and their absolute values at most `most`? By their bits, so that it holds
// under -ffast-math too.
static NSVCD__NOINLINE int nsvcd__in_range(const float *values, size_t count, float most) {
  for (size_t i = 0; i < count; i++) {
    if (!nsvcd__is_finite(values[i]) || fabsf(values[i]) > most) return 0;
  }
  return 1;
}

// A float that is not less than x >= 0.
static inline float nsvcd__above(double x) {
  return (float)(x * (1 + 2e-7)) + 1e-37f;
}

// Is it a valid length, or 0?
static int nsvcd__is_length(float x) {
  return nsvcd__is_finite(x) && x >= 0 && x <= NSVCD_MAX_COORDINATE;
}

// Are all numbers in range and all quaternions of unit length?
static nsvcd_result nsvcd__poses_check(const nsvcd_pose *poses, size_t count) {
  const float *numbers = poses->position;  // 7 to a pose
  uint32_t most = 0;
  float shortest = 1;
  float longest = 1;
  for (size_t k = 0; k < 7 * count; k++) {
    const uint32_t bits = nsvcd__magnitude(numbers[k]);
    most = bits > most ? bits : most;
  }
  for (size_t k = 0; k < count; k++) {
    const float *q = poses[k].rotation;
    const float square = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
    shortest = square < shortest ? square : shortest;
    longest = square > longest ? square : longest;
  }
  const int is_unit =
      shortest >= 1 - 2 * NSVCD_UNIT_TOLERANCE && longest <= 1 + 2 * NSVCD_UNIT_TOLERANCE;
  if (is_unit && most <= nsvcd__magnitude(NSVCD_MAX_COORDINATE)) return NSVCD_OK;
  for (size_t k = 0; k < count; k++) {
    if (!nsvcd__in_range(poses[k].position, 3, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_POSE;
  }
  return NSVCD_ERROR_QUATERNION;
}

// Do times rise from 0 to 1, if there are any?
static int nsvcd__times_are_valid(const float *times, size_t count) {
  if (!times || count == 1) return 1;
  const float last = times[count - 1];
  int rise = !(times[0] < 0) && !(times[0] > 0) && last <= 1 && last >= 1;
  for (size_t k = 1; k < count; k++)  // NaN does not rise
    rise &= (double)times[k] - (double)times[k - 1] >= 0.99e-7;
  return rise;
}

// The pose of a mover without poses.
static const nsvcd_pose nsvcd__at_origin = {{0, 0, 0}, {0, 0, 0, 1}};

// A mover's scale; the default is 1.
static float nsvcd__scale_of(const nsvcd_mover *mover) {
  return mover->scale > 0 ? mover->scale : 1;
}

static size_t nsvcd__pose_count(const nsvcd_mover *mover) {
  return mover->poses ? mover->count : 1;
}

static nsvcd_result nsvcd__track_check(const nsvcd_mover *mover) {
  const float scale = nsvcd__scale_of(mover);
  const float most = NSVCD_MAX_COORDINATE / (scale > 1 ? scale : 1);
  if (!nsvcd__in_range(mover->pivot, 3, most)) return NSVCD_ERROR_PIVOT;
  if (!mover->poses) return mover->count == 0 ? NSVCD_OK : NSVCD_ERROR_POSES;
  if (mover->count < 1 || mover->count > NSVCD_MAX_POSES) return NSVCD_ERROR_POSES;
  if (!nsvcd__times_are_valid(mover->times, mover->count)) return NSVCD_ERROR_TIMES;
  return nsvcd__poses_check(mover->poses, mover->count);
}

// A mesh may come from anywhere: all that follows relies on these checks.
static inline nsvcd_result nsvcd__mesh_check(const nsvcd_mesh *mesh) {
  if (!mesh) return NSVCD_ERROR_ARGUMENT;
  if (mesh->triangle_count == 0) return NSVCD_ERROR_EMPTY;
  if (!mesh->positions || !mesh->indices) return NSVCD_ERROR_ARGUMENT;
  const size_t vertices = mesh->vertex_count;
  const size_t triangles = mesh->triangle_count;
  if (vertices > NSVCD__MAX_COUNT || triangles > NSVCD__MAX_COUNT)
    return NSVCD_ERROR_TOO_LARGE;
  for (size_t i = 0; i < 3 * triangles; i++) {
    if (mesh->indices[i] >= vertices) return NSVCD_ERROR_INDEX;
  }
  if (!nsvcd__in_range(mesh->positions, 3 * vertices, NSVCD_MAX_COORDINATE))
    return NSVCD_ERROR_NUMBER;
  return NSVCD_OK;
}
#endif  // NSVCD__HAS_GROUND_VALID

// ----------------------------------------------------------------------------------- ground/points
#ifndef NSVCD__HAS_GROUND_POINTS
#define NSVCD__HAS_GROUND_POINTS
// In, out: vectors of three numbers, as values: f3 of floats, d3 of doubles. A box is two corners.

// The greater, or the lesser, of two; b if one is NaN. fmax and fmin, which handle NaN, are calls
// with most compilers.
static inline double nsvcd__max(double a, double b) {
  return a > b ? a : b;
}
static inline double nsvcd__min(double a, double b) {
  return a < b ? a : b;
}

// The algebra of f3 and of d3: NSVCD__VECTORS(nsvcd__f3, float, sqrtf) writes nsvcd__f3_add and so
// on. _load and _row read floats, three to a row; _fma(s, b, a) is s b + a, rounded twice. In
// double, differences of floats and what is built of a few of them are practically exact.
#define NSVCD__VECTORS(t, scalar, sqrt) \
  typedef struct t { \
    scalar x, y, z; \
  } t; \
  static inline t t##_of(scalar x, scalar y, scalar z) { \
    const t out = {x, y, z}; \
    return out; \
  } \
  static inline t t##_load(const float *p) { \
    return t##_of((scalar)p[0], (scalar)p[1], (scalar)p[2]); \
  } \
  static inline t t##_row(const float *rows, size_t i) { \
    return t##_load(rows + 3 * i); \
  } \
  static inline t t##_add(t a, t b) { \
    return t##_of(a.x + b.x, a.y + b.y, a.z + b.z); \
  } \
  static inline t t##_sub(t a, t b) { \
    return t##_of(a.x - b.x, a.y - b.y, a.z - b.z); \
  } \
  static inline t t##_scale(t a, scalar s) { \
    return t##_of(s * a.x, s * a.y, s * a.z); \
  } \
  static inline t t##_fma(scalar s, t b, t a) { \
    return t##_of(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z); \
  } \
  static inline t t##_min(t a, t b) { \
    return t##_of(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z); \
  } \
  static inline t t##_max(t a, t b) { \
    return t##_of(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z); \
  } \
  static inline scalar t##_dot(t a, t b) { \
    return a.x * b.x + a.y * b.y + a.z * b.z; \
  } \
  static inline t t##_cross(t a, t b) { \
    return t##_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); \
  } \
  static inline scalar t##_norm(t a) { \
    return sqrt(t##_dot(a, a)); \
  }
NSVCD__VECTORS(nsvcd__f3, float, sqrtf)
NSVCD__VECTORS(nsvcd__d3, double, sqrt)
#undef NSVCD__VECTORS

// ---- floats

// From, and to, rows of x, y and z, `stride` apart.
static inline nsvcd__f3 nsvcd__f3_get(const float *rows, size_t stride) {
  return nsvcd__f3_of(rows[0], rows[stride], rows[2 * stride]);
}
static inline void nsvcd__f3_put(nsvcd__f3 a, float *rows, size_t stride) {
  rows[0] = a.x;
  rows[stride] = a.y;
  rows[2 * stride] = a.z;
}
static inline void nsvcd__f3_store(nsvcd__f3 a, float *p) {
  nsvcd__f3_put(a, p, 1);
}
// Is any component of a greater than b's?
static inline int nsvcd__f3_exceeds(nsvcd__f3 a, nsvcd__f3 b) {
  return (a.x > b.x) | (a.y > b.y) | (a.z > b.z);
}

// A box along the axes.
typedef struct nsvcd__box {
  nsvcd__f3 low, high;
} nsvcd__box;

// Component 0, 1 or 2.
static inline double nsvcd__d3_axis(nsvcd__d3 a, size_t axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
static inline void nsvcd__d3_set_axis(nsvcd__d3 *a, size_t axis, double to) {
  *(axis == 0 ? &a->x : axis == 1 ? &a->y : &a->z) = to;
}
// The axis of the greatest component; of equals the first.
static inline size_t nsvcd__d3_longest(nsvcd__d3 a) {
  if (a.y > a.x && a.y >= a.z) return 1;
  return a.z > a.x ? 2 : 0;
}
static inline nsvcd__d3 nsvcd__d3_over(nsvcd__d3 a, double s) {
  return nsvcd__d3_of(a.x / s, a.y / s, a.z / s);
}
static inline nsvcd__f3 nsvcd__d3_narrow(nsvcd__d3 a) {
  return nsvcd__f3_of((float)a.x, (float)a.y, (float)a.z);
}
// a + t (b - a).
static inline nsvcd__d3 nsvcd__d3_mix(nsvcd__d3 a, nsvcd__d3 b, double t) {
  return nsvcd__d3_add(a, nsvcd__d3_scale(nsvcd__d3_sub(b, a), t));
}
static inline double nsvcd__d3_distance2(nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__d3 offset = nsvcd__d3_sub(a, b);
  return nsvcd__d3_dot(offset, offset);
}
// Of length 1; `otherwise` if a is 0.
static inline nsvcd__d3 nsvcd__d3_unit(nsvcd__d3 a, nsvcd__d3 otherwise) {
  const double length = nsvcd__d3_norm(a);
  return length > 0 ? nsvcd__d3_scale(a, 1 / length) : otherwise;
}
// Rounds for certain. gcc 12 at -O2 drops both conversions where two neighbouring doubles become
// floats and doubles again, and a proof built on the stored floats would not hold. clang 14 for
// WebAssembly, in turn, reads a volatile number that fills a vector a second time, when it may have
// been overwritten.
static inline float nsvcd__to_float(double x) {
#ifdef __wasm_simd128__
  return (float)x;
#else
  volatile float rounded = (float)x;
  return rounded;
#endif
}
static inline nsvcd__f3 nsvcd__f3_round(nsvcd__d3 a) {
  return nsvcd__f3_of(nsvcd__to_float(a.x), nsvcd__to_float(a.y), nsvcd__to_float(a.z));
}
static inline nsvcd__d3 nsvcd__d3_widen(nsvcd__f3 a) {
  return nsvcd__d3_of((double)a.x, (double)a.y, (double)a.z);
}
// Rounded to double where registers are wider (x87), so that it equals itself computed again.
static inline double nsvcd__stored(double x) {
#if FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 1
  return x;
#else
  volatile double rounded = x;
  return rounded;
#endif
}
static inline nsvcd__d3 nsvcd__d3_stored(nsvcd__d3 a) {
  return nsvcd__d3_of(nsvcd__stored(a.x), nsvcd__stored(a.y), nsvcd__stored(a.z));
}
#endif  // NSVCD__HAS_GROUND_POINTS

// -------------------------------------------------------------------------------- ground/rotations
#ifndef NSVCD__HAS_GROUND_ROTATIONS
#define NSVCD__HAS_GROUND_ROTATIONS
// In, out: rotations, as values: quat and mat3 of floats, dquat and dmat3 of doubles. A matrix is
// its rows. A transform is a rotation and a position.

// The algebra of both: NSVCD__ROTATIONS writes nsvcd__quat_dot, nsvcd__mat3_apply and so on.
//   _fma(s, b, a)        s b + a
//   _axis, _inverse      of a unit quaternion; the axis times the sine of half its angle
//   _mul(a, b)           the rotation by b, then by a
//   _turn(a, b)          from a to b, both unit: the axis, times the sine of half the angle
//   _along(a, b, arc, u) the slerp from a to b, which are that arc apart, at fraction u: of any
//                        length. Up to the arc `least` a line is as good, to rounding
//   _of                  the matrix of a unit quaternion
//   _apply_transpose     the transpose of m, times a
//   _transform           rotation a + position
#define NSVCD__ROTATIONS(quat, mat, placed, vec, scalar, sqrt, sin, least) \
  typedef struct quat { \
    scalar x, y, z, w; \
  } quat; \
  typedef struct mat { \
    vec x, y, z; \
  } mat; \
  typedef struct placed { \
    mat rotation; \
    vec position; \
  } placed; \
  static inline scalar quat##_dot(quat a, quat b) { \
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; \
  } \
  static inline quat quat##_scale(quat q, scalar s) { \
    const quat out = {q.x * s, q.y * s, q.z * s, q.w * s}; \
    return out; \
  } \
  static inline quat quat##_fma(scalar s, quat b, quat a) { \
    const quat out = {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z, a.w + s * b.w}; \
    return out; \
  } \
  NSVCD__FORCE_INLINE quat quat##_unit(quat q) { \
    return quat##_scale(q, 1 / sqrt(quat##_dot(q, q))); \
  } \
  static inline vec quat##_axis(quat q) { \
    return vec##_of(q.x, q.y, q.z); \
  } \
  static inline quat quat##_inverse(quat q) { \
    const quat out = {-q.x, -q.y, -q.z, q.w}; \
    return out; \
  } \
  static inline quat quat##_mul(quat a, quat b) { \
    quat out; \
    out.x = a.w * b.x + a.x * b.w + (a.y * b.z - a.z * b.y); \
    out.y = a.w * b.y + a.y * b.w + (a.z * b.x - a.x * b.z); \
    out.z = a.w * b.z + a.z * b.w + (a.x * b.y - a.y * b.x); \
    out.w = a.w * b.w - (a.x * b.x + a.y * b.y + a.z * b.z); \
    return out; \
  } \
  static inline vec quat##_turn(quat a, quat b) { \
    return quat##_axis(quat##_mul(b, quat##_inverse(a))); \
  } \
  static inline quat quat##_along(quat a, quat b, scalar arc, scalar u) { \
    const int bends = arc > least; \
    const scalar before = bends ? sin((1 - u) * arc) : 1 - u; \
    const scalar after = bends ? sin(u * arc) : u; \
    return quat##_fma(after, b, quat##_scale(a, before)); \
  } \
  NSVCD__UNFUSED mat mat##_of(quat q) { \
    mat m; \
    m.x.x = 1 - 2 * (q.y * q.y + q.z * q.z); \
    m.x.y = 2 * (q.x * q.y - q.z * q.w); \
    m.x.z = 2 * (q.x * q.z + q.y * q.w); \
    m.y.x = 2 * (q.x * q.y + q.z * q.w); \
    m.y.y = 1 - 2 * (q.x * q.x + q.z * q.z); \
    m.y.z = 2 * (q.y * q.z - q.x * q.w); \
    m.z.x = 2 * (q.x * q.z - q.y * q.w); \
    m.z.y = 2 * (q.y * q.z + q.x * q.w); \
    m.z.z = 1 - 2 * (q.x * q.x + q.y * q.y); \
    return m; \
  } \
  static inline mat mat##_transpose(mat m) { \
    const mat out = {vec##_of(m.x.x, m.y.x, m.z.x), vec##_of(m.x.y, m.y.y, m.z.y), \
                     vec##_of(m.x.z, m.y.z, m.z.z)}; \
    return out; \
  } \
  static inline vec mat##_apply(const mat *m, vec a) { \
    return vec##_of(vec##_dot(m->x, a), vec##_dot(m->y, a), vec##_dot(m->z, a)); \
  } \
  static inline vec mat##_apply_transpose(const mat *m, vec a) { \
    const mat back = mat##_transpose(*m); \
    return mat##_apply(&back, a); \
  } \
  static inline vec vec##_transform(const placed *t, vec a) { \
    return vec##_add(mat##_apply(&t->rotation, a), t->position); \
  }
NSVCD__ROTATIONS(nsvcd__quat, nsvcd__mat3, nsvcd__transform, nsvcd__f3, float, sqrtf,
                 nsvcd__sinf, 1e-3f)
NSVCD__ROTATIONS(nsvcd__dquat, nsvcd__dmat3, nsvcd__dtransform, nsvcd__d3, double, sqrt,
                 nsvcd__sin, 1e-7)
#undef NSVCD__ROTATIONS

static inline nsvcd__dmat3 nsvcd__dmat3_scale(const nsvcd__dmat3 *m, double s) {
  const nsvcd__dmat3 out = {nsvcd__d3_scale(m->x, s), nsvcd__d3_scale(m->y, s),
                            nsvcd__d3_scale(m->z, s)};
  return out;
}

// ---- quaternions and matrices of floats

static inline nsvcd__quat nsvcd__quat_of(float x, float y, float z, float w) {
  const nsvcd__quat out = {x, y, z, w};
  return out;
}
static inline nsvcd__quat nsvcd__quat_load(const float *p) {
  return nsvcd__quat_of(p[0], p[1], p[2], p[3]);
}
// To rows of x, y, z and w, `stride` apart.
static inline void nsvcd__quat_put(nsvcd__quat q, float *rows, size_t stride) {
  rows[0] = q.x;
  rows[stride] = q.y;
  rows[2 * stride] = q.z;
  rows[3 * stride] = q.w;
}
static inline void nsvcd__quat_store(nsvcd__quat q, float *p) {
  nsvcd__quat_put(q, p, 1);
}

// Is the shorter arc from a to b the one to -b? Products of floats are exact in double, so every
// machine agrees, and so do poses in float and in double, even if both arcs are equally long to
// rounding.
static inline int nsvcd__quats_opposed(nsvcd__quat a, nsvcd__quat b) {
  double dot = (double)a.x * (double)b.x;
  dot = nsvcd__stored(dot + (double)a.y * (double)b.y);
  dot = nsvcd__stored(dot + (double)a.z * (double)b.z);
  dot = nsvcd__stored(dot + (double)a.w * (double)b.w);
  return dot < 0;
}

// The length of the arc from a to b in quaternion space: half the angle of rotation, in [0, pi/2]
// for the shorter arc. From the chord, because acos of a dot product near 1 has no digits left.
static inline float nsvcd__quat_arc(nsvcd__quat a, nsvcd__quat b) {
  const nsvcd__quat chord = nsvcd__quat_fma(-1, b, a);
  return 2 * nsvcd__asinf(0.5f * sqrtf(nsvcd__quat_dot(chord, chord)));
}

// The same rotation, negated if it is opposed to another quaternion.
static inline nsvcd__quat nsvcd__quat_beside(nsvcd__quat q, int opposed) {
  return opposed ? nsvcd__quat_of(-q.x, -q.y, -q.z, -q.w) : q;
}

// From a at u = 0 to b at u = 1, on the shorter arc. a, b: unit to 1e-4.
static inline nsvcd__quat nsvcd__quat_slerp(nsvcd__quat a, nsvcd__quat b, float u) {
  const int opposed = nsvcd__quats_opposed(a, b);
  const nsvcd__quat start = nsvcd__quat_unit(a);
  const nsvcd__quat end = nsvcd__quat_beside(nsvcd__quat_unit(b), opposed);
  const float arc = nsvcd__quat_arc(start, end);
  return nsvcd__quat_unit(nsvcd__quat_along(start, end, arc, u));
}

// s (a + t b).
static inline nsvcd__mat3 nsvcd__mat3_mix(float s, const nsvcd__mat3 *a, float t,
                                          const nsvcd__mat3 *b) {
  const nsvcd__mat3 out = {nsvcd__f3_scale(nsvcd__f3_fma(t, b->x, a->x), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->y, a->y), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->z, a->z), s)};
  return out;
}
#endif  // NSVCD__HAS_GROUND_ROTATIONS

// ---------------------------------------------------------------------------------- ground/motions
#ifndef NSVCD__HAS_GROUND_MOTIONS
#define NSVCD__HAS_GROUND_MOTIONS
// In: poses, as a caller gives them. Out: in double, where a body is between two of them, and how
// it turns on the way: its rotation is a slerp on the shorter arc, and the position of its pivot
// linear. With the pivot c of the body's frame, scaled, the pivot of a pose is at position + R c.
//
// This is the law of motion, for proofs, certificates and robots. The floor of motions has it again
// in float, 16 segments at a time: every query cuts its motion, and poses in double alone would
// take longer than that.

// A pose in double. Its rotation is of any length.
typedef struct nsvcd__dpose {
  nsvcd__dquat rotation;
  nsvcd__d3 position;
} nsvcd__dpose;

static inline nsvcd__dpose nsvcd__dpose_of(const nsvcd_pose *pose) {
  const float *q = pose->rotation;
  const nsvcd__dpose out = {{(double)q[0], (double)q[1], (double)q[2], (double)q[3]},
                            nsvcd__d3_load(pose->position)};
  return out;
}

// With a unit rotation.
static inline nsvcd__dpose nsvcd__unit_dpose(const nsvcd_pose *pose) {
  nsvcd__dpose out = nsvcd__dpose_of(pose);
  out.rotation = nsvcd__dquat_unit(out.rotation);
  return out;
}

static inline nsvcd__dtransform nsvcd__dtransform_of(const nsvcd__dpose *pose) {
  const nsvcd__dtransform out = {nsvcd__dmat3_of(nsvcd__dquat_unit(pose->rotation)),
                                 pose->position};
  return out;
}

static inline nsvcd_pose nsvcd__dpose_round(const nsvcd__dpose *pose) {
  const nsvcd__dquat turn = nsvcd__dquat_unit(pose->rotation);
  nsvcd_pose out;
  nsvcd__f3_store(nsvcd__f3_round(pose->position), out.position);
  nsvcd__f3_store(nsvcd__f3_round(nsvcd__dquat_axis(turn)), out.rotation);
  out.rotation[3] = nsvcd__to_float(turn.w);
  return out;
}

// Is the shorter arc from a to b the one to -b?
static inline int nsvcd__poses_opposed(const nsvcd_pose *a, const nsvcd_pose *b) {
  return nsvcd__quats_opposed(nsvcd__quat_load(a->rotation), nsvcd__quat_load(b->rotation));
}

// The length of the arc from a to b, both unit, in quaternion space: half the angle of the turn.
static inline double nsvcd__dquat_arc(nsvcd__dquat a, nsvcd__dquat b) {
  const nsvcd__dquat difference = nsvcd__dquat_fma(-1, b, a);
  const nsvcd__dquat sum = nsvcd__dquat_fma(1, b, a);
  const double apart = sqrt(nsvcd__dquat_dot(difference, difference));
  return 2 * nsvcd__atan2(apart, sqrt(nsvcd__dquat_dot(sum, sum)));
}

// How a body turns from a pose to the next, or in a part of that time.
typedef struct nsvcd__slerp {
  // at the poses: unit, on the shorter side
  nsvcd__dquat start, end;
  double half_angle;  // between them as quaternions: half the angle of the turn
  // between the poses, 0 to 1: where the part begins, and its length
  double from, fraction;
} nsvcd__slerp;

// All of the turn from a to b.
static inline nsvcd__slerp nsvcd__slerp_of(const nsvcd_pose *a, const nsvcd_pose *b) {
  const double side = nsvcd__poses_opposed(a, b) ? -1 : 1;
  const nsvcd__dquat start = nsvcd__unit_dpose(a).rotation;
  const nsvcd__dquat end = nsvcd__unit_dpose(b).rotation;
  nsvcd__slerp out = {start, nsvcd__dquat_scale(end, side), 0, 0, 1};
  out.half_angle = nsvcd__dquat_arc(out.start, out.end);
  return out;
}

// The rotation at fraction u of the part, unit.
static inline nsvcd__dquat nsvcd__slerp_at(const nsvcd__slerp *s, double u) {
  const double along = s->from + s->fraction * u;
  return nsvcd__dquat_unit(nsvcd__dquat_along(s->start, s->end, s->half_angle, along));
}

// The rotation vector of the part. Points bend off their chords by an eighth of its square, per
// metre from its axis: a turn by h at a constant rate about a moves a point y with a second
// derivative of h^2 a x (a x y), by the fraction of the turn that has gone by. Along a direction n
// that is h^2 (n x a).(a x y).
static inline nsvcd__d3 nsvcd__slerp_turn(const nsvcd__slerp *slerp) {
  const nsvcd__d3 axis = nsvcd__dquat_turn(slerp->start, slerp->end);
  const double sine = nsvcd__d3_norm(axis);
  const double angle = 2 * slerp->half_angle * slerp->fraction;
  return nsvcd__d3_scale(axis, sine > 0 ? angle / sine : 0);
}

// From a pose's origin s times to its pivot c.
static inline nsvcd__d3 nsvcd__to_pivot(const nsvcd__dpose *pose, nsvcd__d3 c, double s) {
  if (!(nsvcd__d3_dot(c, c) > 0)) return pose->position;
  const nsvcd__dtransform at = nsvcd__dtransform_of(pose);
  return nsvcd__d3_transform(&at, nsvcd__d3_scale(c, s));
}

// The position of a pose's pivot c.
static inline nsvcd__d3 nsvcd__pivot_of(const nsvcd_pose *pose, nsvcd__d3 c) {
  const nsvcd__dpose at = nsvcd__dpose_of(pose);
  return nsvcd__to_pivot(&at, c, 1);
}

// The pose at fraction u between two, with the pivot c.
static inline nsvcd__dpose nsvcd__dpose_between(const nsvcd_pose *a, const nsvcd_pose *b,
                                                nsvcd__d3 c, double u) {
  const nsvcd__slerp s = nsvcd__slerp_of(a, b);
  nsvcd__dpose out = {nsvcd__dquat_along(s.start, s.end, s.half_angle, u),
                      nsvcd__d3_mix(nsvcd__pivot_of(a, c), nsvcd__pivot_of(b, c), u)};
  out.position = nsvcd__to_pivot(&out, c, -1);
  return out;
}
#endif  // NSVCD__HAS_GROUND_MOTIONS

// ----------------------------------------------------------------------------------- ground/memory
#ifndef NSVCD__HAS_GROUND_MEMORY
#define NSVCD__HAS_GROUND_MEMORY
// In: the caller's allocator, or a workspace. Out: arrays from either.

#ifndef NSVCD_NO_ENCODER
static void *nsvcd__alloc(const nsvcd_allocator *allocator, size_t size) {
  return allocator ? allocator->alloc(size, allocator->user) : malloc(size);
}
static void nsvcd__free(const nsvcd_allocator *allocator, void *memory) {
  if (allocator && memory) allocator->free(memory, allocator->user);
  if (!allocator) free(memory);
}
// count * size bytes; NULL also if that overflows.
static void *nsvcd__alloc_array(const nsvcd_allocator *allocator, size_t count, size_t size) {
  return count > SIZE_MAX / size ? NULL : nsvcd__alloc(allocator, count * size);
}

// Arrays that are freed together. `failed` says that there was no memory for one of them: it is
// checked once, after the last.
typedef union nsvcd__header {
  union nsvcd__header *next;
  double aligned;
} nsvcd__header;
typedef struct nsvcd__arena {
  const nsvcd_allocator *allocator;
  nsvcd__header *last;  // an array follows each
  int failed;
} nsvcd__arena;

static nsvcd__arena nsvcd__arena_of(const nsvcd_allocator *allocator) {
  const nsvcd__arena out = {allocator, NULL, 0};
  return out;
}
static void nsvcd__arena_free(nsvcd__arena *arena) {
  while (arena->last) {
    nsvcd__header *header = arena->last;
    arena->last = header->next;
    nsvcd__free(arena->allocator, header);
  }
}

// Uninitialized memory for an array; NULL if there is none.
static void *nsvcd__arena_room(nsvcd__arena *arena, size_t count, size_t size) {
  nsvcd__header *header = NULL;
  if (count <= (SIZE_MAX - sizeof *header) / size)
    header = (nsvcd__header *)nsvcd__alloc(arena->allocator, sizeof *header + count * size);
  if (!header) {
    arena->failed = 1;
    return NULL;
  }
  header->next = arena->last;
  arena->last = header;
  return header + 1;
}

// An array of zeros; NULL without memory.
#define NSVCD__TAKE(arena, type, count) ((type *)nsvcd__arena_take(arena, count, sizeof(type)))
static void *nsvcd__arena_take(nsvcd__arena *arena, size_t count, size_t size) {
  void *array = nsvcd__arena_room(arena, count, size);
  return array ? memset(array, 0, count * size) : NULL;
}

// Memory in place of an array (NULL: none), whose first `used` bytes it keeps; without memory the
// array stays.
static void *nsvcd__arena_grow(nsvcd__arena *arena, void *old, size_t used, size_t count,
                               size_t size) {
  nsvcd__header **at = &arena->last;
  void *larger = nsvcd__arena_room(arena, count, size);
  if (!larger || !old) return larger;
  memcpy(larger, old, used);
  while ((void *)(*at + 1) != old) at = &(*at)->next;
  nsvcd__header *header = *at;
  *at = header->next;
  nsvcd__free(arena->allocator, header);
  return larger;
}
#endif

// The next array of a workspace, or, if base is NULL, only counts its bytes: in 64 bits, because a
// 32-bit machine may not be able to address them.
static void *nsvcd__take(char *base, uint64_t *used, size_t rows, size_t row_size) {
  void *at = base ? base + *used : NULL;
  const uint64_t bytes = (uint64_t)rows * row_size;
  *used += (bytes + NSVCD_ALIGNMENT - 1) / NSVCD_ALIGNMENT * NSVCD_ALIGNMENT;
  return at;
}
#define NSVCD__TAKE_ROWS(type, rows, base, used) \
  ((type *)nsvcd__take(base, used, rows, sizeof(type)))
#endif  // NSVCD__HAS_GROUND_MEMORY

// ============================================================== world: one body against all others

// ------------------------------------------------------------------------------------- world/boxes
// In: a body, and the poses of its way. Out: a box in the world that holds all of it on that way.

// relative errors of floats, of poses and of boxes
#define NSVCD__BOX_ROUNDING 1e-6

// A body's box in its frame, and how far its points are from its pivot at most; scaled, with its
// convex radius.
typedef struct nsvcd__shape_box {
  nsvcd__d3 centre, half, pivot;
  double reach;
} nsvcd__shape_box;

static nsvcd__shape_box nsvcd__shape_box_of(const nsvcd_mover *mover) {
  const nsvcd_body_facts facts = nsvcd_body_describe(mover->body);
  const double scale = mover->scale > 0 ? (double)mover->scale : 1;
  const nsvcd__d3 low = nsvcd__d3_load(facts.low);
  const nsvcd__d3 high = nsvcd__d3_load(facts.high);
  const double more = (double)facts.convex_radius + (double)facts.quantization_error;
  const nsvcd__d3 around = nsvcd__d3_of(more, more, more);
  nsvcd__shape_box out;
  out.centre = nsvcd__d3_scale(nsvcd__d3_add(low, high), 0.5 * scale);
  out.half = nsvcd__d3_fma(0.5, nsvcd__d3_sub(high, low), around);
  out.half = nsvcd__d3_scale(out.half, scale);
  out.pivot = nsvcd__d3_scale(nsvcd__d3_load(mover->pivot), scale);
  const nsvcd__d3 to_centre = nsvcd__d3_sub(out.centre, out.pivot);
  const nsvcd__d3 away = nsvcd__d3_of(fabs(to_centre.x), fabs(to_centre.y), fabs(to_centre.z));
  out.reach = nsvcd__d3_norm(nsvcd__d3_add(away, out.half));
  return out;
}

static nsvcd__box nsvcd__box_over(nsvcd__box a, nsvcd__box b) {
  const nsvcd__box out = {nsvcd__f3_min(a.low, b.low), nsvcd__f3_max(a.high, b.high)};
  return out;
}

static int nsvcd__boxes_meet(const nsvcd__box *a, const nsvcd__box *b) {
  return !nsvcd__f3_exceeds(a->low, b->high) && !nsvcd__f3_exceeds(b->low, a->high);
}

static nsvcd__box nsvcd__box_around(nsvcd__box box, double by) {
  const float more = nsvcd__above(by);
  const nsvcd__f3 around = nsvcd__f3_of(more, more, more);
  const nsvcd__box out = {nsvcd__f3_sub(box.low, around), nsvcd__f3_add(box.high, around)};
  return out;
}

// The box of a pose, larger by `more`.
static nsvcd__box nsvcd__box_of_pose(const nsvcd__shape_box *shape, const nsvcd_pose *pose,
                                     double more) {
  const nsvcd__dpose at = nsvcd__dpose_of(pose);
  const nsvcd__dtransform place = nsvcd__dtransform_of(&at);
  const nsvcd__dmat3 *r = &place.rotation;
  const nsvcd__d3 h = shape->half;
  const nsvcd__d3 centre = nsvcd__d3_transform(&place, shape->centre);
  const double size =
      nsvcd__d3_norm(at.position) + nsvcd__d3_norm(shape->pivot) + shape->reach;
  more += NSVCD__BOX_ROUNDING * size;
  const nsvcd__d3 half =
      nsvcd__d3_of(fabs(r->x.x) * h.x + fabs(r->x.y) * h.y + fabs(r->x.z) * h.z + more,
                   fabs(r->y.x) * h.x + fabs(r->y.y) * h.y + fabs(r->y.z) * h.z + more,
                   fabs(r->z.x) * h.x + fabs(r->z.y) * h.y + fabs(r->z.z) * h.z + more);
  const nsvcd__box out = {nsvcd__d3_narrow(nsvcd__d3_sub(centre, half)),
                          nsvcd__d3_narrow(nsvcd__d3_add(centre, half))};
  return out;
}

// The box of a way. Where it turns by an angle h, a point leaves the chord between two poses by no
// more than an eighth of h squared, per metre from the pivot.
static nsvcd__box nsvcd__box_of_way(const nsvcd__shape_box *shape, const nsvcd_pose *poses,
                                    size_t count, double more) {
  nsvcd__box out = nsvcd__box_of_pose(shape, &poses[0], more);
  for (size_t k = 1; k < count; k++) {
    const double turn = 2 * nsvcd__slerp_of(&poses[k - 1], &poses[k]).half_angle;
    const double bend = 0.126 * turn * turn * shape->reach;
    const nsvcd__box from = nsvcd__box_of_pose(shape, &poses[k - 1], more + bend);
    const nsvcd__box to = nsvcd__box_of_pose(shape, &poses[k], more + bend);
    out = nsvcd__box_over(out, nsvcd__box_over(from, to));
  }
  return out;
}

// Is a turn so near to half a turn that rounding may decide which way it goes?
static int nsvcd__is_half_turn(const nsvcd_pose *poses, size_t count) {
  return count > 1 && nsvcd__slerp_of(&poses[0], &poses[1]).half_angle > 1.5;
}

// A pose as it is seen from a frame.
static nsvcd_pose nsvcd__seen_from(const nsvcd_pose *frame, const nsvcd_pose *pose) {
  const nsvcd__dpose from = nsvcd__unit_dpose(frame);
  const nsvcd__dpose at = nsvcd__unit_dpose(pose);
  const nsvcd__dtransform place = nsvcd__dtransform_of(&from);
  nsvcd__dpose out;
  out.rotation = nsvcd__dquat_mul(nsvcd__dquat_inverse(from.rotation), at.rotation);
  out.position =
      nsvcd__dmat3_apply_transpose(&place.rotation, nsvcd__d3_sub(at.position, from.position));
  return nsvcd__dpose_round(&out);
}

// Do the boxes of a way of one or two poses, larger by `more`, and of a body at rest meet in a
// frame? A line is one, and a slerp is one, in any frame that does not move.
static int nsvcd__boxes_meet_in(const nsvcd_pose *frame, const nsvcd__shape_box *shape,
                                const nsvcd_pose *poses, size_t count, double more,
                                const nsvcd__shape_box *other, const nsvcd_pose *at) {
  const nsvcd_pose there = nsvcd__seen_from(frame, at);
  nsvcd_pose way[2];
  for (size_t k = 0; k < count; k++) way[k] = nsvcd__seen_from(frame, &poses[k]);
  const nsvcd__box a = nsvcd__box_of_way(shape, way, count, more);
  const nsvcd__box b = nsvcd__box_of_pose(other, &there, 0);
  return nsvcd__boxes_meet(&a, &b);
}

// -------------------------------------------------------------------------------------- world/tree
// In: boxes, each with a number from 1 on. Out: a tree in which those that meet a box are found.
//
// A leaf's node has the number of its box. A box is put beside the one where the boxes above grow
// least (Catto, Dynamic bounding volume hierarchies, 2019), and on the way up from there a node
// takes over a child of its sibling's where that makes boxes smaller, so that the tree stays good
// in whatever order boxes come. A box in the tree is larger than what it is about, so that what
// moves a little stays where it is.

typedef struct nsvcd__branch {
  nsvcd__box box;
  // 0: the root has none. The next free node of those that are not used
  uint32_t parent;
  // 0: a leaf
  uint32_t child[2];
} nsvcd__branch;

typedef struct nsvcd__box_tree {
  // (2 most): from 1 to most leaves, and from most + 1 on the others
  nsvcd__branch *nodes;
  uint32_t most, root, unused;
} nsvcd__box_tree;

static void nsvcd__tree_begin(nsvcd__box_tree *tree, nsvcd__branch *nodes, uint32_t most) {
  tree->nodes = nodes;
  tree->most = most;
  tree->root = 0;
  tree->unused = most > 1 ? most + 1 : 0;
  for (uint32_t n = most + 1; n < 2 * most; n++)
    nodes[n].parent = n + 1 < 2 * most ? n + 1 : 0;
}

// The first node after n, and all below it, in the tree's order; 0: there is none.
static uint32_t nsvcd__tree_skip(const nsvcd__box_tree *tree, uint32_t n) {
  while (tree->nodes[n].parent) {
    const nsvcd__branch *parent = &tree->nodes[tree->nodes[n].parent];
    if (parent->child[0] == n) return parent->child[1];
    n = tree->nodes[n].parent;
  }
  return 0;
}

// The next leaf, after leaf `at` or, if that is 0, the first, whose box meets another one; 0: there
// is none. The tree may not change in between.
static uint32_t nsvcd__tree_next(const nsvcd__box_tree *tree, uint32_t at,
                                 const nsvcd__box *box) {
  uint32_t n = at ? nsvcd__tree_skip(tree, at) : tree->root;
  while (n) {
    const nsvcd__branch *node = &tree->nodes[n];
    const int meets = nsvcd__boxes_meet(&node->box, box);
    if (meets && !node->child[0]) return n;
    n = meets ? node->child[0] : nsvcd__tree_skip(tree, n);
  }
  return 0;
}

// Half the area of a box.
static float nsvcd__box_area(nsvcd__box box) {
  const nsvcd__f3 size = nsvcd__f3_sub(box.high, box.low);
  return size.x * (size.y + size.z) + size.y * size.z;
}

static void nsvcd__tree_hang(nsvcd__box_tree *tree, uint32_t parent, int side, uint32_t n) {
  tree->nodes[n].parent = parent;
  if (parent) tree->nodes[parent].child[side] = n;
  if (!parent) tree->root = n;
}

static nsvcd__box nsvcd__box_of_children(const nsvcd__box_tree *tree,
                                         const nsvcd__branch *node) {
  return nsvcd__box_over(tree->nodes[node->child[0]].box, tree->nodes[node->child[1]].box);
}

// Exchanges a child of node n's with a child of the other one's, if the box of that gets smaller.
static void nsvcd__tree_rotate(nsvcd__box_tree *tree, uint32_t n) {
  nsvcd__branch *node = &tree->nodes[n];
  float most = 0;
  int best = 0;
  for (int k = 0; k < 4;
       k++) {  // child k / 2 goes below the other, in place of its child k % 2
    const nsvcd__branch *other = &tree->nodes[node->child[1 - k / 2]];
    if (!other->child[0]) continue;
    const nsvcd__box stays = tree->nodes[other->child[1 - k % 2]].box;
    const nsvcd__box comes = tree->nodes[node->child[k / 2]].box;
    const nsvcd__box box = nsvcd__box_over(stays, comes);
    const float gained = nsvcd__box_area(other->box) - nsvcd__box_area(box);
    if (gained > most) best = k;
    most = fmaxf(most, gained);
  }
  if (!(most > 0)) return;
  const uint32_t low = node->child[best / 2];
  const uint32_t other = node->child[1 - best / 2];
  const uint32_t high = tree->nodes[other].child[best % 2];
  nsvcd__tree_hang(tree, other, best % 2, low);
  nsvcd__tree_hang(tree, n, best / 2, high);
  tree->nodes[other].box = nsvcd__box_of_children(tree, &tree->nodes[other]);
}

// Makes the boxes from node n up to the root what they are to be.
static void nsvcd__tree_refit(nsvcd__box_tree *tree, uint32_t n) {
  for (; n; n = tree->nodes[n].parent) {
    nsvcd__tree_rotate(tree, n);
    tree->nodes[n].box = nsvcd__box_of_children(tree, &tree->nodes[n]);
  }
}

static void nsvcd__tree_insert(nsvcd__box_tree *tree, uint32_t leaf, nsvcd__box box) {
  nsvcd__branch *nodes = tree->nodes;
  uint32_t beside = tree->root;
  nodes[leaf].box = box;
  nodes[leaf].child[0] = nodes[leaf].child[1] = 0;
  if (!tree->root) {
    nsvcd__tree_hang(tree, 0, 0, leaf);
    return;
  }
  // Down, as long as a new node above a child costs less than one here.
  while (nodes[beside].child[0]) {
    float costs[2];
    const float here = nsvcd__box_area(nsvcd__box_over(nodes[beside].box, box));
    const float grows = here - nsvcd__box_area(nodes[beside].box);
    for (int k = 0; k < 2; k++) {
      const nsvcd__branch *child = &nodes[nodes[beside].child[k]];
      costs[k] = grows + nsvcd__box_area(nsvcd__box_over(child->box, box));
      if (child->child[0]) costs[k] -= nsvcd__box_area(child->box);
    }
    if (here < costs[0] && here < costs[1]) break;
    beside = nodes[beside].child[costs[1] < costs[0]];
  }
  const uint32_t above = tree->unused;
  const uint32_t parent = nodes[beside].parent;
  tree->unused = nodes[above].parent;
  nsvcd__tree_hang(tree, parent, parent && nodes[parent].child[1] == beside, above);
  nsvcd__tree_hang(tree, above, 0, beside);
  nsvcd__tree_hang(tree, above, 1, leaf);
  nsvcd__tree_refit(tree, above);
}

static void nsvcd__tree_remove(nsvcd__box_tree *tree, uint32_t leaf) {
  nsvcd__branch *nodes = tree->nodes;
  const uint32_t above = nodes[leaf].parent;
  if (!above) {
    tree->root = 0;
    return;
  }
  const uint32_t parent = nodes[above].parent;
  const uint32_t sibling = nodes[above].child[nodes[above].child[0] == leaf];
  nsvcd__tree_hang(tree, parent, parent && nodes[parent].child[1] == above, sibling);
  nodes[above].parent = tree->unused;
  tree->unused = above;
  nsvcd__tree_refit(tree, parent);
}

// ------------------------------------------------------------------------------------- world/world
// In: bodies at their places. Out: a world of them; who may meet whom.

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

// --------------------------------------------------------------------------------------- world/ask
// In: a question about a mover and all that it comes near. Out: one answer.
//
// Each body that is near is asked about by itself. The earliest of their times is the answer's, and
// up to there all of them are free. The pose at that time, as it is in floats, may be off the way
// by a few units of their last place: so it is asked about once more, of the others.
//
// With a slop each body's answer has a push-out of its own. One that is as long along each of these
// as that one is deep satisfies all, and nearly the shortest is found by projections (Agmon 1954).
// The way displaced by it is then asked about without a slop: what is proven is proven of that way.

// bodies whose push-outs are joined, at most
#define NSVCD__MOST_TOUCHED 32
// how often the safe pose moves back, each time twice as far
#define NSVCD__BACK 8

// Someone who asks: the mover, where it goes, and memory.
typedef struct nsvcd__asker {
  const nsvcd_world *world;
  // whose b is filled in for each body
  nsvcd_question question;
  size_t self;
  uint32_t groups, passes;
  int with_sensors;
  // 1: of bodies that are driven alone
  int of_driven;
  nsvcd__shape_box shape;
  // what its way may come near, and how near, metres
  nsvcd__box box;
  double apart;
  // driven bodies are asked about from this part of the frame on, as is the mover; or only then
  double since;
  int at_once;
  nsvcd_pose driven[2];
  void *workspace;
  size_t workspace_size;
  size_t questions, work;
  nsvcd_result result;
} nsvcd__asker;

// Turns to other poses of the mover.
static void nsvcd__asker_goes(nsvcd__asker *q, const nsvcd_pose *poses, size_t count) {
  q->apart =
      (double)q->question.clearance + (double)q->question.tolerance + (double)q->question.slop;
  q->question.a.poses = poses;
  q->question.a.count = count;
  q->box = nsvcd__box_of_way(&q->shape, poses, count, q->apart);
}

// Where a body is in the part of the frame that is asked about: writes its poses and how many.
static void nsvcd__asker_sees(nsvcd__asker *q, const nsvcd__resident *r, nsvcd_mover *mover) {
  *mover = nsvcd__mover_of(r);
  if (!r->is_driven) return;
  q->driven[0] = r->given.pose;
  q->driven[1] = r->to;
  if (q->since > 0) {
    const nsvcd__dpose at =
        nsvcd__dpose_between(&r->given.pose, &r->to, r->shape.pivot, q->since);
    q->driven[0] = nsvcd__dpose_round(&at);
  }
  mover->poses = q->driven;
  mover->count = q->at_once ? 1 : 2;
}

// May the mover, whose box meets that of a body, meet the body, as boxes in the frames of both
// tell? Where it turns half around, rounding decides which way.
static int nsvcd__asker_may_meet(const nsvcd__asker *q, const nsvcd__resident *r) {
  const nsvcd_mover *a = &q->question.a;
  const nsvcd_pose *at = &r->given.pose;
  if (r->is_driven || a->count > 2 || nsvcd__is_half_turn(a->poses, a->count)) return 1;
  return nsvcd__boxes_meet_in(at, &q->shape, a->poses, a->count, q->apart, &r->shape, at) &&
         nsvcd__boxes_meet_in(&a->poses[0], &q->shape, a->poses, a->count, q->apart, &r->shape,
                              at);
}

// The next body that the mover may meet after body `at`, or the first if that is 0; 0: none.
static uint32_t nsvcd__asker_next(const nsvcd__asker *q, uint32_t at) {
  const nsvcd_world *world = q->world;
  while ((at = nsvcd__tree_next(&world->tree, at, &q->box)) != 0) {
    const nsvcd__resident *r = &world->residents[at];
    if (at == q->self || (r->given.sensor && !q->with_sensors)) continue;
    if (q->of_driven && !r->is_driven) continue;
    if (!nsvcd__groups_meet(q->groups, q->passes, &r->given)) continue;
    if (nsvcd__boxes_meet(&q->box, &r->box) && nsvcd__asker_may_meet(q, r)) return at;
  }
  return 0;
}

// Asks about one body. 0: it was refused.
static int nsvcd__ask_about(nsvcd__asker *q, uint32_t id, nsvcd_answer *answer) {
  nsvcd__asker_sees(q, &q->world->residents[id], &q->question.b);
  if (!q->result)
    q->result = nsvcd_sweep(&q->question, q->workspace, q->workspace_size, answer);
  if (q->result) return 0;
  q->questions++;
  q->work += answer->work;
  return 1;
}

// The same by a copy of an asker that asks something else: the question counts as the asker's.
static int nsvcd__ask_for(nsvcd__asker *asked, nsvcd__asker *copy, uint32_t id,
                          nsvcd_answer *answer) {
  const int is_answered = nsvcd__ask_about(copy, id, answer);
  asked->questions = copy->questions;
  asked->work = copy->work;
  asked->result = copy->result;
  return is_answered;
}

// Makes a question an asker's. The mover may be without poses: then it is where it is in the world.
static nsvcd_result nsvcd__asker_begin(const nsvcd_world *world,
                                       const nsvcd_world_question *asked, void *workspace,
                                       size_t size, nsvcd__asker *q) {
  static const nsvcd_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  static const nsvcd_pose elsewhere = {{1, 0, 0}, {0, 0, 0, 1}};
  const nsvcd_question *given = &asked->question;
  const nsvcd__resident *self = nsvcd__resident_of(world, asked->self);
  memset(q, 0, sizeof *q);
  if (asked->self != NSVCD_NOBODY && !self) return NSVCD_ERROR_INDEX;
  if (given->b.body || given->b.poses || (!self && !given->a.body))
    return NSVCD_ERROR_ARGUMENT;
  if (given->method != NSVCD_METHOD_DEFAULT && given->method != NSVCD_METHOD_PROOF)
    return NSVCD_ERROR_METHOD;
  q->world = world;
  q->question = *given;
  q->question.method = NSVCD_METHOD_PROOF;
  q->self = asked->self;
  q->groups = self ? self->given.groups : asked->groups ? asked->groups : 1;
  q->passes = self ? self->given.passes : asked->passes;
  q->workspace = workspace;
  q->workspace_size = size;
  nsvcd_mover *a = &q->question.a;
  if (self && !a->body) {
    const nsvcd_mover mover = nsvcd__mover_of(self);
    a->body = mover.body;
    a->scale = mover.scale;
    memcpy(a->pivot, mover.pivot, sizeof a->pivot);
  }
  if (!a->poses && a->count == 0) {
    a->poses = self ? &self->given.pose : &origin;
    a->count = 1;
  }
  // Is the question in order? Beside any other body it would be answered, with a workspace.
  nsvcd_question probe = q->question;
  nsvcd_answer unused;
  probe.b.body = a->body;
  probe.b.poses = &elsewhere;
  probe.b.count = 1;
  const nsvcd_result result = nsvcd_sweep(&probe, NULL, 0, &unused);
  if (result != NSVCD_ERROR_WORKSPACE) return result;
  if (!workspace || size < nsvcd_sweep_workspace_size(NULL)) return result;
  q->shape = nsvcd__shape_box_of(a);
  nsvcd__asker_goes(q, a->poses, a->count);
  return NSVCD_OK;
}

// ---- what is known of all bodies so far

typedef struct nsvcd__tally {
  int is_hit, is_undecided;
  nsvcd_why why;
  nsvcd_range time;
  // which is hit, or undecided, first
  size_t first;
  // the body whose safe pose is the earliest, and that
  size_t safe_by;
  float safe_time;
  nsvcd_pose safe;
  // the contact that this body stops it at, if it has a normal
  nsvcd_contact stop;
} nsvcd__tally;

static nsvcd__tally nsvcd__tally_of(const nsvcd__asker *q) {
  const nsvcd_mover *a = &q->question.a;
  nsvcd__tally out;
  memset(&out, 0, sizeof out);
  out.time.low = out.time.high = out.safe_time = 1;
  out.safe = a->poses[a->count - 1];
  return out;
}

// Is an answer about a contact, or something undecided, that comes before what is known?
static int nsvcd__comes_first(const nsvcd__tally *t, const nsvcd_answer *answer) {
  const int is_hit = answer->verdict == NSVCD_HIT;
  if (is_hit != t->is_hit) return is_hit;
  return is_hit ? answer->time.high < t->time.high : answer->time.low < t->time.low;
}

static void nsvcd__tally_add(nsvcd__tally *t, size_t id, const nsvcd_answer *answer) {
  if (answer->verdict == NSVCD_FREE) return;
  if (!t->first || nsvcd__comes_first(t, answer)) t->first = id;
  if (answer->verdict == NSVCD_HIT) {
    t->time.high = t->is_hit ? fminf(t->time.high, answer->time.high) : answer->time.high;
    t->is_hit = 1;
  } else {
    t->is_undecided = 1;
    if (!t->is_hit) t->time.high = HUGE_VALF;
  }
  if (!t->why) t->why = answer->why;
  t->time.low = fminf(t->time.low, answer->time.low);
  if (t->safe_by && answer->safe.time >= t->safe_time) return;
  t->safe_by = id;
  t->safe_time = answer->safe.time;
  t->safe = answer->safe.a;
  t->stop = answer->nearest;
}

// Asks about all bodies; HIT only until one is hit.
static nsvcd__tally nsvcd__ask_all(nsvcd__asker *q) {
  nsvcd__tally t = nsvcd__tally_of(q);
  for (uint32_t id = 0; (id = nsvcd__asker_next(q, id)) != 0;) {
    nsvcd_answer answer;
    if (!nsvcd__ask_about(q, id, &answer)) return t;
    nsvcd__tally_add(&t, id, &answer);
    if (t.is_hit && q->question.ask == NSVCD_ASK_HIT) break;
  }
  return t;
}

// ---- one push-out of all

// Nearly the shortest push-out that is so long along each normal; 0 if none is found.
static nsvcd__d3 nsvcd__join_push_outs(const nsvcd__d3 *normals, const double *depths,
                                       size_t count) {
  nsvcd__d3 out = {0, 0, 0};
  for (int round = 0; round < 64; round++) {
    double most = 0;
    for (size_t k = 0; k < count; k++) {
      const double lacks = depths[k] - nsvcd__d3_dot(out, normals[k]);
      if (!(lacks > 0)) continue;
      most = nsvcd__max(most, lacks / depths[k]);
      out = nsvcd__d3_fma(lacks, normals[k], out);
    }
    if (most <= 0.01) return out;
  }
  return nsvcd__d3_of(0, 0, 0);
}

// The push-out of the mover out of all that it touches at the start, by the question's slop: twice
// that at most, or 0 if there is none.
static nsvcd__d3 nsvcd__push_out_of_all(nsvcd__asker *asked) {
  nsvcd__asker q = *asked;
  nsvcd__d3 normals[NSVCD__MOST_TOUCHED];
  double depths[NSVCD__MOST_TOUCHED];
  size_t count = 0;
  const nsvcd__d3 none = {0, 0, 0};
  const float slop = q.question.slop;
  q.at_once = 1;
  q.question.a.times = NULL;
  nsvcd__asker_goes(&q, q.question.a.poses, 1);
  for (uint32_t id = 0; (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_answer answer;
    if (!nsvcd__ask_for(asked, &q, id, &answer)) return none;
    const nsvcd__d3 push_out = nsvcd__d3_load(answer.push_out);
    const double length = nsvcd__d3_norm(push_out);
    if (answer.depth > slop || count == NSVCD__MOST_TOUCHED) return none;
    if (!(length > 0)) continue;
    normals[count] = nsvcd__d3_scale(push_out, 1 / length);
    depths[count++] = (double)answer.depth + 0.05 * (double)slop;
  }
  const nsvcd__d3 out = nsvcd__join_push_outs(normals, depths, count);
  return nsvcd__d3_norm(out) <= 2 * (double)slop ? out : none;
}

// ---- where the mover may go

// A pose displaced, as it is in floats.
static nsvcd_pose nsvcd__displaced(const nsvcd_pose *pose, nsvcd__d3 by) {
  nsvcd_pose out = *pose;
  const nsvcd__d3 at = nsvcd__d3_add(nsvcd__d3_load(pose->position), by);
  nsvcd__f3_store(nsvcd__f3_round(at), out.position);
  return out;
}

// The pose of a way at a time in [0,1].
static nsvcd_pose nsvcd__pose_on_way(const nsvcd_mover *way, const nsvcd__d3 pivot, double t) {
  const double all = (double)(way->count - 1);
  size_t k = 1;
  if (way->count == 1 || !(t > 0)) return way->poses[0];
  while (k + 1 < way->count && (way->times ? (double)way->times[k] : (double)k / all) < t) k++;
  const double from = way->times ? (double)way->times[k - 1] : (double)(k - 1) / all;
  const double to = way->times ? (double)way->times[k] : (double)k / all;
  const nsvcd__dpose at = nsvcd__dpose_between(&way->poses[k - 1], &way->poses[k], pivot,
                                               nsvcd__min((t - from) / (to - from), 1));
  return nsvcd__dpose_round(&at);
}

// Is the mover free at a pose, or on a way that it goes at once, at a part of the frame, of all
// bodies but one?
static int nsvcd__may_be_at(nsvcd__asker *asked, const nsvcd_pose *way, size_t count,
                            double clearance, double when, size_t but) {
  nsvcd__asker q = *asked;
  q.since = when;
  q.at_once = 1;
  q.question.ask = NSVCD_ASK_HIT;
  q.question.clearance = (float)clearance;
  q.question.to = q.question.to_time = q.question.slop = 0;
  q.question.manifold = 0;
  q.question.a.times = NULL;
  nsvcd__asker_goes(&q, way, count);
  for (uint32_t id = 0; (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_answer answer;
    if (id == but) continue;
    if (!nsvcd__ask_for(asked, &q, id, &answer) || answer.verdict != NSVCD_FREE) return 0;
  }
  return 1;
}

// Moves the safe pose back until it is proven to be free of all as it is in floats.
static void nsvcd__make_safe(nsvcd__asker *q, nsvcd__tally *t) {
  const double clearance = (double)q->question.clearance;
  const nsvcd_mover *way = &q->question.a;
  const nsvcd__f3 size = nsvcd__f3_sub(q->box.high, q->box.low);
  const nsvcd__f3 most = nsvcd__f3_max(q->box.high, nsvcd__f3_scale(q->box.low, -1));
  const double ulps = 1e-6 * (double)nsvcd__f3_norm(most);
  double back = nsvcd__max(1e-6, ulps / (double)nsvcd__f3_norm(size));
  size_t but = t->safe_by;
  for (int k = 0; k < NSVCD__BACK && t->safe_time > 0; k++) {
    const double when = q->since + (double)t->safe_time * (1 - q->since);
    if (nsvcd__may_be_at(q, &t->safe, 1, clearance, when, but)) return;
    t->safe_time = (float)nsvcd__max((double)t->safe_time - back, 0);
    t->safe = nsvcd__pose_on_way(way, q->shape.pivot, (double)t->safe_time);
    back *= 2;
    but = 0;
  }
  t->safe_time = 0;
  t->safe = way->poses[0];
}

// Finds the contacts of the mover, at a pose and at a part of the frame, with all bodies that are
// nearer than `within` metres: `each` of every one, and `most` in all. Returns how many.
static size_t nsvcd__contacts_at(nsvcd__asker *asked, const nsvcd_pose *pose, double when,
                                 float within, size_t each, nsvcd_world_contact *contacts,
                                 size_t most) {
  nsvcd__asker q = *asked;
  size_t count = 0;
  memset(&q.question, 0, sizeof q.question);
  q.question.a = asked->question.a;
  q.question.a.times = NULL;
  q.question.work = asked->question.work;
  q.question.clearance = within;
  q.since = when;
  q.at_once = 1;
  nsvcd__asker_goes(&q, pose, 1);
  for (uint32_t id = 0; count < most && (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_contact found[NSVCD_WORLD_CONTACTS];
    const size_t room = most - count < each ? most - count : each;
    size_t n = 0;
    nsvcd__asker_sees(&q, &q.world->residents[id], &q.question.b);
    if (!q.result)
      q.result =
          nsvcd_contacts(&q.question, q.workspace, q.workspace_size, found, room, &n, NULL);
    if (q.result) break;
    q.questions++;
    for (size_t k = 0; k < n; k++) {
      nsvcd_world_contact *c = &contacts[count++];
      memset(c, 0, sizeof *c);
      c->body = id;
      c->contact = found[k];
    }
  }
  asked->result = q.result;
  asked->questions = q.questions;
  return count;
}

// ---- the answer

// poses that are displaced by a push-out, at most
#define NSVCD__DISPLACED 64

static void nsvcd__tell_all(nsvcd__asker *q, const nsvcd__tally *t, int each,
                            nsvcd_world_answer *out) {
  const nsvcd_question *asked = &q->question;
  const double usual = (double)NSVCD_DEFAULT_TO * q->shape.reach;
  const double to = asked->to > 0 ? (double)asked->to : usual;
  out->verdict = t->is_hit ? NSVCD_HIT : t->is_undecided ? NSVCD_UNDECIDED : NSVCD_FREE;
  out->why = t->why;
  out->body = t->first;
  out->time = t->time;
  out->safe_time = t->safe_time;
  out->safe = t->safe;
  if (asked->ask == NSVCD_ASK_FIRST && t->is_hit) {
    const double when = q->since + (double)t->safe_time * (1 - q->since);
    const float within = asked->clearance + (float)(2 * to);
    out->contact_count =
        nsvcd__contacts_at(q, &t->safe, when, within, each ? NSVCD_WORLD_CONTACTS : 1,
                           out->contacts, NSVCD_WORLD_CONTACTS);
  }
  out->questions = q->questions;
  out->work = q->work;
}

NSVCDDEF nsvcd_result nsvcd_world_sweep(const nsvcd_world *world,
                                        const nsvcd_world_question *question, void *workspace,
                                        size_t workspace_size, nsvcd_world_answer *answer) {
  nsvcd__asker q;
  nsvcd_pose displaced[NSVCD__DISPLACED];
  nsvcd_world_answer out;
  if (!world || !question || !answer) return NSVCD_ERROR_ARGUMENT;
  const uint32_t changes = world->changes;
  const int manifold = question->question.manifold;
  nsvcd_result result = nsvcd__asker_begin(world, question, workspace, workspace_size, &q);
  if (result) return result;
  if (q.question.ask == NSVCD_ASK_DISTANCE) return NSVCD_ERROR_ASK;
  memset(&out, 0, sizeof out);
  q.question.manifold = 0;
  if (q.question.slop > 0) {
    const size_t count = q.question.a.count;
    if (count > NSVCD__DISPLACED) return NSVCD_ERROR_POSES;
    const nsvcd__d3 by = nsvcd__push_out_of_all(&q);
    for (size_t k = 0; k < count; k++)
      displaced[k] = nsvcd__displaced(&q.question.a.poses[k], by);
    nsvcd__f3_store(nsvcd__f3_round(by), out.push_out);
    out.depth = (float)nsvcd__d3_norm(by);
    q.question.slop = 0;
    nsvcd__asker_goes(&q, displaced, count);
  }
  nsvcd__tally t = nsvcd__ask_all(&q);
  if (q.question.ask == NSVCD_ASK_FIRST && t.first) nsvcd__make_safe(&q, &t);
  nsvcd__tell_all(&q, &t, manifold, &out);
  if ((changes & 1) || changes != world->changes) return NSVCD_ERROR_WORLD;
  if (q.result) return q.result;
  *answer = out;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_world_list(const nsvcd_world *world,
                                       const nsvcd_world_question *question, void *workspace,
                                       size_t workspace_size, size_t *ids, size_t most,
                                       size_t *count) {
  nsvcd__asker q;
  size_t found = 0;
  if (!world || !question || !count || (most > 0 && !ids)) return NSVCD_ERROR_ARGUMENT;
  const uint32_t changes = world->changes;
  const nsvcd_result result =
      nsvcd__asker_begin(world, question, workspace, workspace_size, &q);
  if (result) return result;
  if (q.question.ask != NSVCD_ASK_HIT) return NSVCD_ERROR_ASK;
  q.with_sensors = 1;
  for (uint32_t id = 0; (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_answer answer;
    if (!nsvcd__ask_about(&q, id, &answer)) return q.result;
    if (answer.verdict == NSVCD_FREE) continue;
    size_t at = found < most ? found : most;  // sorted, of those the lowest
    for (; at > 0 && ids[at - 1] > id; at--)
      if (at < most) ids[at] = ids[at - 1];
    if (at < most) ids[at] = id;
    found++;
  }
  if ((changes & 1) || changes != world->changes) return NSVCD_ERROR_WORLD;
  *count = found;
  return NSVCD_OK;
}

// ----------------------------------------------------------------------------------- world/respond
// In: a body's speed and the contacts that it has. Out: its speed without what points into them.
//
// Sequential impulses (Catto, Iterative dynamics with temporal coherence, 2006), of one body
// against others that rest or are driven: round after round each contact takes the impulse that its
// own speed asks for, in sum never a pull, and friction up to its share of that. For a body that
// does not turn and has no friction the limit is the speed nearest to the given one that points
// into no contact.
//   A contact that is farther than where the body comes to rest may be approached, as fast as leads
// there in this frame; one that is nearer is left, by a fifth of what is missing in a frame.

// rounds, at most; and the change of an impulse, as a fraction of the greatest, that ends them
#define NSVCD__IMPULSE_ROUNDS 100
#define NSVCD__IMPULSE_SAME 1e-4
// metres a second: what comes slower does not bounce
#define NSVCD__BOUNCES 0.5
#define NSVCD__LEAVES 0.2
#define NSVCD__SOFT 0.2

// A contact as the response sees it.
typedef struct nsvcd__hold {
  // from the body's pivot to its point there; the normal, away from the other body
  nsvcd__d3 arm, normal;
  // the other body's speed there
  nsvcd__d3 speed;
  // metres: how much nearer it is than half a margin beyond the clearance; below 0: farther
  double lacks;
  // metres a second, along the normal: at least; and how fast the body came against it
  double least, into;
  // what a unit impulse along the normal changes: the speed there, and the spin
  double give;
  nsvcd__d3 turn;
  // so far: along the normal, and across it
  double pushed;
  nsvcd__d3 rubbed;
} nsvcd__hold;

// The body that is moved: its speed, and what an impulse changes.
typedef struct nsvcd__thing {
  nsvcd__d3 linear, angular;
  double inverse_mass;
  // about its axes; and where these are
  nsvcd__d3 inverse_inertia;
  nsvcd__dmat3 axes;
  double friction;
} nsvcd__thing;

static nsvcd__d3 nsvcd__spun_by(const nsvcd__thing *thing, nsvcd__d3 moment) {
  nsvcd__d3 own = nsvcd__dmat3_apply_transpose(&thing->axes, moment);
  own.x *= thing->inverse_inertia.x;
  own.y *= thing->inverse_inertia.y;
  own.z *= thing->inverse_inertia.z;
  return nsvcd__dmat3_apply(&thing->axes, own);
}

static nsvcd__d3 nsvcd__speed_at(const nsvcd__thing *thing, nsvcd__d3 arm) {
  return nsvcd__d3_add(thing->linear, nsvcd__d3_cross(thing->angular, arm));
}

// The change of speed at an arm, along a direction, by a unit impulse there; *turn: of its spin.
static double nsvcd__give_of(const nsvcd__thing *thing, nsvcd__d3 arm, nsvcd__d3 along,
                             nsvcd__d3 *turn) {
  const nsvcd__d3 moment = nsvcd__d3_cross(arm, along);
  *turn = nsvcd__spun_by(thing, moment);
  return thing->inverse_mass + nsvcd__d3_dot(moment, *turn);
}

static void nsvcd__push(nsvcd__thing *thing, const nsvcd__hold *hold, double impulse) {
  thing->linear = nsvcd__d3_fma(impulse * thing->inverse_mass, hold->normal, thing->linear);
  thing->angular = nsvcd__d3_fma(impulse, hold->turn, thing->angular);
}

// soft: a fraction of what the contact gives way by to a unit impulse, by which it gives way
// besides. Returns by how much the impulse along the normal has changed.
static double nsvcd__respond_at(nsvcd__thing *thing, nsvcd__hold *hold, double soft) {
  const nsvcd__d3 speed = nsvcd__d3_sub(nsvcd__speed_at(thing, hold->arm), hold->speed);
  const double along = nsvcd__d3_dot(speed, hold->normal);
  const double before = hold->pushed;
  const double lacks = hold->least - along - soft * hold->give * before;
  hold->pushed = nsvcd__max(before + lacks / (hold->give + soft * hold->give), 0);
  const double more = hold->pushed - before;
  nsvcd__push(thing, hold, more);
  if (!(thing->friction > 0) || !(before + hold->pushed > 0)) return fabs(more);
  const nsvcd__d3 now = nsvcd__d3_sub(nsvcd__speed_at(thing, hold->arm), hold->speed);
  const nsvcd__d3 aside = nsvcd__d3_fma(-nsvcd__d3_dot(now, hold->normal), hold->normal, now);
  const double slip = nsvcd__d3_norm(aside);
  if (!(slip > 1e-12)) return fabs(more);
  nsvcd__d3 turn;
  const nsvcd__d3 u = nsvcd__d3_scale(aside, 1 / slip);
  const double across = nsvcd__give_of(thing, hold->arm, u, &turn);
  const double most = thing->friction * hold->pushed;
  nsvcd__d3 rubbed = nsvcd__d3_fma(-slip / across, u, hold->rubbed);
  const double length = nsvcd__d3_norm(rubbed);
  if (length > most) rubbed = nsvcd__d3_scale(rubbed, most / length);
  const nsvcd__d3 rubs = nsvcd__d3_sub(rubbed, hold->rubbed);
  thing->linear = nsvcd__d3_fma(thing->inverse_mass, rubs, thing->linear);
  thing->angular =
      nsvcd__d3_add(thing->angular, nsvcd__spun_by(thing, nsvcd__d3_cross(hold->arm, rubs)));
  hold->rubbed = rubbed;
  return fabs(more);
}

static void nsvcd__respond(nsvcd__thing *thing, nsvcd__hold *holds, size_t count,
                           double soft) {
  double most = 0;
  double change = 1;
  for (size_t k = 0; k < count; k++)
    holds[k].give = nsvcd__give_of(thing, holds[k].arm, holds[k].normal, &holds[k].turn);
  for (int round = 0; round < NSVCD__IMPULSE_ROUNDS && change > NSVCD__IMPULSE_SAME * most;
       round++) {
    change = 0;
    for (size_t k = 0; k < count; k++) {
      change = nsvcd__max(change, nsvcd__respond_at(thing, &holds[k], soft));
      most = nsvcd__max(most, holds[k].pushed);
    }
  }
}

// Joules.
static double nsvcd__energy_of(const nsvcd__thing *thing) {
  const nsvcd__d3 own = nsvcd__dmat3_apply_transpose(&thing->axes, thing->angular);
  const nsvcd__d3 inverse = thing->inverse_inertia;
  double twice = nsvcd__d3_dot(thing->linear, thing->linear) / thing->inverse_mass;
  for (size_t k = 0; k < 3; k++) {
    const double spin = nsvcd__d3_axis(own, k);
    if (nsvcd__d3_axis(inverse, k) > 0) twice += spin * spin / nsvcd__d3_axis(inverse, k);
  }
  return 0.5 * twice;
}

// How fast a body is to go so that it is half a margin off everything: a share of what each contact
// lacks, in a frame. That is no speed that it has, and it does not turn. Contacts are soft: so
// between two walls that are too close for that it goes half way.
static nsvcd__d3 nsvcd__leaving(const nsvcd__hold *holds, size_t count, double seconds) {
  nsvcd__thing out;
  nsvcd__hold left[NSVCD_WORLD_CONTACTS];
  memset(&out, 0, sizeof out);
  out.inverse_mass = 1;
  for (size_t k = 0; k < count; k++) {
    left[k] = holds[k];
    left[k].speed = nsvcd__d3_of(0, 0, 0);
    left[k].least = NSVCD__LEAVES * nsvcd__max(holds[k].lacks, 0) / seconds;
  }
  nsvcd__respond(&out, left, count, NSVCD__SOFT);
  return out.linear;
}

// -------------------------------------------------------------------------------------- world/ways
// In: a body that moves for a frame. Out: its contacts, its speed without what points into them,
// and its way at that speed, as far as it is proven free.
//
// THE LOOP. At a pose, all contacts within twice the margin are known: what points into them is
// taken off the speed before anything is asked. So what rests asks about no way at all, and what
// slides is not stopped by what it slides on. The way that is left is asked about; where it is
// stopped, the body goes to the safe pose, and goes on with what is left of the frame from there.
//
// It comes down to a margin farther than the clearance, and leaves what is nearer than half of
// that: so a way along what it rests on is not stopped by rounding, nor by the bend of a turn.

// defaults: a fraction of the body's reach; rounds; the least cosine of a ground
#define NSVCD__USUAL_CLEARANCE 0.005
#define NSVCD__USUAL_ROUNDS 4
#define NSVCD__USUAL_SLOPE 0.7
// the least cosine of an edge of a step that feet stand on
#define NSVCD__EDGE_SLOPE 0.05
// of the margin: how exact stops are
#define NSVCD__STOPS_WITHIN 0.05
// of the margin: a way in which no point goes farther is none for what rubs against something
#define NSVCD__STILL 0.05
#define NSVCD__MOST_STOPS 4
// of the energy before: more than impulses leave that have not converged
#define NSVCD__BOUNCE_ENERGY 1.001
// radians: the most that a body turns in a way
#define NSVCD__MOST_TURN 2.0

// A slide: what it is told, and what it is about now.
typedef struct nsvcd__slide {
  nsvcd__asker ask;
  const nsvcd_slide_options *given;
  nsvcd_pose pose;
  nsvcd__thing thing;
  // metres; seconds of the frame
  double clearance, margin, seconds;
  // of the frame; and what of it was of no use
  double left, lost;
  // unit, or 0; the least cosine of a ground; and whether it may be an edge of a step in this round
  nsvcd__d3 up;
  double slope;
  int is_on_edge;
  // in the frame before it was on such an edge
  int was_on_edge;
  // it was given a speed upwards
  int jumps;
  // the speed of what it rides on; and the speed besides its own with which it leaves what is near
  nsvcd__d3 ridden, leaves;
  // how high is what it stands on, or its sole, as it begins to climb
  double floor;
  // what its last way met first; or nobody
  size_t met;
  // a character's: of its speed, that is left for the rest of the frame
  double pace;
  // what has stopped it in this frame: contacts that a look may leave out, where many are; and
  // where its pivot was then
  size_t stop_count;
  nsvcd__d3 stopped_at[NSVCD__MOST_STOPS];
  nsvcd_world_contact stops[NSVCD__MOST_STOPS];
  // what pushed in rounds before, and then all that there is at the pose now
  size_t kept, contact_count;
  nsvcd_world_contact contacts[NSVCD_WORLD_CONTACTS];
  nsvcd__hold holds[NSVCD_WORLD_CONTACTS];
  // a contact on which a character stands; or none
  const nsvcd_world_contact *ground;
} nsvcd__slide;

// ---- speeds

static nsvcd__d3 nsvcd__pivot_at(const nsvcd__slide *s) {
  return nsvcd__pivot_of(&s->pose, s->ask.shape.pivot);
}

// How far a point goes with a body, from one of its poses to another.
static nsvcd__d3 nsvcd__moved_along(const nsvcd__dpose *from, const nsvcd_pose *to,
                                    nsvcd__d3 point) {
  const nsvcd__dpose end = nsvcd__dpose_of(to);
  const nsvcd__dtransform now = nsvcd__dtransform_of(from);
  const nsvcd__dtransform then = nsvcd__dtransform_of(&end);
  const nsvcd__d3 own =
      nsvcd__dmat3_apply_transpose(&now.rotation, nsvcd__d3_sub(point, now.position));
  return nsvcd__d3_sub(nsvcd__d3_transform(&then, own), point);
}

// How fast a driven body moves a point that is there now, and goes with it, on average over what is
// left of the frame.
static nsvcd__d3 nsvcd__driven_speed(const nsvcd__slide *s, size_t id, nsvcd__d3 point) {
  const nsvcd__resident *r = &s->ask.world->residents[id];
  if (!r->is_driven || !(s->left > 0)) return nsvcd__d3_of(0, 0, 0);
  const nsvcd__dpose at =
      nsvcd__dpose_between(&r->given.pose, &r->to, r->shape.pivot, 1 - s->left);
  const nsvcd__d3 moved = nsvcd__moved_along(&at, &r->to, point);
  return nsvcd__d3_scale(moved, 1 / (s->left * s->seconds));
}

// How fast what is carried slips along a contact: it has moved already, and only friction sees it.
static nsvcd__d3 nsvcd__slip_of(const nsvcd__resident *r, nsvcd__d3 normal) {
  if (!r->carrier) return nsvcd__d3_of(0, 0, 0);
  return nsvcd__d3_fma(-nsvcd__d3_dot(r->slips, normal), normal, r->slips);
}

// A contact as a body sees it whose pivot is there.
static nsvcd__hold nsvcd__hold_at(const nsvcd_contact *c, nsvcd__d3 pivot) {
  nsvcd__hold out;
  memset(&out, 0, sizeof out);
  out.normal = nsvcd__d3_load(c->normal);
  const nsvcd__d3 own = nsvcd__d3_fma((double)c->gap, out.normal, nsvcd__d3_load(c->point));
  out.arm = nsvcd__d3_sub(own, pivot);
  return out;
}

// Forgets the stops that the body, whose pivot is there now, has left.
static void nsvcd__forget_stops(nsvcd__slide *s, nsvcd__d3 pivot) {
  size_t kept = 0;
  for (size_t k = 0; k < s->stop_count; k++) {
    const nsvcd__d3 gone = nsvcd__d3_sub(pivot, s->stopped_at[k]);
    if (nsvcd__d3_dot(gone, nsvcd__d3_load(s->stops[k].contact.normal)) > s->margin) continue;
    s->stopped_at[kept] = s->stopped_at[k];
    s->stops[kept++] = s->stops[k];
  }
  s->stop_count = kept;
}

// Finds all contacts at the pose now, behind those that have pushed, and what they ask for.
static void nsvcd__slide_look(nsvcd__slide *s) {
  const nsvcd__d3 pivot = nsvcd__pivot_at(s);
  const double time = nsvcd__max(s->left, 1e-3) * s->seconds;
  const float within = (float)(s->clearance + 2 * s->margin);
  double flattest = s->is_on_edge ? NSVCD__EDGE_SLOPE : s->slope;
  size_t kept = 0;
  nsvcd__forget_stops(s, pivot);
  for (size_t k = 0; k < s->contact_count; k++) {
    if (!(s->contacts[k].impulse > 0)) continue;
    s->holds[kept] = s->holds[k];
    s->contacts[kept++] = s->contacts[k];
  }
  s->kept = kept < NSVCD_WORLD_CONTACTS / 2 ? kept : NSVCD_WORLD_CONTACTS / 2;
  const size_t room = NSVCD_WORLD_CONTACTS - s->kept - s->stop_count;
  memcpy(s->contacts + s->kept, s->stops, s->stop_count * sizeof *s->stops);
  nsvcd_world_contact *found = s->contacts + s->kept + s->stop_count;
  s->contact_count =
      s->kept + s->stop_count +
      nsvcd__contacts_at(&s->ask, &s->pose, 1 - s->left, within, room, found, room);
  s->ground = NULL;
  for (size_t k = s->kept; k < s->contact_count; k++) {
    const nsvcd_contact *c = &s->contacts[k].contact;
    nsvcd__hold *h = &s->holds[k];
    *h = nsvcd__hold_at(c, pivot);
    const nsvcd__d3 on_other = nsvcd__d3_load(c->point);
    const nsvcd__d3 driven = nsvcd__driven_speed(s, s->contacts[k].body, on_other);
    h->speed = nsvcd__d3_add(
        driven, nsvcd__slip_of(&s->ask.world->residents[s->contacts[k].body], h->normal));
    h->lacks = s->clearance + 0.5 * s->margin - (double)c->gap;
    h->least = nsvcd__min(s->clearance + s->margin - (double)c->gap, 0) / time;
    const double flat = nsvcd__d3_dot(h->normal, s->up);
    if (flat >= flattest) s->ground = &s->contacts[k];
    flattest = nsvcd__max(flattest, flat);
  }
  const size_t count = s->contact_count - s->kept;
  s->leaves = nsvcd__leaving(s->holds + s->kept, count, s->seconds);
}

// Takes off the speed what points into contacts; what comes fast bounces.
static void nsvcd__slide_respond(nsvcd__slide *s) {
  const size_t count = s->contact_count - s->kept;
  int is_driven = 0;
  for (size_t k = s->kept; k < s->contact_count; k++) {
    nsvcd__hold *h = &s->holds[k];
    const nsvcd__d3 speed = nsvcd__d3_sub(nsvcd__speed_at(&s->thing, h->arm), h->speed);
    h->into = -nsvcd__d3_dot(speed, h->normal);
    is_driven |= s->ask.world->residents[s->contacts[k].body].is_driven;
    if (h->into > NSVCD__BOUNCES)
      h->least = nsvcd__max(h->least, (double)s->given->restitution * h->into);
  }
  const nsvcd__thing came = s->thing;
  nsvcd__respond(&s->thing, s->holds + s->kept, count, 0);
  // bounces at several contacts at once may gain energy: then none bounces
  if (s->given->restitution > 0 && !is_driven &&
      nsvcd__energy_of(&s->thing) > NSVCD__BOUNCE_ENERGY * nsvcd__energy_of(&came)) {
    s->thing = came;
    for (size_t k = s->kept; k < s->contact_count; k++) {
      nsvcd__hold *h = &s->holds[k];
      h->least = nsvcd__min(h->least, 0);
      h->pushed = 0;
      h->rubbed = nsvcd__d3_of(0, 0, 0);
    }
    nsvcd__respond(&s->thing, s->holds + s->kept, count, 0);
  }
  for (size_t k = s->kept; k < s->contact_count; k++)
    s->contacts[k].impulse = (float)s->holds[k].pushed;
}

// ---- ways

// The pose after some seconds at the speed now.
static nsvcd_pose nsvcd__aim(const nsvcd__slide *s, double seconds) {
  const nsvcd__d3 c = s->ask.shape.pivot;
  const nsvcd__d3 w = s->thing.angular;
  const double angle = nsvcd__d3_norm(w) * seconds;
  const double sine = angle > 1e-9 ? nsvcd__sin(0.5 * angle) * seconds / angle : 0.5 * seconds;
  const nsvcd__d3 u = nsvcd__d3_scale(w, sine);
  const nsvcd__dquat turn = {u.x, u.y, u.z, sqrt(nsvcd__max(1 - nsvcd__d3_dot(u, u), 0))};
  nsvcd__dpose out = nsvcd__unit_dpose(&s->pose);
  const nsvcd__d3 pivot = nsvcd__to_pivot(&out, c, 1);
  out.rotation = nsvcd__dquat_mul(turn, out.rotation);
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  const nsvcd__d3 rides = nsvcd__d3_add(s->ridden, s->leaves);
  out.position = nsvcd__d3_fma(seconds, nsvcd__d3_fma(s->pace, own, rides), pivot);
  out.position = nsvcd__to_pivot(&out, c, -1);
  return nsvcd__dpose_round(&out);
}

// Takes the body towards a pose as far as that is proven free, while the rest of the frame goes by,
// or at once. Returns how far, as a fraction.
static double nsvcd__go(nsvcd__slide *s, const nsvcd_pose *to, int at_once) {
  const nsvcd_pose way[2] = {s->pose, *to};
  s->ask.since = 1 - s->left;
  s->ask.at_once = at_once;
  nsvcd__asker_goes(&s->ask, way, 2);
  nsvcd__tally t = nsvcd__ask_all(&s->ask);
  if (t.first && !s->ask.result) nsvcd__make_safe(&s->ask, &t);
  if (s->ask.result) return 0;
  s->met = t.first;
  s->pose = t.safe;
  const float *n = t.stop.normal;
  if (t.safe_by && n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 0.5f && !at_once &&
      s->stop_count < NSVCD__MOST_STOPS) {
    s->stopped_at[s->stop_count] = nsvcd__pivot_at(s);
    s->stops[s->stop_count].body = t.safe_by;
    s->stops[s->stop_count].impulse = 0;
    s->stops[s->stop_count++].contact = t.stop;
  }
  if (!at_once) s->left *= 1 - (double)t.safe_time;
  return (double)t.safe_time;
}

// At once, straight: how far, as a fraction.
static double nsvcd__go_by(nsvcd__slide *s, nsvcd__d3 by) {
  const nsvcd_pose to = nsvcd__displaced(&s->pose, by);
  return nsvcd__go(s, &to, 1);
}

// Does the body, pushed out at once, meet nothing on its way? What it is in contact with as it
// begins it leaves.
static int nsvcd__meets_nothing_else(nsvcd__asker *asked, const nsvcd_pose *way) {
  nsvcd__asker q = *asked;
  q.question.ask = NSVCD_ASK_HIT;
  q.question.clearance = q.question.to = q.question.slop = 0;
  q.at_once = 1;
  nsvcd__asker_goes(&q, way, 2);
  for (uint32_t id = 0; (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_answer answer;
    q.question.a.count = 2;
    if (!nsvcd__ask_for(asked, &q, id, &answer)) return 0;
    if (answer.verdict == NSVCD_FREE) continue;
    q.question.a.count = 1;
    if (!nsvcd__ask_for(asked, &q, id, &answer) || answer.verdict == NSVCD_FREE) return 0;
  }
  return 1;
}

// The body cannot go on: something is within its clearance, or about to come there. It is pushed
// out, to where it rests or else as far as it has to be, by a way on which it meets nothing.
// Returns whether it was.
static int nsvcd__push_off(nsvcd__slide *s) {
  nsvcd__asker q = s->ask;
  q.since = 1 - s->left;
  q.question.a.poses = &s->pose;
  for (int k = 0; k < 2; k++) {
    q.question.clearance = (float)(s->clearance + (k ? 0 : 0.75 * s->margin));
    q.question.slop = 2 * q.question.clearance;
    const nsvcd__d3 by = nsvcd__push_out_of_all(&q);
    const nsvcd_pose way[2] = {s->pose, nsvcd__displaced(&s->pose, by)};
    const int may_go = nsvcd__d3_dot(by, by) > 0 &&
                       nsvcd__may_be_at(&q, &way[1], 1, s->clearance, q.since, 0) &&
                       nsvcd__meets_nothing_else(&q, way);
    s->ask.questions = q.questions;
    s->ask.work = q.work;
    s->ask.result = q.result;
    if (!may_go) continue;
    s->pose = way[1];
    return 1;
  }
  return 0;
}

// Could a driven body come to where the body is?
static int nsvcd__is_driven_near(nsvcd__slide *s) {
  nsvcd__asker_goes(&s->ask, &s->pose, 1);
  for (uint32_t id = 0; (id = nsvcd__asker_next(&s->ask, id)) != 0;)
    if (s->ask.world->residents[id].is_driven) return 1;
  return 0;
}

// Is it a driven body that its last way met first?
static int nsvcd__met_driven(const nsvcd__slide *s) {
  return s->met != NSVCD_NOBODY && s->ask.world->residents[s->met].is_driven;
}

// How far points of the body go in the rest of the frame, at most, metres.
static double nsvcd__travel_left(const nsvcd__slide *s) {
  const double turn = nsvcd__d3_norm(s->thing.angular);
  const double speed =
      nsvcd__d3_norm(nsvcd__d3_add(s->thing.linear, s->leaves)) + turn * s->ask.shape.reach;
  return speed * s->left * s->seconds;
}

// -------------------------------------------------------------------------------------- world/walk
// In: a character that stands, or stood. Out: it walks on grounds, along walls, up and down steps.

static nsvcd__d3 nsvcd__flat_part(const nsvcd__slide *s, nsvcd__d3 a) {
  return nsvcd__d3_fma(-nsvcd__d3_dot(a, s->up), s->up, a);
}

// Has it go with what it stands on.
static void nsvcd__ride(nsvcd__slide *s) {
  if (!s->ground) return;
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  s->ridden = nsvcd__driven_speed(s, s->ground->body, nsvcd__pivot_at(s));
  s->thing.linear = nsvcd__d3_add(own, s->ridden);
}

// What is too steep to stand on is a wall. For whoever stands it is upright; who is in the air
// slides down it, but does not rise by walking into it. An edge that feet stand on is level: it
// bears them, and neither throws them up nor stops them.
static void nsvcd__meet_walls(nsvcd__slide *s) {
  for (size_t k = s->kept; k < s->contact_count; k++) {
    nsvcd__hold *h = &s->holds[k];
    const double rise = nsvcd__d3_dot(h->normal, s->up);
    if (!(rise > 0) || rise >= s->slope) continue;
    if (s->is_on_edge && rise >= NSVCD__EDGE_SLOPE) {
      h->normal = s->up;
      continue;
    }
    const nsvcd__d3 flat = nsvcd__flat_part(s, h->normal);
    const nsvcd__d3 away = nsvcd__d3_scale(flat, 1 / nsvcd__d3_norm(flat));
    const double into = nsvcd__d3_dot(nsvcd__d3_sub(h->speed, s->thing.linear), away);
    if (s->ground) h->normal = away;
    if (!s->ground && into > 0) s->thing.linear = nsvcd__d3_fma(into, away, s->thing.linear);
  }
}

// Whoever stands on a ground does not slide down it, and walks up it as fast as on the level.
static void nsvcd__stand(nsvcd__slide *s) {
  if (s->ground) {
    const nsvcd__d3 n = s->is_on_edge ? s->up : nsvcd__d3_load(s->ground->contact.normal);
    const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
    const int falls = nsvcd__d3_dot(own, s->up) < 0;
    const double steep = nsvcd__d3_dot(n, s->up);
    nsvcd__d3 walks = falls ? nsvcd__flat_part(s, own) : own;
    const double into = -nsvcd__d3_dot(walks, n);
    if (into > 0) walks = nsvcd__d3_fma(into / steep, s->up, walks);
    // down to where it rests, if that is lower
    const double least = falls ? s->holds[s->ground - s->contacts].least / steep : 0;
    s->thing.linear = nsvcd__d3_add(nsvcd__d3_fma(least, s->up, walks), s->ridden);
  }
  nsvcd__meet_walls(s);
}

// How high the lowest corner of its box is.
static double nsvcd__sole(const nsvcd__slide *s) {
  const nsvcd__shape_box *box = &s->ask.shape;
  const nsvcd__dpose at = nsvcd__dpose_of(&s->pose);
  const nsvcd__dtransform place = nsvcd__dtransform_of(&at);
  const nsvcd__d3 up = nsvcd__dmat3_apply_transpose(&place.rotation, s->up);
  const nsvcd__d3 high = nsvcd__d3_of(fabs(up.x), fabs(up.y), fabs(up.z));
  return nsvcd__d3_dot(nsvcd__d3_transform(&place, box->centre), s->up) -
         nsvcd__d3_dot(high, box->half);
}

static double nsvcd__height_of(const nsvcd__slide *s, const nsvcd_world_contact *c) {
  return nsvcd__d3_dot(nsvcd__d3_load(c->contact.point), s->up);
}

// Does it stand, no higher than a step above where it began to climb?
static int nsvcd__is_on_step(const nsvcd__slide *s) {
  return s->ground && nsvcd__height_of(s, s->ground) <= s->floor + (double)s->given->step;
}

// The radius of feet, by a contact so high above their sole: as if they were a ball.
static double nsvcd__ball_of(const nsvcd__slide *s, nsvcd__d3 normal, double high) {
  const double radius = high / (1 - nsvcd__d3_dot(normal, s->up));
  return nsvcd__min(nsvcd__max(radius, 0), s->ask.shape.reach);
}

// Round feet meet the edge of a step long before they are above it. It is one if there is ground,
// no higher than a step, as soon as it is so far below them that it bears them: they come no
// farther where the next edge is before them. A ball's contact tells how far that is, of which the
// feet are taken for a part: at cosines between that of a ground and 1. Moves the body there, or
// wherever it gets to.
static int nsvcd__is_edge_of_step(nsvcd__slide *s, nsvcd__d3 normal, double high) {
  static const double parts[2] = {0.1, 0.5};
  const double step = (double)s->given->step;
  const double gap = 2 * (s->clearance + 2 * s->margin);
  const nsvcd__d3 flat = nsvcd__flat_part(s, normal);
  const double lies = nsvcd__d3_norm(flat);
  const double radius = nsvcd__ball_of(s, normal, high);
  const double risen = step * nsvcd__go_by(s, nsvcd__d3_scale(s->up, step));
  double along = 0;
  for (int k = 0; k < 2; k++) {
    const double bears = s->slope + parts[k] * (1 - s->slope);
    const double by = gap + radius * (lies - sqrt(1 - bears * bears));
    if (nsvcd__go_by(s, nsvcd__d3_scale(flat, (along - by) / lies)) < 1) return 0;
    along = by;
    const nsvcd_pose above = s->pose;
    (void)nsvcd__go_by(s, nsvcd__d3_scale(s->up, -risen - s->margin));
    nsvcd__slide_look(s);
    if (nsvcd__is_on_step(s)) return 1;
    s->pose = above;
  }
  return 0;
}

// Onto a step, or its edge, if there is one: up, along, and down again. What has been gone of the
// way is not gone again.
static void nsvcd__climb(nsvcd__slide *s, const nsvcd_world_contact *before) {
  const double step = (double)s->given->step;
  const nsvcd_pose start = s->pose;
  const double sole = nsvcd__sole(s);
  const nsvcd__d3 normal = nsvcd__d3_load(before->contact.normal);
  const double edge = nsvcd__height_of(s, before);
  s->floor = s->ground ? nsvcd__height_of(s, s->ground) : sole;
  const double time = s->left * s->seconds * s->pace;
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  const nsvcd__d3 way = nsvcd__d3_scale(nsvcd__flat_part(s, own), time);
  const double risen = step * nsvcd__go_by(s, nsvcd__d3_scale(s->up, step));
  const double gone = nsvcd__go_by(s, way);
  const double drop = risen + s->margin;
  const double dropped = drop * nsvcd__go_by(s, nsvcd__d3_scale(s->up, -drop));
  const nsvcd_pose above = s->pose;
  int is_up = dropped < risen - s->margin && gone > 0;
  if (is_up) nsvcd__slide_look(s);
  if (dropped < risen && gone > 0 && !(is_up && nsvcd__is_on_step(s)) &&
      edge <= s->floor + step) {
    s->pose = start;
    is_up = s->is_on_edge = nsvcd__is_edge_of_step(s, normal, edge - sole);
    s->pose = above;
    if (is_up) nsvcd__slide_look(s);
  }
  if (is_up && nsvcd__is_on_step(s)) {
    s->pace *= 1 - gone;
    return;
  }
  s->is_on_edge = 0;
  s->pose = start;
  nsvcd__slide_look(s);
}

// Looks for a ground; or else for the edge of a step that feet have come over, and walk away from.
static void nsvcd__seek_ground(nsvcd__slide *s) {
  const nsvcd__d3 walks = nsvcd__flat_part(s, nsvcd__d3_sub(s->thing.linear, s->ridden));
  s->is_on_edge = 1;
  nsvcd__slide_look(s);
  const nsvcd__d3 n = s->ground ? nsvcd__d3_load(s->ground->contact.normal) : s->up;
  s->is_on_edge = nsvcd__d3_dot(n, s->up) < s->slope;
  if (!s->is_on_edge || nsvcd__d3_dot(walks, n) > 0) return;
  s->is_on_edge = 0;
  s->ground = NULL;
}

// Beyond the edge that feet have come over, is there a ground no lower than a step?
static int nsvcd__leads_down(nsvcd__slide *s) {
  const double step = (double)s->given->step;
  const nsvcd__d3 normal = nsvcd__d3_load(s->ground->contact.normal);
  const double edge = nsvcd__height_of(s, s->ground);
  const nsvcd__d3 flat = nsvcd__flat_part(s, normal);
  const double lies = nsvcd__d3_norm(flat);
  const double radius = nsvcd__ball_of(s, normal, edge - nsvcd__sole(s));
  const double by = 2 * (s->clearance + 2 * s->margin) + radius * (1 - lies);
  const nsvcd_pose here = s->pose;
  (void)nsvcd__go_by(s, nsvcd__d3_scale(flat, by / lies));
  (void)nsvcd__go_by(s, nsvcd__d3_scale(s->up, -step));
  s->is_on_edge = 0;
  nsvcd__slide_look(s);
  const int leads = s->ground && nsvcd__height_of(s, s->ground) >= edge - step;
  s->pose = here;
  s->is_on_edge = leads;
  nsvcd__slide_look(s);
  return leads;
}

// Whoever stood on a ground and walked off it steps down, if there is a ground to step down on, or
// the edge of a step that leads down to one; a margin farther on, if a riser it leaves is too near.
static void nsvcd__step_down(nsvcd__slide *s) {
  const nsvcd_pose above = s->pose;
  const double step = (double)s->given->step;
  const nsvcd__d3 walks = nsvcd__flat_part(s, nsvcd__d3_sub(s->thing.linear, s->ridden));
  const double pace = nsvcd__max(nsvcd__d3_norm(walks), 1e-9);
  for (int k = 0; k < 2; k++) {
    (void)nsvcd__go_by(s, nsvcd__d3_scale(walks, k * s->margin / pace));
    if (nsvcd__go_by(s, nsvcd__d3_scale(s->up, -step)) >= 1) break;
    nsvcd__seek_ground(s);
    if (s->ground && (!s->is_on_edge || nsvcd__leads_down(s))) return;
    s->pose = above;
  }
  s->pose = above;
  s->is_on_edge = 0;
  nsvcd__slide_look(s);
}

// Whoever stood, and did not jump, does not fly off what it walked up: it keeps no speed upwards.
static void nsvcd__stop_climbing(nsvcd__slide *s) {
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  const double up = nsvcd__max(nsvcd__d3_dot(own, s->up), 0);
  if (s->jumps) return;
  s->thing.linear = nsvcd__d3_fma(-up, s->up, s->thing.linear);
}

// The lowest of what is too steep to stand on in the way of whoever stands or is on an edge, or
// none.
static const nsvcd_world_contact *nsvcd__step_before(const nsvcd__slide *s) {
  const nsvcd__d3 walks = nsvcd__flat_part(s, nsvcd__d3_sub(s->thing.linear, s->ridden));
  const nsvcd_world_contact *out = NULL;
  if (!(s->given->step > 0) || s->jumps) return NULL;
  for (size_t k = s->kept; k < s->contact_count; k++) {
    const nsvcd_world_contact *c = &s->contacts[k];
    const nsvcd__d3 n = s->holds[k].normal;
    const double rise = nsvcd__d3_dot(n, s->up);
    const double into = -nsvcd__d3_dot(walks, n);
    if (!s->ground && !(rise > NSVCD__EDGE_SLOPE)) continue;
    if (!(rise > -0.01 && rise < s->slope && into > 0.05 * nsvcd__d3_norm(walks))) continue;
    if (!out || nsvcd__height_of(s, c) < nsvcd__height_of(s, out)) out = c;
  }
  return out;
}

// ------------------------------------------------------------------------------------- world/slide
// In: a body of a world, its speed and a time. Out: it is elsewhere, by a way that is proven free.

static int nsvcd__is_amount(float x) {
  return nsvcd__is_finite(x) && x >= 0 && x <= 1e12f;
}

static nsvcd_result nsvcd__slide_check(const nsvcd_slide_options *o, float seconds,
                                       const nsvcd_velocity *velocity) {
  const float *up = o->up;
  const float square = up[0] * up[0] + up[1] * up[1] + up[2] * up[2];
  if (!nsvcd__is_length(o->clearance) || !nsvcd__is_length(o->margin))
    return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__is_amount(o->mass) || !nsvcd__is_amount(o->friction)) return NSVCD_ERROR_VALUE;
  if (!nsvcd__is_amount(o->restitution) || o->restitution > 1) return NSVCD_ERROR_VALUE;
  if (!nsvcd__is_amount(o->slope) || o->slope > 1) return NSVCD_ERROR_VALUE;
  for (size_t k = 0; k < 3; k++)
    if (!nsvcd__is_amount(o->inertia[k])) return NSVCD_ERROR_VALUE;
  if (!nsvcd__is_finite(square) || (square > 0 && fabsf(square - 1) > 1e-3f))
    return NSVCD_ERROR_AXIS;
  if (!nsvcd__is_length(o->step)) return NSVCD_ERROR_DISTANCE;
  if (!nsvcd__is_finite(seconds) || !(seconds > 0)) return NSVCD_ERROR_TIMES;
  if (!nsvcd__in_range(velocity->linear, 3, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_SPEED;
  if (!nsvcd__in_range(velocity->angular, 3, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_SPEED;
  return NSVCD_OK;
}

// A body as contacts see it: its speed, and what an impulse changes.
static nsvcd__thing nsvcd__thing_of(const nsvcd_slide_options *given, const nsvcd_pose *pose,
                                    const nsvcd_velocity *velocity) {
  const nsvcd__dpose at = nsvcd__dpose_of(pose);
  const float *inertia = given->inertia;
  nsvcd__thing out;
  out.linear = nsvcd__d3_load(velocity->linear);
  out.angular = nsvcd__d3_load(velocity->angular);
  out.inverse_mass = given->mass > 0 ? 1 / (double)given->mass : 1;
  out.inverse_inertia = nsvcd__d3_of(inertia[0] > 0 ? 1 / (double)inertia[0] : 0,
                                     inertia[1] > 0 ? 1 / (double)inertia[1] : 0,
                                     inertia[2] > 0 ? 1 / (double)inertia[2] : 0);
  out.axes = nsvcd__dtransform_of(&at).rotation;
  out.friction = (double)given->friction;
  return out;
}

static double nsvcd__kept_clearance(const nsvcd_slide_options *given, double reach) {
  return given->clearance > 0 ? (double)given->clearance : NSVCD__USUAL_CLEARANCE * reach;
}

static nsvcd_result nsvcd__slide_begin(const nsvcd_world *world, size_t id,
                                       const nsvcd_slide_options *given, float seconds,
                                       void *workspace, size_t size,
                                       const nsvcd_velocity *velocity, nsvcd__slide *s) {
  nsvcd_world_question asked;
  memset(&asked, 0, sizeof asked);
  memset(s, 0, sizeof *s);
  asked.self = id;
  asked.question.ask = NSVCD_ASK_FIRST;
  asked.question.work = given->work ? given->work : NSVCD_DEFAULT_SLIDE_WORK;
  if (!nsvcd__resident_of(world, id)) return NSVCD_ERROR_INDEX;
  nsvcd_result result = nsvcd__slide_check(given, seconds, velocity);
  if (!result) result = nsvcd__asker_begin(world, &asked, workspace, size, &s->ask);
  if (result) return result;
  s->given = given;
  s->pose = world->residents[id].given.pose;
  s->clearance = nsvcd__kept_clearance(given, s->ask.shape.reach);
  s->margin = given->margin > 0 ? (double)given->margin : s->clearance;
  s->seconds = (double)seconds;
  s->left = s->pace = 1;
  s->up = nsvcd__d3_load(given->up);
  s->jumps = nsvcd__d3_dot(nsvcd__d3_load(velocity->linear), s->up) > 0;
  s->slope = given->slope > 0 ? (double)given->slope : NSVCD__USUAL_SLOPE;
  s->ask.question.clearance = (float)s->clearance;
  s->ask.question.to = (float)(NSVCD__STOPS_WITHIN * s->margin);
  s->thing = nsvcd__thing_of(given, &s->pose, velocity);
  return NSVCD_OK;
}

// Does the body, as it is, need no way at all in this frame? If it touches something, a way that
// floats do not show is none.
static int nsvcd__is_still(nsvcd__slide *s, const nsvcd_pose *to) {
  const int touches = s->contact_count > s->kept;
  const int rubs = s->thing.friction > 0 && touches;
  const double most = rubs ? NSVCD__STILL * s->margin : NSVCD__BOX_ROUNDING * s->margin;
  const int is_short =
      nsvcd__travel_left(s) <= most || (touches && !memcmp(to, &s->pose, sizeof *to));
  return is_short && !nsvcd__is_driven_near(s);
}

// Is it the answer of the body's last slide in this world, and not in one before?
static int nsvcd__is_last_slide(const nsvcd_world *world, size_t id,
                                const nsvcd_slide_answer *answer) {
  return answer->slides == world->residents[id].slides;
}

// Does it rest as it did in the frame before: is it told the same, and has nothing moved that it
// was in contact with, or that is near?
static int nsvcd__rests_again(nsvcd__slide *s, float seconds, const nsvcd_velocity *velocity,
                              const nsvcd_slide_answer *before) {
  const nsvcd_world *world = s->ask.world;
  const int is_same = before->rests && nsvcd__is_last_slide(world, s->ask.self, before) &&
                      !memcmp(&before->told, s->given, sizeof before->told) &&
                      !memcmp(&before->given, velocity, sizeof before->given) &&
                      !memcmp(&before->pose, &s->pose, sizeof before->pose) &&
                      !memcmp(&before->seconds, &seconds, sizeof seconds);
  if (!is_same) return 0;
  for (size_t k = 0; k < before->contact_count && k < NSVCD_WORLD_CONTACTS; k++) {
    const nsvcd__resident *r = nsvcd__resident_of(world, before->contacts[k].body);
    if (!r || r->moved > before->clock) return 0;
  }
  s->ask.question.tolerance = (float)(2 * s->margin);
  nsvcd__asker_goes(&s->ask, &s->pose, 1);
  s->ask.question.tolerance = 0;
  for (uint32_t id = 0; (id = nsvcd__asker_next(&s->ask, id)) != 0;) {
    const nsvcd__resident *r = &world->residents[id];
    if (r->is_driven || r->moved > before->clock) return 0;
  }
  return 1;
}

// What rests again meets again what it met before.
static void nsvcd__hold_again(const nsvcd__slide *s, const nsvcd_slide_answer *before,
                              nsvcd__hold *holds) {
  const nsvcd__d3 pivot = nsvcd__pivot_at(s);
  for (size_t k = 0; k < before->contact_count && k < NSVCD_WORLD_CONTACTS; k++) {
    nsvcd__hold *h = &holds[k];
    *h = nsvcd__hold_at(&before->contacts[k].contact, pivot);
    h->into = -nsvcd__d3_dot(nsvcd__speed_at(&s->thing, h->arm), h->normal);
    h->give = nsvcd__give_of(&s->thing, h->arm, h->normal, &h->turn);
    h->pushed = (double)before->contacts[k].impulse;
  }
}

// A round: what is in contact, the speed that is left, and the way at that speed. Returns whether
// there is to be another one.
static int nsvcd__slide_round(nsvcd__slide *s, int is_first, int *rests) {
  nsvcd__thing *thing = &s->thing;
  s->is_on_edge = 0;
  if (s->was_on_edge) nsvcd__seek_ground(s);
  if (!s->was_on_edge) nsvcd__slide_look(s);
  nsvcd__ride(s);
  const nsvcd_world_contact *before = nsvcd__step_before(s);
  if (before) {
    nsvcd__climb(s, before);
    nsvcd__ride(s);
  }
  nsvcd__stand(s);
  nsvcd__slide_respond(s);
  const double turn = nsvcd__d3_norm(thing->angular) * s->left * s->seconds;
  if (turn > NSVCD__MOST_TURN)
    thing->angular = nsvcd__d3_scale(thing->angular, NSVCD__MOST_TURN / turn);
  const nsvcd_pose to = nsvcd__aim(s, s->left * s->seconds);
  if (s->pace >= 1 && nsvcd__is_still(s, &to)) {
    thing->linear = thing->angular = nsvcd__d3_of(0, 0, 0);
    s->left = 0;
    *rests = is_first;
    return 0;
  }
  const double gone = nsvcd__go(s, &to, 0);
  if (s->ask.result || gone >= 1) return 0;
  if (gone > 0 && !nsvcd__met_driven(s)) return 1;
  return nsvcd__push_off(s) || gone > 0;
}

static void nsvcd__tell_slide(nsvcd__slide *s, nsvcd_velocity *velocity,
                              nsvcd_slide_answer *out) {
  const double used = 1 - s->lost;
  out->pose = s->pose;
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  nsvcd__f3_store(nsvcd__f3_round(nsvcd__d3_scale(own, used)), velocity->linear);
  nsvcd__f3_store(nsvcd__f3_round(nsvcd__d3_scale(s->thing.angular, used)), velocity->angular);
  out->spent = (float)used;
  if (s->ground) {
    out->ground = s->ground->body;
    memcpy(out->ground_normal, s->ground->contact.normal, sizeof out->ground_normal);
  }
  out->contact_count = s->contact_count;
  memcpy(out->contacts, s->contacts, s->contact_count * sizeof *s->contacts);
  out->questions = s->ask.questions;
  out->work = s->ask.work;
}

// The rest of the frame goes by without the body. Which driven body comes to it then, or nobody?
static size_t nsvcd__caught_by(nsvcd__slide *s) {
  const double left = s->left;
  const nsvcd_pose stays = s->pose;
  if (!(left > 0) || s->ask.result || !nsvcd__is_driven_near(s)) return NSVCD_NOBODY;
  s->ask.of_driven = 1;
  const double free_until = nsvcd__go(s, &stays, 0);
  s->ask.of_driven = 0;
  s->pose = stays;
  s->left = left;
  return free_until < 1 ? s->met : NSVCD_NOBODY;
}

// Slides, and tells what became of each contact of the answer when the body met it.
static nsvcd_result nsvcd__slide_and_tell(nsvcd_world *world, size_t id,
                                          const nsvcd_slide_options *options, float seconds,
                                          void *workspace, size_t workspace_size,
                                          nsvcd_velocity *velocity, nsvcd_slide_answer *answer,
                                          nsvcd__hold *holds) {
  static const nsvcd_slide_options usual = {0, 0, 0, {0, 0, 0}, 0, 0, {0, 0, 0}, 0, 0, 0, 0};
  nsvcd__slide s;
  nsvcd_slide_answer out;
  if (!world || !velocity || !answer) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_slide_options *given = options ? options : &usual;
  if (world->changes & 1) return NSVCD_ERROR_WORLD;
  nsvcd_result result =
      nsvcd__slide_begin(world, id, given, seconds, workspace, workspace_size, velocity, &s);
  if (result) return result;
  memset(&out, 0, sizeof out);
  out.told = *given;
  out.given = *velocity;
  out.seconds = seconds;
  if (nsvcd__rests_again(&s, seconds, velocity, answer)) {
    nsvcd__hold_again(&s, answer, holds);
    memset(velocity, 0, sizeof *velocity);
    answer->questions = answer->work = 0;
    return NSVCD_OK;
  }
  s.was_on_edge = answer->ground && nsvcd__is_last_slide(world, id, answer) &&
                  nsvcd__d3_dot(nsvcd__d3_load(answer->ground_normal), s.up) < s.slope;
  const size_t rounds = given->rounds ? given->rounds : NSVCD__USUAL_ROUNDS;
  int more = 1;
  int stood = 0;
  for (size_t round = 0; more && s.left > 1e-4; round++) {
    // a driven body that turns is met again and again, and does not wait
    if (round >= (nsvcd__met_driven(&s) ? 4 * rounds : rounds)) break;
    more = nsvcd__slide_round(&s, round == 0, &out.rests);
    if (round == 0) stood = s.ground != NULL;
  }
  out.caught = nsvcd__caught_by(&s);
  if (stood) nsvcd__stop_climbing(&s);
  const double rises = nsvcd__d3_dot(nsvcd__d3_sub(s.thing.linear, s.ridden), s.up);
  s.lost = s.left;
  if (nsvcd__d3_dot(s.up, s.up) > 0 && !s.ask.result && !out.rests) {
    s.left = 0;
    nsvcd__slide_look(&s);
    if (stood && !s.ground && given->step > 0 && rises <= 0) nsvcd__step_down(&s);
  }
  if (s.ask.result) return s.ask.result;
  if (!out.rests) result = nsvcd_world_move(world, id, &s.pose);
  if (result) return result;
  if (!out.rests) world->residents[id].slides++;
  out.clock = world->clock;
  out.slides = world->residents[id].slides;
  nsvcd__tell_slide(&s, velocity, &out);
  memcpy(holds, s.holds, sizeof s.holds);
  *answer = out;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_world_slide(nsvcd_world *world, size_t id,
                                        const nsvcd_slide_options *options, float seconds,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_velocity *velocity, nsvcd_slide_answer *answer) {
  nsvcd__hold holds[NSVCD_WORLD_CONTACTS];
  return nsvcd__slide_and_tell(world, id, options, seconds, workspace, workspace_size,
                               velocity, answer, holds);
}

// ---------------------------------------------------------------------------------- world/momentum
// In: a body that has slid, and the movers that it met. Out: the speeds of all of them, each with
// its part of the momentum.
//
// A slide's impulses are those of a body that meets what rests. Where that is a mover, it takes the
// same impulse the other way, and both are then too fast apart. So, round after round, each contact
// gives back what is too much, until its two bodies leave each other as restitution has them. What
// one gains the other loses: momentum is kept, whether or not the rounds have converged. Contacts
// with all else hold what they held.
//
// Not all movers that are met take part. A body on a pile presses on it by gravity in each frame,
// and if that were handed on, nothing would come to rest: what comes no faster than two frames of
// gravity along the normal, or than twice `quiet`, holds, and so does what has stood for two
// frames, unless the normal is level. Else the crates of a stack, each of which keeps half of what
// it hands down, would do so for ever. For a character only the gravity counts, once.
//
// A slide's friction, and contacts one after the other, may leave more energy in sum than before:
// then of all changes as much is taken back, which keeps the momentum too.

// of a change that would gain energy: less is none
#define NSVCD__LEAST_SHARE 0.05
// the sine of the steepest angle at which a normal is level
#define NSVCD__LEVEL_NORMAL 0.1
// relative: rounding
#define NSVCD__ENERGY_SAME 1e-6

// What is the same for all movers of a step.
typedef struct nsvcd__crowd {
  nsvcd_world *world;
  nsvcd_world_mover *movers;
  size_t count;
  float seconds;
  // what gravity adds to a speed in the frame; and against it, unit, or 0
  nsvcd__d3 falls, up;
  // metres a second, seconds
  double quiet, calm;
} nsvcd__crowd;

// The mover of a body, or NULL.
static nsvcd_world_mover *nsvcd__mover_with(const nsvcd__crowd *crowd, size_t id) {
  const nsvcd__resident *r = nsvcd__resident_of(crowd->world, id);
  nsvcd_world_mover *m = r && r->mover < crowd->count ? &crowd->movers[r->mover] : NULL;
  return m && m->id == id ? m : NULL;
}

static void nsvcd__wake(nsvcd_world_mover *m) {
  m->asleep = 0;
  m->calm = 0;
}

// A contact of the body with something, or with a mover that takes part.
typedef struct nsvcd__encounter {
  nsvcd_world_contact *contact;
  nsvcd__hold own, other;
  // of the movers that take part; or none
  size_t with;
} nsvcd__encounter;

typedef struct nsvcd__momentum {
  nsvcd__thing thing;
  // the speed of the frame in which the body slid
  nsvcd__d3 frame;
  size_t count, met_count;
  nsvcd__encounter encounters[NSVCD_WORLD_CONTACTS];
  // the movers that take part
  nsvcd_world_mover *met[NSVCD_WORLD_CONTACTS];
  nsvcd__thing things[NSVCD_WORLD_CONTACTS];
} nsvcd__momentum;

// A contact as the other body sees it.
static nsvcd__hold nsvcd__hold_of_other(const nsvcd__crowd *crowd, size_t id,
                                        const nsvcd__thing *thing,
                                        const nsvcd_contact *contact) {
  const nsvcd__resident *r = &crowd->world->residents[id];
  const nsvcd__d3 pivot = nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
  nsvcd__hold out;
  memset(&out, 0, sizeof out);
  out.normal = nsvcd__d3_load(contact->normal);
  out.arm = nsvcd__d3_sub(nsvcd__d3_load(contact->point), pivot);
  out.give = nsvcd__give_of(thing, out.arm, out.normal, &out.turn);
  return out;
}

static double nsvcd__speed_along(const nsvcd__thing *thing, const nsvcd__hold *hold) {
  return nsvcd__d3_dot(nsvcd__speed_at(thing, hold->arm), hold->normal);
}

// Does a mover take part in a contact? came: the body before its slide.
static int nsvcd__takes_part(const nsvcd__crowd *crowd, const nsvcd_world_mover *m,
                             const nsvcd__thing *came, const nsvcd__encounter *at) {
  const double falls = fabs(nsvcd__d3_dot(crowd->falls, at->own.normal));
  const double least = m->how.mass > 0 ? 2 * crowd->quiet : 0;
  const double goes = -nsvcd__speed_along(came, &at->own);
  const int is_piled = m->how.mass > 0 && crowd->world->residents[m->id].stood > 1;
  if (is_piled && falls > NSVCD__LEVEL_NORMAL * nsvcd__d3_norm(crowd->falls)) return 0;
  return goes > nsvcd__max(2 * falls, least);
}

// Has any contact with a body pushed?
static int nsvcd__has_pushed(const nsvcd_slide_answer *answer, size_t body) {
  size_t k = 0;
  while (k < answer->contact_count &&
         (answer->contacts[k].body != body || !(answer->contacts[k].impulse > 0)))
    k++;
  return k < answer->contact_count;
}

// Finds the contacts with bodies that pushed in a slide, and who takes part in them. Where one
// corner of a face took all, the others are to have their part; those farther may come nearer.
static void nsvcd__momentum_begin(const nsvcd__crowd *crowd, nsvcd_world_mover *m,
                                  const nsvcd_velocity *velocity, const nsvcd__hold *holds,
                                  nsvcd__momentum *p) {
  const double mass = m->how.mass > 0 ? 1 : (double)m->push_mass;
  const nsvcd_pose *pose = &m->answer.pose;
  nsvcd__thing came = nsvcd__thing_of(&m->how, pose, velocity);
  p->thing = nsvcd__thing_of(&m->how, pose, &m->velocity);
  came.inverse_mass = p->thing.inverse_mass /= mass;
  p->thing.inverse_inertia = nsvcd__d3_over(p->thing.inverse_inertia, mass);
  p->count = p->met_count = 0;
  for (size_t k = 0; k < m->answer.contact_count; k++) {
    nsvcd_world_contact *c = &m->answer.contacts[k];
    nsvcd_world_mover *met = nsvcd__mover_with(crowd, c->body);
    nsvcd__encounter *at = &p->encounters[p->count];
    if (!nsvcd__has_pushed(&m->answer, c->body)) continue;
    at->contact = c;
    at->own = holds[k];
    at->own.give = nsvcd__give_of(&p->thing, at->own.arm, at->own.normal, &at->own.turn);
    at->own.pushed = 0;
    at->own.least = nsvcd__min(nsvcd__speed_along(&p->thing, &at->own), 0);
    at->with = NSVCD_WORLD_CONTACTS;
    p->count++;
    if (!met || !(met->how.mass > 0) || crowd->world->residents[met->id].is_driven) continue;
    if (!nsvcd__takes_part(crowd, m, &came, at)) continue;
    size_t j = 0;
    while (j < p->met_count && p->met[j] != met) j++;
    const nsvcd_pose *there = &crowd->world->residents[met->id].given.pose;
    if (j == p->met_count) {
      p->things[j] = nsvcd__thing_of(&met->how, there, &met->velocity);
      p->things[j].linear = nsvcd__d3_sub(p->things[j].linear, p->frame);
    }
    at->other = nsvcd__hold_of_other(crowd, met->id, &p->things[j], &c->contact);
    const double nears = at->own.into + nsvcd__speed_along(&p->things[j], &at->other);
    const int bounces = nears > NSVCD__BOUNCES;
    const double gap = nsvcd__max(-holds[k].lacks, 0) / (double)crowd->seconds;
    at->own.least = bounces ? (double)m->how.restitution * nears : -gap;
    at->own.pushed = -mass * holds[k].pushed * (double)m->answer.spent;
    at->with = j;
    p->met[j] = met;
    if (j == p->met_count) p->met_count++;
  }
}

// Gives those who take part their impulses, and corrects these. Returns by how much at most.
static double nsvcd__momentum_round(nsvcd__momentum *p, double *most) {
  double change = 0;
  for (size_t k = 0; k < p->count; k++) {
    nsvcd__encounter *at = &p->encounters[k];
    nsvcd__thing *other = at->with < p->met_count ? &p->things[at->with] : NULL;
    const double theirs = other ? nsvcd__speed_along(other, &at->other) : 0;
    const double lacks = at->own.least - nsvcd__speed_along(&p->thing, &at->own) + theirs;
    const double give = at->own.give + (other ? at->other.give : 0);
    const double more = nsvcd__max(lacks / give, -at->own.pushed);
    at->own.pushed += more;
    nsvcd__push(&p->thing, &at->own, more);
    if (other) nsvcd__push(other, &at->other, -more);
    change = nsvcd__max(change, fabs(more));
    *most = nsvcd__max(*most, at->own.pushed);
  }
  return change;
}

static void nsvcd__tell_velocity(const nsvcd__thing *thing, nsvcd_velocity *velocity) {
  const float most = NSVCD_MAX_COORDINATE;
  float *linear = velocity->linear;
  float *angular = velocity->angular;
  nsvcd__f3_store(nsvcd__f3_round(thing->linear), linear);
  nsvcd__f3_store(nsvcd__f3_round(thing->angular), angular);
  for (int k = 0; k < 3; k++) {
    linear[k] = fmaxf(-most, fminf(linear[k], most));
    angular[k] = fmaxf(-most, fminf(angular[k], most));
  }
}

// Joules.
static double nsvcd__energy_of_all(const nsvcd__momentum *p) {
  double out = nsvcd__energy_of(&p->thing);
  for (size_t j = 0; j < p->met_count; j++) out += nsvcd__energy_of(&p->things[j]);
  return out;
}

static void nsvcd__set_velocity(nsvcd__thing *thing, const nsvcd_velocity *velocity) {
  thing->linear = nsvcd__d3_load(velocity->linear);
  thing->angular = nsvcd__d3_load(velocity->angular);
}
// Takes a speed from what it was, in a frame, a share of the way to what it is.
static void nsvcd__share_change(nsvcd__thing *thing, const nsvcd_velocity *was,
                                nsvcd__d3 frame, double share) {
  const nsvcd__thing now = *thing;
  nsvcd__set_velocity(thing, was);
  thing->linear = nsvcd__d3_sub(thing->linear, frame);
  thing->linear = nsvcd__d3_mix(thing->linear, now.linear, share);
  thing->angular = nsvcd__d3_mix(thing->angular, now.angular, share);
}
static void nsvcd__share_all(nsvcd__momentum *p, const nsvcd_velocity *came, double share) {
  nsvcd__share_change(&p->thing, came, nsvcd__d3_of(0, 0, 0), share);
  for (size_t j = 0; j < p->met_count; j++)
    nsvcd__share_change(&p->things[j], &p->met[j]->velocity, p->frame, share);
}

// Takes all changes back as far as there is more energy than before, which is a parabola over the
// share that is left. Returns that.
static double nsvcd__gain_nothing(nsvcd__momentum *p, const nsvcd_velocity *came,
                                  double before) {
  const double after = nsvcd__energy_of_all(p);
  if (!(after > before)) return 1;
  nsvcd__share_all(p, came, 0.5);
  const double square = 2 * (before + after) - 4 * nsvcd__energy_of_all(p);
  const double share = nsvcd__max(1 - (after - before) / square, 0);
  nsvcd__share_all(p, came, 2 * share);
  return share;
}

// A body has slid, and came at a speed, in a frame that moves at another: it and what it met share
// their momentum.
static void nsvcd__share_momentum(const nsvcd__crowd *crowd, nsvcd_world_mover *m,
                                  const nsvcd_velocity *came, nsvcd__d3 frame,
                                  const nsvcd__hold *holds) {
  nsvcd__momentum p;
  double most = 0;
  double change = 1;
  const double mass = m->how.mass > 0 ? 1 : (double)m->push_mass;
  if (!(mass > 0)) return;
  p.frame = frame;
  nsvcd__momentum_begin(crowd, m, came, holds, &p);
  if (p.met_count == 0) return;
  const nsvcd__thing slid = p.thing;
  nsvcd__set_velocity(&p.thing, came);
  const double energy = (1 + NSVCD__ENERGY_SAME) * nsvcd__energy_of_all(&p);
  // what it lost with the rest of the frame it still has to give
  const double lost = 1 - (double)m->answer.spent;
  p.thing.linear = nsvcd__d3_fma(lost, p.thing.linear, slid.linear);
  p.thing.angular = nsvcd__d3_fma(lost, p.thing.angular, slid.angular);
  // what the slide gave is taken back, and found again
  for (size_t k = 0; k < p.count; k++) {
    nsvcd__hold *own = &p.encounters[k].own;
    nsvcd__push(&p.thing, own, own->pushed);
    own->pushed = 0;
  }
  for (int round = 0; round < NSVCD__IMPULSE_ROUNDS && change > NSVCD__IMPULSE_SAME * most;
       round++)
    change = nsvcd__momentum_round(&p, &most);
  const double share = nsvcd__gain_nothing(&p, came, energy);
  if (share < NSVCD__LEAST_SHARE) return;
  nsvcd__tell_velocity(&p.thing, &m->velocity);
  m->answer.rests = 0;
  for (size_t k = 0; k < p.count; k++) {
    const nsvcd__encounter *at = &p.encounters[k];
    const double held = at->with < p.met_count ? 0 : (double)at->contact->impulse;
    at->contact->impulse = (float)(held + share * at->own.pushed / mass);
  }
  for (size_t j = 0; j < p.met_count; j++) {
    p.things[j].linear = nsvcd__d3_add(p.things[j].linear, frame);
    nsvcd__tell_velocity(&p.things[j], &p.met[j]->velocity);
    if (p.met[j]->asleep) nsvcd__wake(p.met[j]);
  }
}

// ------------------------------------------------------------------------------------- world/carry
// In: movers, and what is driven in this frame. Out: whoever stands on something driven, be it by
// way of others, has gone along with it.
//
// As a lift sees it, a stack on it is at rest. So all of it moves in the frame of the lift: first
// it goes along, at the same time as the lift; and when all that is driven has arrived, each slides
// at the speed that it has besides, and gets that of the lift again.
//
// Going along is proven as any way is: against all that rests, and all that is driven or carried
// meanwhile. A mover that is in the way is carried too, as is what a lift comes up into. Who cannot
// go along stays, as does whoever stands on it: they slide while the lift moves, as those do who
// stand on nothing driven.

// radians: what turns by more in a frame carries nobody
#define NSVCD__CARRIES_TURN 0.5
// metres a second: what carries a point as fast as another to this does so as one with it
#define NSVCD__CARRIES_SAME 1e-3
// of the clearance: how near those who are carried may come to what moves with them, by rounding
#define NSVCD__CARRIES_WITHIN 0.5f
// rounds in which those who stay are found; then all stay
#define NSVCD__CARRY_ROUNDS 20

static nsvcd__d3 nsvcd__mover_centre(const nsvcd__crowd *crowd, const nsvcd_world_mover *m) {
  const nsvcd__resident *r = &crowd->world->residents[m->id];
  return nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
}

// How fast a driven body takes a point along that is there now, metres a second; 0: it is not
// driven.
static nsvcd__d3 nsvcd__takes_along(const nsvcd__crowd *crowd, const nsvcd__resident *r,
                                    nsvcd__d3 point) {
  if (!r->is_driven) return nsvcd__d3_of(0, 0, 0);
  const nsvcd__dpose from = nsvcd__dpose_of(&r->given.pose);
  const nsvcd__d3 moved = nsvcd__moved_along(&from, &r->to, point);
  return nsvcd__d3_over(moved, (double)crowd->seconds);
}

// The next body beneath a mover, as it was after its last slide, from contact *n on; or NULL.
static const nsvcd__resident *nsvcd__next_beneath(const nsvcd__crowd *crowd,
                                                  const nsvcd_world_mover *m, size_t *n) {
  while (*n < m->answer.contact_count && *n < NSVCD_WORLD_CONTACTS) {
    const nsvcd_world_contact *c = &m->answer.contacts[(*n)++];
    const nsvcd__resident *r = nsvcd__resident_of(crowd->world, c->body);
    if (r && nsvcd__d3_dot(nsvcd__d3_load(c->contact.normal), crowd->up) > 0.5) return r;
  }
  return NULL;
}

// Which driven body carries a mover; or nobody. Who stands on something else too slides.
static uint32_t nsvcd__carrier_of(const nsvcd__crowd *crowd, const nsvcd_world_mover *m) {
  const nsvcd__resident *all = crowd->world->residents;
  const nsvcd__d3 centre = nsvcd__mover_centre(crowd, m);
  const nsvcd__resident *r;
  nsvcd__d3 goes = {0, 0, 0};
  uint32_t out = all[m->id].joins;
  if (all[m->id].stays || out) return all[m->id].stays ? NSVCD_NOBODY : out;
  for (size_t n = 0; (r = nsvcd__next_beneath(crowd, m, &n)) != NULL;) {
    const uint32_t id = r->carrier ? r->carrier : r->is_driven ? (uint32_t)(r - all) : 0;
    const nsvcd__d3 other = nsvcd__takes_along(crowd, &all[id], centre);
    const double differs = out ? nsvcd__d3_norm(nsvcd__d3_sub(other, goes)) : 0;
    if (!id || differs > NSVCD__CARRIES_SAME) return NSVCD_NOBODY;
    if (!out) goes = other;
    if (!out) out = id;
  }
  return out;
}

// Has a mover go along with a driven body, over the frame as that does; or, with nobody, stay.
static void nsvcd__carry(const nsvcd__crowd *crowd, nsvcd_world_mover *m, uint32_t carrier) {
  nsvcd_world *world = crowd->world;
  nsvcd__resident *r = &world->residents[m->id];
  const nsvcd__resident *by = &world->residents[carrier];
  const nsvcd_pose stays = r->given.pose;
  int goes = carrier != NSVCD_NOBODY;
  if (goes) {
    const nsvcd__slerp slerp = nsvcd__slerp_of(&by->given.pose, &by->to);
    const nsvcd__dpose from = nsvcd__dpose_of(&by->given.pose);
    const nsvcd__d3 turn = nsvcd__slerp_turn(&slerp);
    nsvcd__dpose to = nsvcd__unit_dpose(&stays);
    const nsvcd__dquat by_turn =
        nsvcd__dquat_mul(slerp.end, nsvcd__dquat_inverse(slerp.start));
    to.position = nsvcd__d3_add(to.position, nsvcd__moved_along(&from, &by->to, to.position));
    to.rotation = nsvcd__dquat_mul(by_turn, to.rotation);
    const nsvcd_pose end = nsvcd__dpose_round(&to);
    r->goes = nsvcd__takes_along(crowd, by, nsvcd__mover_centre(crowd, m));
    r->turns = nsvcd__d3_over(turn, (double)crowd->seconds);
    goes = nsvcd__d3_norm(turn) < NSVCD__CARRIES_TURN &&
           !nsvcd__world_place(world, m->id, &end, 1);
    if (m->asleep) nsvcd__wake(m);
  }
  r->stays |= carrier && !goes;
  r->carrier = goes ? carrier : NSVCD_NOBODY;
  if (!goes) (void)nsvcd__world_place(world, m->id, &stays, 0);
}

// Turns a mover into one who asks whether it is free.
static nsvcd_result nsvcd__carried_asker(const nsvcd__crowd *crowd, const nsvcd_world_mover *m,
                                         void *workspace, size_t size, nsvcd__asker *q) {
  const nsvcd__resident *r = &crowd->world->residents[m->id];
  nsvcd_world_question asked;
  memset(&asked, 0, sizeof asked);
  asked.self = m->id;
  asked.question.clearance = (float)nsvcd__kept_clearance(&m->how, r->shape.reach);
  asked.question.work = m->how.work ? m->how.work : NSVCD_DEFAULT_SLIDE_WORK;
  return nsvcd__asker_begin(crowd->world, &asked, workspace, size, q);
}

// What is driven up into a mover where it is lifts it, as what it stands on does; or nobody.
static uint32_t nsvcd__lifter_of(const nsvcd__crowd *crowd, const nsvcd_world_mover *m,
                                 void *workspace, size_t size, nsvcd_step_answer *out) {
  const nsvcd__d3 centre = nsvcd__mover_centre(crowd, m);
  uint32_t found = NSVCD_NOBODY;
  nsvcd__asker q;
  if (nsvcd__carried_asker(crowd, m, workspace, size, &q)) return found;
  for (uint32_t id = 0; !found && (id = nsvcd__asker_next(&q, id)) != 0;) {
    const nsvcd__resident *o = &crowd->world->residents[id];
    const nsvcd__d3 goes = nsvcd__takes_along(crowd, o, centre);
    nsvcd_answer answer;
    if (o->carrier || !(nsvcd__d3_dot(goes, crowd->up) > 0.5 * nsvcd__d3_norm(goes))) continue;
    if (nsvcd__ask_about(&q, id, &answer) && answer.verdict != NSVCD_FREE) found = id;
  }
  out->questions += q.questions;
  out->work += q.work;
  return found;
}

// Is the way on which a mover is carried free? What is known since neither of two has changed is
// not asked again. If it is not, the mover stays, or what it meets is carried too.
static int nsvcd__may_go_along(const nsvcd__crowd *crowd, const nsvcd_world_mover *m,
                               void *workspace, size_t size, nsvcd_step_answer *out) {
  nsvcd__asker q;
  nsvcd_world *world = crowd->world;
  nsvcd__resident *r = &world->residents[m->id];
  const nsvcd_pose way[2] = {r->given.pose, r->to};
  r->stays = nsvcd__carried_asker(crowd, m, workspace, size, &q) != NSVCD_OK;
  if (r->stays) return 0;
  const float clearance = q.question.clearance;
  nsvcd__asker_goes(&q, way, 2);
  int is_free = 1;
  for (uint32_t id = 0; is_free && (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd__resident *o = &world->residents[id];
    const uint64_t moved = r->moved > o->moved ? r->moved : o->moved;
    nsvcd_answer answer;
    if (r->proven >= moved || o->proven >= moved) continue;
    q.question.clearance = o->is_driven ? NSVCD__CARRIES_WITHIN * clearance : clearance;
    is_free = nsvcd__ask_about(&q, id, &answer) && answer.verdict == NSVCD_FREE;
    if (is_free) continue;
    const int may_join = nsvcd__mover_with(crowd, id) && !o->is_driven && !o->stays;
    if (may_join) o->joins = r->carrier;
    r->stays = !may_join;
  }
  if (is_free) r->proven = world->clock;
  out->questions += q.questions;
  out->work += q.work;
  return is_free;
}

// Finds who is carried, by what and how far, and has them go there.
static void nsvcd__carry_all(const nsvcd__crowd *crowd, void *workspace, size_t size,
                             nsvcd_step_answer *out) {
  const nsvcd_world *world = crowd->world;
  int more = 1;
  for (int round = 0; more; round++) {
    more = 0;
    // the lowest first: what it stands on comes before it
    for (size_t k = 0; k < crowd->count; k++) {
      nsvcd_world_mover *m = &crowd->movers[world->turns[k].mover];
      nsvcd__resident *r = &world->residents[m->id];
      if (r->is_driven && !r->carrier) continue;
      r->stays |= round >= NSVCD__CARRY_ROUNDS;
      uint32_t carrier = nsvcd__carrier_of(crowd, m);
      if (!carrier && round == 0)
        carrier = r->joins = nsvcd__lifter_of(crowd, m, workspace, size, out);
      if (carrier != r->carrier) nsvcd__carry(crowd, m, carrier);
    }
    for (size_t k = 0; k < crowd->count; k++) {
      const nsvcd_world_mover *m = &crowd->movers[world->turns[k].mover];
      if (world->residents[m->id].carrier)
        more |= !nsvcd__may_go_along(crowd, m, workspace, size, out);
    }
  }
  for (size_t k = 0; k < crowd->count; k++) {
    nsvcd__resident *r = &world->residents[crowd->movers[k].id];
    const nsvcd_pose to = r->to;
    const nsvcd_world_mover *m = &crowd->movers[k];
    if (!r->carrier) continue;
    (void)nsvcd__world_place(crowd->world, m->id, &to, 0);
    if (!(m->how.mass > 0)) continue;
    r->slips = nsvcd__d3_sub(nsvcd__d3_load(m->velocity.linear), r->goes);
  }
}

static void nsvcd__end_carrying(const nsvcd_world *world) {
  for (uint32_t id = 1; id <= world->count; id++) {
    nsvcd__resident *r = &world->residents[id];
    r->carrier = r->joins = NSVCD_NOBODY;
    r->proven = 0;
    r->stays = 0;
    r->slips = nsvcd__d3_of(0, 0, 0);
  }
}

// Adds to a velocity, so many times, that of what carries a mover.
static void nsvcd__add_carried(const nsvcd__d3 linear, const nsvcd__d3 angular, double times,
                               nsvcd_velocity *velocity) {
  nsvcd__thing thing;
  memset(&thing, 0, sizeof thing);
  thing.linear = nsvcd__d3_fma(times, linear, nsvcd__d3_load(velocity->linear));
  thing.angular = nsvcd__d3_fma(times, angular, nsvcd__d3_load(velocity->angular));
  nsvcd__tell_velocity(&thing, velocity);
}

// -------------------------------------------------------------------------------------- world/step
// In: movers of a world, and a time. Out: a frame of all of them: each has moved, or sleeps.
//
// The lowest moves first: what is to fall on something finds it where it will be. The order is kept
// from frame to frame, in which it hardly changes.

// metres a second; seconds
#define NSVCD__USUAL_QUIET 0.15
#define NSVCD__USUAL_CALM 0.1
// what touches something, and is slower than so many times `quiet`, is nearly quiet
#define NSVCD__NEARLY_QUIET 2.7
// a second: how much of its speed, of its spin, and of both while it is nearly quiet, what touches
// something loses
#define NSVCD__BRAKES_SPEED 0.3
#define NSVCD__BRAKES_SPIN 1.2
#define NSVCD__BRAKES_QUIET 10.0
// who has come by less than this part of the way that it asked for has stood
#define NSVCD__STANDS 0.1

// ---- what is asked for

static nsvcd_result nsvcd__check_mover(const nsvcd__crowd *crowd, size_t k) {
  const nsvcd_world_mover *m = &crowd->movers[k];
  const nsvcd__resident *r = nsvcd__resident_of(crowd->world, m->id);
  nsvcd_velocity falls = m->velocity;
  if (!r || r->mover != k || r->given.fixed) return NSVCD_ERROR_INDEX;
  if (!nsvcd__is_amount(m->push_mass) || !nsvcd__is_amount(m->damping) ||
      !nsvcd__is_amount(m->spin_damping))
    return NSVCD_ERROR_VALUE;
  const nsvcd__d3 then = nsvcd__d3_add(nsvcd__d3_load(falls.linear), crowd->falls);
  nsvcd__f3_store(nsvcd__d3_narrow(then), falls.linear);
  const nsvcd_result result = nsvcd__slide_check(&m->how, crowd->seconds, &m->velocity);
  return result ? result : nsvcd__slide_check(&m->how, crowd->seconds, &falls);
}

// Checks what is asked for, before anything moves. *refused: the body at fault.
static nsvcd_result nsvcd__step_begin(nsvcd_world *world, nsvcd_world_mover *movers,
                                      size_t count, const nsvcd_step_options *options,
                                      float seconds, nsvcd__crowd *crowd, size_t *refused) {
  const float *gravity = options->gravity;
  if (world->changes & 1) return NSVCD_ERROR_WORLD;
  if (!nsvcd__is_finite(seconds) || !(seconds > 0)) return NSVCD_ERROR_TIMES;
  if (!nsvcd__is_amount(options->calm)) return NSVCD_ERROR_TIMES;
  if (!nsvcd__is_amount(options->quiet)) return NSVCD_ERROR_SPEED;
  if (!nsvcd__in_range(gravity, 3, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_VALUE;
  if (count > world->most) return NSVCD_ERROR_INDEX;
  crowd->world = world;
  crowd->movers = movers;
  crowd->count = count;
  crowd->seconds = seconds;
  crowd->falls = nsvcd__d3_scale(nsvcd__d3_load(gravity), (double)seconds);
  crowd->up = nsvcd__d3_unit(nsvcd__d3_scale(crowd->falls, -1), nsvcd__d3_of(0, 0, 0));
  crowd->quiet = options->quiet > 0 ? (double)options->quiet : NSVCD__USUAL_QUIET;
  crowd->calm = options->calm > 0 ? (double)options->calm : NSVCD__USUAL_CALM;
  for (size_t k = 0; k < count; k++) {
    nsvcd__resident *r = nsvcd__resident_of(world, movers[k].id);
    if (r) r->mover = (uint32_t)k;
  }
  for (size_t k = 0; k < count; k++) {
    *refused = movers[k].id;
    const nsvcd_result result = nsvcd__check_mover(crowd, k);
    if (result) return result;
  }
  *refused = NSVCD_NOBODY;
  return NSVCD_OK;
}

// ---- the order

static int nsvcd__comes_before(nsvcd__turn a, nsvcd__turn b) {
  if (a.height < b.height || a.height > b.height) return a.height < b.height;
  return a.mover < b.mover;
}

// Sorts movers by their heights, and those of a height as they are numbered (Shell 1959).
static void nsvcd__sort_turns(const nsvcd__crowd *crowd) {
  nsvcd_world *world = crowd->world;
  nsvcd__turn *turns = world->turns;
  for (size_t k = 0; k < crowd->count && world->turn_count != crowd->count; k++)
    turns[k].mover = (uint32_t)k;
  world->turn_count = (uint32_t)crowd->count;
  for (size_t k = 0; k < crowd->count; k++) {
    const nsvcd__resident *r = &world->residents[crowd->movers[turns[k].mover].id];
    const nsvcd__d3 at = nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
    turns[k].height = (float)-nsvcd__d3_dot(at, crowd->falls);
  }
  for (size_t gap = crowd->count; gap > 1;) {
    gap = gap > 2 ? gap * 5 / 11 : 1;
    for (size_t k = gap; k < crowd->count; k++) {
      const nsvcd__turn turn = turns[k];
      size_t n = k;
      for (; n >= gap && nsvcd__comes_before(turn, turns[n - gap]); n -= gap)
        turns[n] = turns[n - gap];
      turns[n] = turn;
    }
  }
}

// ---- sleep

// Metres a second that no point of a mover exceeds.
static double nsvcd__mover_speed(const nsvcd__crowd *crowd, const nsvcd_world_mover *m) {
  const double spin = nsvcd__d3_norm(nsvcd__d3_load(m->velocity.angular));
  const double speed = nsvcd__d3_norm(nsvcd__d3_load(m->velocity.linear));
  return speed + spin * crowd->world->residents[m->id].shape.reach;
}

// Has a body been moved since a mover's slide, and not by a slide of its own?
static int nsvcd__was_moved(const nsvcd__crowd *crowd, size_t id, uint64_t since) {
  const nsvcd__resident *r = nsvcd__resident_of(crowd->world, id);
  const nsvcd_world_mover *m = nsvcd__mover_with(crowd, id);
  return !r || (r->moved > since && (!m || r->moved > m->answer.clock));
}

// Is there something that a sleeping mover wakes by?
static int nsvcd__is_disturbed(const nsvcd__crowd *crowd, const nsvcd_world_mover *m) {
  const nsvcd_slide_answer *last = &m->answer;
  if (nsvcd__mover_speed(crowd, m) > 0) return 1;
  if (!nsvcd__is_last_slide(crowd->world, m->id, last)) return 1;
  if (last->clock && nsvcd__was_moved(crowd, m->id, last->clock)) return 1;
  for (size_t k = 0; k < last->contact_count && k < NSVCD_WORLD_CONTACTS; k++) {
    const nsvcd_world_mover *other = nsvcd__mover_with(crowd, last->contacts[k].body);
    if (nsvcd__was_moved(crowd, last->contacts[k].body, last->clock)) return 1;
    if (other && other->how.mass > 0 && nsvcd__mover_speed(crowd, other) > crowd->quiet)
      return 1;
  }
  return 0;
}

// Wakes whoever sleeps where something is driven. Returns whether something is.
static int nsvcd__wake_near_driven(const nsvcd__crowd *crowd) {
  nsvcd_world *world = crowd->world;
  int is_driven = 0;
  double within = 0;
  for (size_t k = 0; k < crowd->count; k++) {
    const nsvcd_slide_options *how = &crowd->movers[k].how;
    const double reach = world->residents[crowd->movers[k].id].shape.reach;
    const double clearance = nsvcd__kept_clearance(how, reach);
    const double margin = how->margin > 0 ? (double)how->margin : clearance;
    within = nsvcd__max(within, clearance + 2 * margin);
  }
  for (uint32_t id = 1; id <= world->count; id++) {
    const nsvcd__resident *r = nsvcd__resident_of(world, id);
    if (!r || !r->is_driven) continue;
    is_driven = 1;
    const nsvcd__box box = nsvcd__box_around(r->box, within);
    for (uint32_t n = 0; (n = nsvcd__tree_next(&world->tree, n, &box)) != 0;) {
      nsvcd_world_mover *m = nsvcd__mover_with(crowd, n);
      if (m && m->asleep) nsvcd__wake(m);
    }
  }
  return is_driven;
}

// What was quiet for long enough falls asleep.
static void nsvcd__grow_calm(const nsvcd__crowd *crowd, nsvcd_world_mover *m) {
  const int is_quiet =
      m->answer.contact_count > 0 && nsvcd__mover_speed(crowd, m) < crowd->quiet;
  if (m->asleep || m->sleepless || !(m->how.mass > 0)) return;
  m->calm = is_quiet ? m->calm + crowd->seconds : 0;
  if ((double)m->calm < crowd->calm - 0.5 * (double)crowd->seconds) return;
  m->asleep = 1;
  memset(&m->velocity, 0, sizeof m->velocity);
}

// ---- a frame

// Gives a mover what gravity adds to its speed, less what brakes it, as seen from what it stands
// on.
static void nsvcd__pull_and_brake(const nsvcd__crowd *crowd, nsvcd_world_mover *m) {
  const int is_carried = crowd->world->residents[m->id].carrier != NSVCD_NOBODY;
  const int is_braked = m->answer.contact_count > 0 && m->how.mass > 0 && m->how.friction > 0;
  // a lift that speeds up would hold by brakes what friction does not
  const int is_slow = is_braked && !is_carried &&
                      nsvcd__mover_speed(crowd, m) < NSVCD__NEARLY_QUIET * crowd->quiet;
  const double quiet = is_slow ? NSVCD__BRAKES_QUIET : 0;
  const double speed = is_braked ? nsvcd__max(NSVCD__BRAKES_SPEED, quiet) : 0;
  const double spin = is_braked ? nsvcd__max(NSVCD__BRAKES_SPIN, quiet) : 0;
  const double seconds = (double)crowd->seconds;
  size_t n = 0;
  const nsvcd__resident *beneath = nsvcd__next_beneath(crowd, m, &n);
  nsvcd__d3 goes = {0, 0, 0};
  if (beneath) goes = nsvcd__takes_along(crowd, beneath, nsvcd__mover_centre(crowd, m));
  const nsvcd__d3 linear = nsvcd__d3_add(nsvcd__d3_load(m->velocity.linear), crowd->falls);
  const nsvcd__d3 seen = nsvcd__d3_sub(linear, goes);
  const nsvcd__d3 angular = nsvcd__d3_load(m->velocity.angular);
  nsvcd__thing thing;
  memset(&thing, 0, sizeof thing);
  thing.linear =
      nsvcd__d3_add(goes, nsvcd__d3_over(seen, 1 + seconds * (speed + (double)m->damping)));
  thing.angular = nsvcd__d3_over(angular, 1 + seconds * (spin + (double)m->spin_damping));
  nsvcd__tell_velocity(&thing, &m->velocity);
}

static nsvcd_result nsvcd__step_mover(const nsvcd__crowd *crowd, nsvcd_world_mover *m,
                                      void *workspace, size_t size, nsvcd_step_answer *out) {
  nsvcd__resident *r = &crowd->world->residents[m->id];
  if (m->asleep || r->is_driven) return NSVCD_OK;
  const nsvcd_velocity was = m->velocity;
  const nsvcd__d3 from = nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
  const int is_carried = r->carrier != NSVCD_NOBODY;
  const nsvcd__d3 none = {0, 0, 0};
  // a character's speed is its own already
  const int is_thing = is_carried && m->how.mass > 0;
  const nsvcd__d3 goes = is_carried ? r->goes : none;
  const nsvcd__d3 turns = is_carried ? r->turns : none;
  if (is_thing) nsvcd__add_carried(goes, turns, -1, &m->velocity);
  nsvcd__pull_and_brake(crowd, m);
  nsvcd_velocity came = m->velocity;
  nsvcd__hold holds[NSVCD_WORLD_CONTACTS];
  const nsvcd_result result =
      nsvcd__slide_and_tell(crowd->world, m->id, &m->how, crowd->seconds, workspace, size,
                            &m->velocity, &m->answer, holds);
  if (result) {
    m->velocity = was;
    return result;
  }
  if (is_thing) nsvcd__add_carried(none, turns, 1, &came);
  if (is_thing) nsvcd__add_carried(none, turns, 1, &m->velocity);
  const nsvcd__d3 to = nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
  const double asked = nsvcd__d3_norm(nsvcd__d3_load(came.linear)) * (double)crowd->seconds;
  const int stands = nsvcd__d3_norm(nsvcd__d3_sub(to, from)) < NSVCD__STANDS * asked;
  r->stood = stands ? (r->stood > 0 ? 2 : 1) : 0;
  nsvcd__share_momentum(crowd, m, &came, goes, holds);
  r->slips = is_thing ? nsvcd__d3_load(m->velocity.linear) : none;
  if (is_thing) nsvcd__add_carried(goes, none, 1, &m->velocity);
  out->awake++;
  out->caught += m->answer.caught != NSVCD_NOBODY;
  out->contacts += m->answer.contact_count;
  out->questions += m->answer.questions;
  out->work += m->answer.work;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_world_step(nsvcd_world *world, nsvcd_world_mover *movers,
                                       size_t count, const nsvcd_step_options *options,
                                       float seconds, void *workspace, size_t workspace_size,
                                       nsvcd_step_answer *answer) {
  static const nsvcd_step_options usual = {{0, 0, 0}, 0, 0};
  nsvcd__crowd crowd;
  nsvcd_step_answer out;
  if (!world || (count > 0 && !movers)) return NSVCD_ERROR_ARGUMENT;
  const int has_workspace = workspace && nsvcd__is_aligned(workspace) &&
                            workspace_size >= nsvcd_sweep_workspace_size(NULL);
  memset(&out, 0, sizeof out);
  nsvcd_result result = nsvcd__step_begin(world, movers, count, options ? options : &usual,
                                          seconds, &crowd, &out.refused);
  if (!result && !has_workspace) result = NSVCD_ERROR_WORKSPACE;
  if (answer) answer->refused = out.refused;
  if (result) return result;
  nsvcd__sort_turns(&crowd);
  for (size_t k = 0; k < count; k++) {
    nsvcd_world_mover *m = &movers[k];
    const int was_woken = !m->asleep && (double)m->calm >= crowd.calm;
    if (was_woken || (m->asleep && nsvcd__is_disturbed(&crowd, m))) nsvcd__wake(m);
  }
  const int is_driven = nsvcd__wake_near_driven(&crowd);
  if (is_driven) nsvcd__carry_all(&crowd, workspace, workspace_size, &out);
  // who is carried slides when all that is driven has arrived
  for (int carried = 0; carried <= is_driven; carried++) {
    for (size_t k = 0; k < count; k++) {
      nsvcd_world_mover *m = &movers[world->turns[k].mover];
      if ((world->residents[m->id].carrier != NSVCD_NOBODY) != carried) continue;
      const nsvcd_result said = nsvcd__step_mover(&crowd, m, workspace, workspace_size, &out);
      if (said && !result) {
        result = said;
        out.refused = m->id;
      }
    }
    const nsvcd_result arrives = nsvcd_world_arrive(world);
    if (!result) result = arrives;
  }
  for (size_t k = 0; k < count; k++) {
    const nsvcd_pose *at = &world->residents[movers[k].id].given.pose;
    if (memcmp(&movers[k].answer.pose, at, sizeof *at)) {  // it was driven, or never slid
      movers[k].answer.pose = *at;
      movers[k].answer.rests = 0;
    }
    nsvcd__grow_calm(&crowd, &movers[k]);
    out.asleep += movers[k].asleep != 0;
  }
  if (is_driven) nsvcd__end_carrying(world);
  if (answer) *answer = out;
  return result;
}

// -------------------------------------------------------------------------------------- world/mass
// In: a mesh. Out: its volume, centre of mass and moments of inertia, as a solid of one density.

// relative: how far what a closed mesh adds up to is off, for rounding and pinholes
#define NSVCD__CLOSED 1e-5

// Of the volume between a point and each triangle, in coordinates from there.
typedef struct nsvcd__moments {
  double volume;
  // of x, y and z; of their squares
  nsvcd__d3 first, second;
  // the sum of areas, of areas as vectors, and of x, y and z times these. Of a closed surface the
  // second is 0, and each of the third is the volume along its axis
  double area;
  nsvcd__d3 areas, by[3];
} nsvcd__moments;

static void nsvcd__moments_add(nsvcd__moments *m, nsvcd__d3 a, nsvcd__d3 b, nsvcd__d3 c) {
  const nsvcd__d3 area =
      nsvcd__d3_scale(nsvcd__d3_cross(nsvcd__d3_sub(b, a), nsvcd__d3_sub(c, a)), 0.5);
  const nsvcd__d3 sum = nsvcd__d3_add(nsvcd__d3_add(a, b), c);
  const double volume = nsvcd__d3_dot(a, area) / 3;
  m->volume += volume;
  m->first = nsvcd__d3_fma(volume / 4, sum, m->first);
  m->area += nsvcd__d3_norm(area);
  m->areas = nsvcd__d3_add(m->areas, area);
  for (size_t k = 0; k < 3; k++) {
    const double x = nsvcd__d3_axis(a, k);
    const double y = nsvcd__d3_axis(b, k);
    const double z = nsvcd__d3_axis(c, k);
    const double all = x + y + z;
    const double squares = (x * x + y * y + z * z + all * all) / 20;
    nsvcd__d3_set_axis(&m->second, k, nsvcd__d3_axis(m->second, k) + volume * squares);
    m->by[k] = nsvcd__d3_fma(all / 3, area, m->by[k]);
  }
}

// Do areas add up as those of a closed surface do? size: of its box.
static int nsvcd__adds_up(const nsvcd__moments *m, double size) {
  const double most = NSVCD__CLOSED * m->area;
  if (!(m->volume > most * size) || nsvcd__d3_norm(m->areas) > most) return 0;
  for (size_t k = 0; k < 3; k++) {
    nsvcd__d3 off = m->by[k];
    nsvcd__d3_set_axis(&off, k, nsvcd__d3_axis(off, k) - m->volume);
    if (nsvcd__d3_norm(off) > most * size) return 0;
  }
  return 1;
}

static nsvcd_result nsvcd__box_of_mesh(const nsvcd_mesh *mesh, nsvcd__box *box) {
  if (!mesh || !mesh->positions || !mesh->indices) return NSVCD_ERROR_ARGUMENT;
  if (mesh->vertex_count == 0 || mesh->triangle_count == 0) return NSVCD_ERROR_EMPTY;
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    for (size_t k = 0; k < 3; k++) {
      const size_t n = mesh->indices[3 * i + k];
      if (n >= mesh->vertex_count) return NSVCD_ERROR_INDEX;
      if (!nsvcd__in_range(mesh->positions + 3 * n, 3, NSVCD_MAX_COORDINATE))
        return NSVCD_ERROR_NUMBER;
      const nsvcd__f3 at = nsvcd__f3_row(mesh->positions, n);
      box->low = i + k ? nsvcd__f3_min(box->low, at) : at;
      box->high = i + k ? nsvcd__f3_max(box->high, at) : at;
    }
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_mesh_mass(const nsvcd_mesh *mesh, nsvcd_mass *mass) {
  nsvcd__moments m;
  nsvcd__box box = {{0, 0, 0}, {0, 0, 0}};
  if (!mass) return NSVCD_ERROR_ARGUMENT;
  memset(&m, 0, sizeof m);
  const nsvcd_result result = nsvcd__box_of_mesh(mesh, &box);
  if (result) return result;
  const nsvcd__d3 low = nsvcd__d3_widen(box.low);
  const nsvcd__d3 high = nsvcd__d3_widen(box.high);
  const nsvcd__d3 middle = nsvcd__d3_mix(low, high, 0.5);
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    nsvcd__d3 corners[3];
    for (size_t k = 0; k < 3; k++)
      corners[k] =
          nsvcd__d3_sub(nsvcd__d3_row(mesh->positions, mesh->indices[3 * i + k]), middle);
    nsvcd__moments_add(&m, corners[0], corners[1], corners[2]);
  }
  const nsvcd__d3 size = nsvcd__d3_sub(high, low);
  mass->is_of_box = !nsvcd__adds_up(&m, nsvcd__d3_norm(size));
  if (mass->is_of_box) {
    m.volume = size.x * size.y * size.z;
    m.first = nsvcd__d3_of(0, 0, 0);
    m.second = nsvcd__d3_of(size.x * size.x / 12, size.y * size.y / 12, size.z * size.z / 12);
  } else {
    m.first = nsvcd__d3_over(m.first, m.volume);
    m.second = nsvcd__d3_over(m.second, m.volume);
  }
  // of squares about the centre of mass
  const nsvcd__d3 c = m.first;
  const nsvcd__d3 s =
      nsvcd__d3_of(m.second.x - c.x * c.x, m.second.y - c.y * c.y, m.second.z - c.z * c.z);
  mass->volume = (float)m.volume;
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_add(middle, c)), mass->centre);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_of(s.y + s.z, s.z + s.x, s.x + s.y)),
                  mass->inertia);
  return NSVCD_OK;
}

#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif  // NEURALSVCD_WORLD_IMPLEMENTATION

// Licence: LICENSE, or the end of neuralsvcd.h.
