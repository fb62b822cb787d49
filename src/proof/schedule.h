// In: nothing. Out: what a proof may take, and how much of it, in the order in which a query comes
// to it.
#pragma once

#ifndef NSVCD_NO_PROOF
// A budget is in units of work.

// Room for patch pairs as the search finds them; with so many of them they are sifted before it
// goes on.
#define NSVCD__FRESH 48
#define NSVCD__ENOUGH_FRESH 8

// Sifting tries planes and seeks witnesses. If the first patch pair is deeper than this, a witness
// is sought in it before any plane is tried.
#define NSVCD__DEEP 0.2f
// Steps of Gilbert's iteration, for a plane between two hulls.
#define NSVCD__PLANE_STEPS 12
// Witnesses that were sought in vain: after so many triangles are tried as well; after so many no
// more witnesses are sought where the question is yes or no.
#define NSVCD__FEW_MISSES 8
#define NSVCD__MANY_MISSES 128
// Remembered heights over the plane that held last: of moving patches, and of fixed ones.
#define NSVCD__HEIGHTS 256
#define NSVCD__FIXED_HEIGHTS 64

// What no plane separates is resolved by its triangles, arc by arc.
// Room for such patch pairs. When it is full, they are resolved first.
#define NSVCD__PATCH_PAIRS 256
// Blocks of a fixed patch that are loaded at once.
#define NSVCD__WINDOW 8
// An interval is halved for all its triangle pairs once these have been halved more often than
// this, if it is longer than this fraction of an arc.
#define NSVCD__FEW_PARTS 1
#define NSVCD__SHORTEST 0.015
// A plane is tried on all of two patches once it has separated so many of their triangle pairs in
// a row.
#define NSVCD__SHARED 4
// Parts of an arc that wait; halvings of an interval for one triangle pair; remembered poses.
#define NSVCD__ARC_PARTS 8
#define NSVCD__HALVINGS 40
#define NSVCD__KNOWN_POSES 8
// In units of all lengths: a distance in double that is 0; one that is too near to halve for.
#define NSVCD__SAME_POSITION 1e-13
#define NSVCD__TOO_NEAR 1e-9
// The reserve is 1 / this of the budget. It is all that is left after an unresolved pair; FIRST
// looks for later contacts with so many units.
#define NSVCD__AFTER_UNRESOLVED 8
#define NSVCD__AFTER_FIRST_UNRESOLVED 3000
// Units from one call of question.stop to the next.
#define NSVCD__STOP_UNITS 1000

// What else a question asks.
// The budget of the first attempt, before the two ends of the motion are tried by themselves.
#define NSVCD__BRIEF_BUDGET 6000
// The budget at each end.
#define NSVCD__END_BUDGET 1000
// The budget for triangles that meet where one body is inside the other.
#define NSVCD__INSIDE_BUDGET 200
// Times that the search for a first bound of the distance alternates between when and where the
// bodies are nearest.
#define NSVCD__TURNS 2
// A long motion. Intervals of many arcs, and hard ones, are first tried with this budget.
#define NSVCD__TRY 64
// An interval that takes no more than EASY is easy, and the next try has LARGER times as many arcs.
// After a try that failed it has SMALLER times fewer, and up to WAIT intervals have to be easy
// before the next try.
#define NSVCD__EASY 16
#define NSVCD__LARGER 4
#define NSVCD__SMALLER 8
#define NSVCD__WAIT 64
// The least distance is measured in passes, each so many times finer.
#define NSVCD__FINER 2
// Segments that are searched together where the first contact is sought.
#define NSVCD__IN_ORDER 4
// Segments, at most, of a motion whose body, if it is one group, is searched in the order in which
// it comes to patches.
#define NSVCD__FEW_SEGMENTS 4
// If that exhausts its budget, the motion is proven part by part: the length of the first one, in
// segments; and the budget of a part besides eight times that of the part before.
#define NSVCD__FIRST_PART 0.0625
#define NSVCD__PART_BUDGET 250

// With a slop: contacts at the start that are collected at once; directions in which they are
// undone; rounds of undoing what is met on the way out; and the fraction of the slop that is kept
// where a body is set down.
#define NSVCD__TOUCHES 26
#define NSVCD__PUSH_OUTS 6
#define NSVCD__DEEPEN 16
#define NSVCD__SET_DOWN 0.02
// The resolution of a float of an answer, in units of all lengths; a safe pose is so many of these
// before a contact.
#define NSVCD__LEAST_EPSILON 1.2e-7
#define NSVCD__EPSILONS 3

// Contact points are sought: the farthest along so many directions and, if their area's width is
// less than this fraction of its length, along two more across that.
#define NSVCD__AROUND 8
#define NSVCD__SUPPORTS 10
#define NSVCD__SLIM 0.3
// Containment: triangles that a ray may cross.
#define NSVCD__CROSSED 128
#define NSVCD__NEVER 1e300  // ticks
#endif                      // NSVCD_NO_PROOF
