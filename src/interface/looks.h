// In: two bodies in 16 places. Out: an opinion on which of these they meet in.
#pragma once
#include "bodies.h"

#ifndef NSVCD_NO_PROOF
// places that are looked at together
#define NSVCD_LOOKS 16

// Where a body is in 16 places: row-major rotation matrices and positions, a number of all places
// side by side.
typedef struct nsvcd_places {
  float rotation[9][NSVCD_LOOKS];
  // metres
  float position[3][NSVCD_LOOKS];
} nsvcd_places;

// A body as a look sees it.
typedef struct nsvcd_looked {
  // with triangles
  const nsvcd_body *body;
  // scale of the body about its origin, NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; default 1
  float scale;
  // not NULL
  const nsvcd_places *places;
} nsvcd_looked;

// What is looked for. Zero means the default.
typedef struct nsvcd_look_options {
  // metres: the bodies meet if they come within this distance; below 0: if they are deeper in each
  // other
  float margin;
  // 1: whether they meet anywhere; the look ends at the first place where they do
  int any;
} nsvcd_look_options;

// In which of 16 places do two bodies meet? An opinion, not a proof, in a tenth of a microsecond to
// a few. A body is seen as the balls that cover it (nsvcd_encode_options.balls). One without balls
// is seen as its patches: as their spheres and slabs, or, if neither has balls, one of the two as
// spheres only. Of two bodies one may be a box along its axes, which is exact.
//
// It errs on the side that the caller names:
//
//   margin 0          no place is missed in which the surfaces meet. One body within the other is
//                     seen too, if that is such a box or has balls, which leave little of it out
//   margin -(e1+e2)   no meeting is invented, of bodies with balls. e: nsvcd_body_facts.ball_error
//                     of each; 0 for the box. What is enclosed by a mesh that is not closed is
//                     told on a grid of 96 cells along its longest side
//
//   a, b       not NULL
//   options    NULL: the defaults
//   met        not NULL; set to a bit for each place, the lowest for the first, or left as it was
//              on failure
//   allocates  nothing
//   threads    bodies may be shared
//   errors     ARGUMENT, BODY, VERSION, TRIANGLES, SCALE, CLEARANCE (`margin`). Places are not
//              checked: of what is not finite, anything may be said
//   source     this library
NSVCDDEF nsvcd_result nsvcd_look(const nsvcd_looked *a, const nsvcd_looked *b,
                                 const nsvcd_look_options *options, uint32_t *met);
#endif
