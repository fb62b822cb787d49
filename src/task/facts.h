// In: weights.h. Out: the names of what the decoder sees of two patches, and the tape: what the
// derivative of an opinion is made of.
#pragma once
#include "../encoder/model.h"
#include "../ground/rotations.h"
#include "../ground/slices.h"

#ifndef NSVCD_NO_NETWORK
// The facts: what the decoder sees of a pair's geometry, in the pair's frame and units.
enum {
  NSVCD__FACT_DISTANCE = 0,  // of the centres
  NSVCD__FACT_RADIUS = 1,    // the larger one
  NSVCD__FACT_CLOSEST = 2,   // the centres' distance at their closest approach
  NSVCD__FACT_TAU = 3,       // the time of that: -1 and 1 are the ends of the interval
  NSVCD__FACT_VELOCITY = 4,  // (3)
  NSVCD__FACT_TURN = 7,      // (3)
  NSVCD__FACT_SPEED = 10,    // the lengths of these two
  NSVCD__FACT_SPIN = 11,
  NSVCD__FACT_GAPS = 12,    // (GAPS, MOMENTS): between the extreme points
  NSVCD__FACT_WIDEST = 24,  // (MOMENTS): the widest of these
  // (3): products of the normals: with each other; the larger patch's, and the smaller one's, with
  // the line from the larger to the smaller
  NSVCD__FACT_FACING = 27,
  NSVCD__FACT_FLAT = 30,  // (2): how flat the larger patch is, and the smaller
  NSVCD__FACTS = 32
};
// The axes, from the fixed patch to the moving one, along which gaps are measured: the larger
// patch's normal, the smaller one's, the line between the centres, and the sum of the normals.
enum { NSVCD__GAP_LARGER, NSVCD__GAP_SMALLER, NSVCD__GAP_LINE, NSVCD__GAP_BOTH, NSVCD__GAPS };
#define NSVCD__MOMENTS 3  // both ends of the interval, and its middle
// The fact about a gap g, in units of r1 + r2, is x / (1 + |x|), where x is g times the first of
// these. The widest uses the second: near contact it must not be lost in the steps of int8.
#define NSVCD__GAP_STEEP 8.0f
#define NSVCD__WIDEST_STEEP 40.0f
#define NSVCD__INPUTS (2 * NSVCD__LATENT + NSVCD__FACTS)
// Zeros at the end.
#define NSVCD__DECODER_IN ((NSVCD__INPUTS + 15) / 16 * 16)
#define NSVCD__LEAN 0.05f  // share of the lean in axis 2

// A pair in motion: lane 0 of nsvcd__pairs, number by number, without the bytes.
typedef struct nsvcd__pair {
  nsvcd__f3 p1, p2;
  float r1, r2;
  nsvcd__mat3 rotation;
  nsvcd__f3 v, w, normal[2];
  float flat[2];
} nsvcd__pair;

// The pair in its own units, and its frame: lane 0 of nsvcd__views, number by number.
typedef struct nsvcd__view {
  float inverse, k1, k2, swap;
  nsvcd__f3 d, lean, normal;
  float time;
  nsvcd__f3 v, w;
  nsvcd__mat3 frame;
  float side;
} nsvcd__view;

// The times that matter of a candidate's motion.
enum {
  NSVCD__ENTRY = 0,
  NSVCD__EXIT = 1,
  NSVCD__MIDDLE = 2,       // of these two
  NSVCD__ENTRY_BEGIN = 3,  // the segment in which the balls meet
  NSVCD__ENTRY_END = 4,
  NSVCD__EXIT_BEGIN = 5,  // the segment in which they separate
  NSVCD__EXIT_END = 6,
  NSVCD__INSTANTS = 7
};

// The moving patch's centre at these times, in the fixed body's axes and units.
typedef struct nsvcd__instants {
  float t[NSVCD__INSTANTS];
  float arm[3][NSVCD__LANES];  // from the body's origin
  float position[3][NSVCD__LANES];
  // inside of the segment? At one of its ends the time is constant
  int enters, leaves;
} nsvcd__instants;

// What vectors compute for the derivative by one pair. network/tape records it, and gradient/ reads
// it in scalars.
typedef struct nsvcd__tape {
  nsvcd__pair pair;
  nsvcd__view view;
  nsvcd__f3 axes[NSVCD__GAPS];              // along which gaps are measured
  float gaps[NSVCD__MOMENTS][NSVCD__GAPS];  // in the fixed body's units
  const int8_t *extremes[2];                // (EXTREMES, 3) at a stride of GROUP
  nsvcd__instants at;                       // its times are given
  float x[NSVCD__DECODER_IN];               // the decoder's inputs
  float by_x[NSVCD__DECODER_IN];            // the derivative by these
} nsvcd__tape;
#endif  // NSVCD_NO_NETWORK
