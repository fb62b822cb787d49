// In: two bodies of triangles and a motion. Out: a witness (two triangles that meet, and when), a
// certificate that the surfaces never do, or neither: undecided.
//
// THEOREM. Let both bodies be scaled and posed by the motions of motion/motion: between two
// poses the position is linear in t and the rotation a slerp. If the proof ends in FREE,
// then at no t in [0,1] do the surfaces of the two meshes come within the clearance of each other,
// and no component of one is contained in what closed components of the other enclose (a body
// declared open encloses nothing). src/proof/THEOREM.md walks through it. None of this is needed
// for bodies that never come as near as their extents and the clearance together: nsvcd__prove.
//   1. Every point of a surface lies in a piece of some patch (surface/surface). So it is enough
//      to separate each patch of one body from each of the other, at all times.
//   2. The broad phase leaves out only patches and segments of time in which the spheres over the
//      pieces stay apart. What it leaves is a *patch pair*: two patches in one segment. Every patch
//      pair is separated by one of the steps below, or the verdict is not FREE.
//   3. An *interval* of the motion is a segment or a part of one. Within it, a point x of the
//      moving body (body frame) leaves the chord between its positions at the two ends by no more
//      than nsvcd__deviation_of along any direction: the deviation of segments/segments, along a
//      plane's normal (within one arc of angle h of one body it is h^2 / 8 |x|, and nothing along
//      the axis). Let a plane have the moving side at both ends on one side, by more than that and
//      the clearance. A chord is convex: so the chords are there too, and with them all positions
//      in between.
//   4. Slabs: the plane is normal to a patch, or to a group of 16; each side's extent along it
//      follows from its slab. Hulls: any plane; a patch's pieces are within its margin of the hull
//      of its first vertices. Triangles: a plane for a triangle pair, two entries. The entries of a
//      patch name all triangles of its pieces, whole or in parts.
//   5. Rounding: every plane allows for NSVCD__ROUNDING of all lengths that enter a float
//      computation: that is `rounding`, in intervals and segments alike. Stored points are off by
//      the patch's margin or quantization error, and every plane in float allows for that, too.
//      Triangle pairs are separated in double, whole and as the caller gave them, whatever pieces
//      are stored. No NaN occurs: questions and bodies are checked to be finite and within bounds.
//      Only in hulls floats may overflow, and there a NaN separates nothing.
//   6. Containment is decided at t = 0, component by component: a component that is contained in
//      the other body at one time and not at another has crossed a surface in between. A component
//      is represented by one of its vertices, its seed. A ray from the seed counts the triangles
//      of the other body's closed components that it leaves and enters through, with their signs:
//      the sum is the winding number about the seed, 0 outside. A ray that passes an edge within
//      rounding, or within what triangles are off the mesh's, is given up for another one. Open
//      components enclose nothing. Where flaws are set aside (patches/solids), what counts is still
//      a cycle: each edge has its reverse. Or it has an even number of triangles at each edge, and
//      then a ray from inside crosses an odd number of them. Corners that were joined leave gaps
//      between edges, which the cycle closes by strips, nowhere farther from an edge than `gap`. A
//      ray that passes an edge within `gap` is given up as well, so that it crosses no strip; and
//      only planes decide what is so near to the surface. FREE then says that nothing crosses the
//      surface but through a gap. What is nearly a solid is no cycle: if most rays find a seed
//      inside it, that is UNDECIDED. Where a triangle is that near to the seed, the answer counts
//      only if planes separate all patches at t = 0: then the seed, the surface that was tested
//      and the true one are, patch by patch, on one side of a plane, and agree.
//
// A long motion is cut into intervals (motion/choice), and 2 to 5 are applied to each: the verdict
// is FREE if each of them is. Each begins at the tick at which the one before it ends, and the
// last ends at 1. Containment is decided at t = 0 alone: 6 holds for all of the motion.
//
// A witness is a pair of the meshes' triangles that share a point at the true pose, in double, or
// that come within the clearance, where there is one. In a coarse body, or a scaled one, they are
// those of a mesh that is a little off (nsvcd__off_mesh). Faces that are parallel when they meet
// do so at one time only, which rounded numbers miss. There, a corner that changes sides of the
// other triangle, within its edges all the while, has met it in between (so has an edge an edge),
// and halving finds when. UNDECIDED: two triangles come closer than NSVCD__TOO_NEAR and the
// tolerance without meeting, or the budget is exhausted. After such an unresolved pair only a
// contact can still decide, and flat on flat has as many unresolved pairs as triangles: so only a
// part of the budget is left then, more than a yes or no takes on any problem of the sets.
//
// FIRST CONTACT. A contact ends the motion: only what is more than `first` before it still matters,
// and is proven free, or gives an earlier contact, or is unresolved. Segments are searched a few at
// a time, in order, so that early contacts are found first. Once the budget after an unresolved
// pair is exhausted, that pair is the end, and what is before it is proven. If the budget does not
// suffice, the rest of it goes to what is proven soonest: the motion is proven part by part from
// where nothing is resolved, the first part a short one.
//
// THE LIMIT ends the search and changes nothing before that: what is tried, and in which order,
// depends on the units taken, not on those allowed. So a higher limit takes no more units for what
// a lower one decides, except in the lower one's last eighth, which is kept for what is undecided.
//
// THE LEAST DISTANCE is asked last, when it is known whether the bodies come within the clearance.
// Contacts lower the clearance: it begins as the distance of two vertices, and when triangles are
// found nearer than that, it becomes their distance less `measure`. What has been separated stays
// separated, by more than that. So it is one search whose question shrinks, and in the end all of
// the motion that matters is proven free at the clearance that matters.
//
// Work is counted in units: a plane sought for two hulls, 16 triangles against the box of 16, one
// of them against these, a triangle pair at one time, a ray against 16 triangles or one. Spheres,
// slabs and planes that held before are not counted. A query ends within one patch's entries, or
// one ray, of its limit: nsvcd__check_budget.
#pragma once
#include "../body/geometry.h"
#include "../motion/workspace.h"
#include "near_list.h"
#include "schedule.h"

#ifndef NSVCD_NO_PROOF
typedef struct nsvcd__patch_pair {
  uint16_t moving, fixed, segment;
  uint16_t sought;  // 1: for a witness
  // 1 - least distance of the centres / (r1 + r2)
  float depth;
  // of the segment, when that is
  float fraction;
} nsvcd__patch_pair;

// The motion between two keyframes, in double and in the fixed body's units. Where the fixed body
// moves, slerps and positions have the world's axes, else the fixed body's.
typedef struct nsvcd__arc {
  // its first tick, and its length; no ticks: none
  uint32_t first, ticks;
  int fixed_moves;
  // of the moving body
  double scale;
  nsvcd__slerp moving, fixed;
  // from the fixed body's pivot to the moving one's, and how it changes
  nsvcd__d3 from, moved;
  // added to that in the fixed body's frame: its pivot, and the push-out; and taken away in the
  // moving one's
  nsvcd__d3 added, pivot;
  // The axis of the relative turn at the start, unit, in the fixed body's frame and in the moving
  // one's. Where both bodies turn, it wavers from either by this angle at most.
  nsvcd__d3 axis, own_axis;
  double waver;
  // Over the arc, in the fixed body's frame: the angle of the turn, radians, and the path of the
  // moving origin, at most.
  double turn, speed;
  // Deviation from the chord: per metre from the turn's axis; where both bodies turn, besides per
  // metre from the moving origin; and of that origin itself.
  double bend, twist, origin_bend;
} nsvcd__arc;

// The pose at fraction u of an arc, which its first tick and its ticks name.
typedef struct nsvcd__known_pose {
  uint32_t arc, ticks;
  double u;
  nsvcd__dtransform transform;
} nsvcd__known_pose;

// A motion, arc by arc: the arc that was asked for last, if it has ticks, and poses in arcs that
// are remembered, of which `next` is the next to be replaced.
typedef struct nsvcd__arcs {
  nsvcd__motion *motion;
  nsvcd__arc arc;
  nsvcd__known_pose poses[NSVCD__KNOWN_POSES];
  size_t next;
} nsvcd__arcs;

// An interval of the motion. A point of the moving body at r metres from its origin
// deviates from the chord between its positions at both ends by no more than origin_bend + bend r.
// Float computation of its position is off by no more than `rounding`.
typedef struct nsvcd__interval {
  nsvcd__transform start, end;
  float rounding, origin_bend, bend;
  // unit: of the turn from start to end, and of the origin's travel
  nsvcd__f3 axis, heading;
  // the bounds along the axis; and of the origin across the heading
  float bend_along_axis, origin_along_axis, origin_off_heading;
} nsvcd__interval;

// 16 triangles of a patch, lane by lane: corners (corner, axis, lane), and their boxes.
typedef struct nsvcd__block {
  float corners[3][3][NSVCD__LANES];
  float low[3][NSVCD__LANES], high[3][NSVCD__LANES];
  size_t patch, first, count;  // entries
} nsvcd__block;

// The triangles of a patch pair, block by block, with boxes about the fixed blocks.
typedef struct nsvcd__blocks {
  nsvcd__block moving, fixed[NSVCD__WINDOW];
  nsvcd__box bounds[NSVCD__WINDOW];
  // The moving block's corners at the start and at the end of the interval `over` (corner, axis,
  // lane); without an interval, NULL, 3 of them at one pose.
  const nsvcd__interval *over;
  float corners[6][3][NSVCD__LANES];
  // Only remembered, as a memo: blocks of a fixed patch in `fixed`; is one in `moving`?
  size_t corner_count, window;
  int has_block;
} nsvcd__blocks;

typedef struct nsvcd__pair_contact {
  double tick;      // when
  double distance;  // of the triangles
  // the fixed body's frame; out of the fixed body
  nsvcd__d3 point, normal;
  uint32_t moving_triangle, fixed_triangle;
  uint32_t moving_entry, fixed_entry;
  uint16_t moving_patch, fixed_patch;
} nsvcd__pair_contact;

// The velocity of the moving body in the fixed body's frame, per tick: that of a point x is
// along + cross(turn, x).
typedef struct nsvcd__twist {
  nsvcd__d3 along, turn;
} nsvcd__twist;

// Two triangles that touch at the start, in the fixed body's frame.
typedef struct nsvcd__touch {
  nsvcd__d3 moving[3], fixed[3];
  // Directions that may undo it, unit: the moving one's normal, reversed; the fixed one's normal;
  // and from the fixed one's nearest point to the moving one's, 0 if they meet.
  nsvcd__d3 directions[3];
} nsvcd__touch;

// Where the bodies touch at a contact: query/manifold.
typedef struct nsvcd__manifold {
  // unit: the contact's, and directions across it
  nsvcd__d3 normal, along[NSVCD__SUPPORTS];
  nsvcd__twist twist;
  // distances: of what touches, and of points that count as one, at most
  double tolerance, same;
  // The farthest contact along each direction; how far that is: -HUGE_VAL: there is none, HUGE_VAL:
  // it is not sought; and the number of its corner or edges.
  nsvcd__pair_contact supports[NSVCD__SUPPORTS];
  double farthest[NSVCD__SUPPORTS];
  uint32_t numbers[NSVCD__SUPPORTS];
} nsvcd__manifold;

// What is done with triangles that come within the clearance: they are contacts or, of a motion at
// rest, all are collected as touching, or are listed.
typedef enum nsvcd__collecting {
  NSVCD__CONTACTS,
  NSVCD__TOUCHING,
  NSVCD__LISTING
} nsvcd__collecting;

// What a question finds.
typedef enum nsvcd__finding {
  NSVCD__FOUND_FREE,
  NSVCD__FOUND_CONTACT,
  NSVCD__FOUND_INSIDE,
  NSVCD__FOUND_UNDECIDED
} nsvcd__finding;

// What becomes of a part of it: a pair of patches, or of triangles, over an interval.
typedef enum nsvcd__outcome {
  // separated, or kept as an unresolved pair, or no longer asked about
  NSVCD__DONE,
  // the same of all triangles of both patches
  NSVCD__ALL_DONE,
  // a contact was sought and not found
  NSVCD__NOTHING,
  // a contact was found that answers the question
  NSVCD__ANSWERED,
  // a contact was found that shrinks the question: ask again
  NSVCD__SHRUNK,
  // ask again: in halves, or with a smaller clearance
  NSVCD__TOO_LONG,
  // the budget is exhausted, and stays so
  NSVCD__EXHAUSTED
} nsvcd__outcome;

// A patch's height over a plane. key: the patch; of a moving one, with the segment.
typedef struct nsvcd__height {
  uint32_t plane, key;
  float height;
} nsvcd__height;

// The question, in the fixed body's units.
typedef struct nsvcd__given {
  // the sum of both bodies' extents, and of their pivots' distances from the origins
  float lengths;
  // beyond the quantization errors
  double tolerance;
  double clearance, slop;
  // both bodies' convex radii, which the clearance includes
  double radius;
  // The resolution of the first contact, a fraction of the motion, and of the least distance; 0:
  // not asked for.
  double fraction, width;
  // FIRST: the resolution as a distance, so near a contact a motion may have ended; 0: not given
  double to;
  // of the surfaces alone?
  int surfaces;
  // is more asked for than yes or no?
  int tells;
  // The budget: of all or, if it grows, of each interval of a long motion; and the part of it for
  // what is beside the question, above all what follows an unresolved pair.
  size_t work, reserve;
  int grows;
  // the caller's
  int (*stop)(void *user);
  void *user;
} nsvcd__given;

// What one search is asked. A value: the search narrows a copy of its own, and only ever shrinks
// it, so that what has been proven holds for what is left. A contact is two triangles within the
// clearance.
typedef struct nsvcd__goal {
  nsvcd__motion *motion;
  // ticks: what begins then or later does not matter
  double end;
  // the first unresolved pair ends the search, too
  int unresolved_ends;
  double clearance;
  // DISTANCE: each contact lowers the clearance to the distance of its triangles less `measure`, 0:
  // not asked for; and the bracket of the least distance as it is known
  double measure, low, high;
  // FIRST: each contact ends the motion so much before it: a fraction of the motion, and in ticks;
  // 0: not asked for
  double fraction, first;
  // budgets: of this search, of all, and after an unresolved pair
  size_t limit, most, after_unresolved;
  // a first attempt, with a small budget
  int is_brief;
  nsvcd__collecting collects;
} nsvcd__goal;

// Why it could not be told what is inside of what: the rays do not tell, or the budget ended first.
typedef enum nsvcd__unclear {
  NSVCD__CLEAR,
  NSVCD__CANNOT_TELL,
  NSVCD__NOT_ASKED
} nsvcd__unclear;

// What a search has proven of a motion.
typedef struct nsvcd__search_result {
  nsvcd__outcome outcome;
  int has_contact;
  nsvcd__pair_contact found;
  // the tick at which the first unresolved pair begins (two triangles too near to tell); the pair
  double unresolved;
  nsvcd__pair_contact unresolved_pair;
  // the budget was exhausted: all from the tick `proven_until` on is undecided
  int ran_out;
  double proven_until;
  // the goal's end and clearance, as the search has narrowed them
  double end, clearance;
  // FIRST: nothing of the motion is proven free but its start
  int starts_free;
} nsvcd__search_result;

// What is only remembered of patch pairs. It may be forgotten between patch pairs and between parts
// of one: what is proven is as true then, and only the work may differ. All zeros: nothing is
// remembered.
typedef struct nsvcd__memo {
  // segments that have been made intervals
  uint64_t intervals;
  // The normal of the plane between hulls that held last, and its number, 0: none; and the heights
  // of moving and of fixed patches over it. Without a plane these are not even zeros.
  nsvcd__f3 held;
  uint32_t plane;
  nsvcd__height heights[NSVCD__HEIGHTS], fixed_heights[NSVCD__FIXED_HEIGHTS];
} nsvcd__memo;

// With a slop: what the moving body touches at the start, and how that is undone.
typedef struct nsvcd__push_outs {
  // collected contacts that no known normal undoes; normals, unit, of what the moving body touches,
  // towards it
  size_t contact_count, normal_count;
  // One contact cannot be undone. Of directions that undo as many, the one with more faces is
  // chosen, not the one with the shorter push-out.
  int too_deep, by_faces;
  nsvcd__d3 normals[NSVCD__PUSH_OUTS];
  // the depth of contact along each; and how far a plane normal to one is to be pushed out
  double depths[NSVCD__PUSH_OUTS];
  double needed;
  double slop;  // how deep a contact may be that is undone
} nsvcd__push_outs;

// What two triangles need, and all that the floor `triangles` may write: the bodies and the
// question, which stay as they are given; the goal of the search now or the last one, and what it
// has found. Everywhere it is called p.
typedef struct nsvcd__proof {
  nsvcd__geometry moving, fixed;
  nsvcd__given given;
  // the goal's motion, in whose last arc patch pairs and triangle pairs are resolved
  nsvcd__arcs arcs;
  nsvcd__goal goal;
  nsvcd__search_result known;
  size_t work;
  // the work at which the caller is asked again whether to stop; and at which that was said, 0: not
  size_t ask_at, stopped_at;
  // Only remembered, as a memo: the unit normal of the plane that separated a triangle pair last.
  // shared: the triangle pairs in a row that it has separated since.
  nsvcd__d3 separating;
  nsvcd__push_outs push;
  nsvcd__near_list near_list;
  union {
    struct {
      // that no plane separates over their segment
      nsvcd__patch_pair pairs[NSVCD__PATCH_PAIRS];
      nsvcd__manifold manifold;
    } kept;
    // collected before there are any
    nsvcd__touch touches[NSVCD__TOUCHES];
  } of;
  // A triangle pair over an arc: the ends of the parts to come, the last one first. parts: how
  // often the interval's triangle pairs have been halved.
  double pair_ends[NSVCD__HALVINGS + 2];
  size_t shared, parts;
} nsvcd__proof;

// What patches need besides, which the floor `separate` writes. Everywhere it is called w, and its
// proof w->p.
typedef struct nsvcd__solver {
  nsvcd__proof p;
  nsvcd__isa isa;  // whose kernels search
  nsvcd__memo memo;

  // Containment at the start. inside: a component seems to be inside the other body, but close to
  // its surface; enclosed: a point of it, in the fixed body's frame; unclear: it could not be told,
  // in_open: since the other is nearly a solid, but not closed.
  int inside, in_open;
  nsvcd__d3 enclosed;
  nsvcd__unclear unclear;

  // Segments as intervals (S), where the memo says so. Those that have been clipped, and the end,
  // ticks, at which the last one was.
  nsvcd__interval *intervals;
  uint64_t clipped;
  double clipped_end;

  // segments in which 16 fixed patches are met
  uint64_t met_in[NSVCD__GROUP];
  // Patch pairs: as the search finds them, and those that no plane separates over their segment;
  // witnesses that were sought in vain; and how often a plane has been tried on all of both
  // patches.
  size_t fresh_count, count, misses, all_tried;
  nsvcd__patch_pair fresh[NSVCD__FRESH];

  // a patch pair: its hulls, posed, and its triangles
  float hull_start[3][NSVCD__LANES], hull_end[3][NSVCD__LANES], hull_fixed[3][NSVCD__LANES];
  nsvcd__blocks blocks;

  // A patch pair over an arc: the part now, and the ends of those to come, the last one first
  nsvcd__interval interval;
  double arc_ends[NSVCD__ARC_PARTS];

  // triangles that a ray has crossed
  uint32_t crossed[NSVCD__CROSSED];
} nsvcd__solver;

// The limit that allows so many units more, but never more than the question has left.
static size_t nsvcd__limit_after(const nsvcd__proof *p, const nsvcd__goal *goal,
                                 size_t units) {
  const size_t left = p->work < goal->most ? goal->most - p->work : 0;
  return left > units ? p->work + units : goal->most;
}

// The limit of the search for the first contact; the rest is for what is proven part by part.
static size_t nsvcd__limit_of_first(const nsvcd__given *given, const nsvcd__goal *goal) {
  return goal->most - given->reserve;
}

// Asks the caller whether to stop. If so, more work has been done than any budget allows.
static NSVCD__NOINLINE void nsvcd__ask_to_stop(nsvcd__proof *p) {
  nsvcd__given *given = &p->given;
  p->ask_at = p->work + NSVCD__STOP_UNITS;
  if (!given->stop(given->user)) return;
  p->stopped_at = p->work;
  p->ask_at = SIZE_MAX;
  p->work = SIZE_MAX / 2;
  given->work = given->reserve = 0;
  given->grows = 0;
}

// Is the budget exhausted? FIRST looks for contacts after its first unresolved pair with a small
// budget. When that is exhausted, the pair becomes the end of the motion, here, and the search goes
// on with the rest of the budget for what lies before the pair.
static int nsvcd__check_budget(nsvcd__proof *p) {
  nsvcd__goal *goal = &p->goal;
  if (p->work >= p->ask_at) nsvcd__ask_to_stop(p);
  if (p->work > goal->limit && goal->first > 0 && !goal->is_brief && !goal->unresolved_ends &&
      p->known.unresolved < NSVCD__NEVER) {
    goal->unresolved_ends = 1;
    p->known.end = nsvcd__min(p->known.end, p->known.unresolved);
    const size_t left = (NSVCD__AFTER_UNRESOLVED - 1) * p->given.reserve;
    goal->limit = nsvcd__limit_of_first(&p->given, goal);
    if (p->work + left < goal->limit) goal->limit = p->work + left;
  }
  return p->work > goal->limit;
}

// The clearance in float, rounded up.
static float nsvcd__clearance(const nsvcd__goal *goal) {
  return 1.000001f * (float)goal->clearance;
}

// How far triangles may be off the meshes', both together.
static double nsvcd__off_meshes(const nsvcd__proof *p) {
  const double moving = (double)nsvcd__off_mesh(&p->moving);
  return p->arcs.motion->ratio * moving + (double)nsvcd__off_mesh(&p->fixed);
}

// The sum of two patches' quantization errors.
static float nsvcd__errors_of(const nsvcd__proof *p, size_t i, size_t j) {
  return p->arcs.motion->scale * p->moving.errors[i] + p->fixed.errors[j];
}

// Turns to a motion. None of its arcs is known, nor any pose.
static void nsvcd__arcs_begin(nsvcd__arcs *arcs, nsvcd__motion *motion) {
  arcs->motion = motion;
  arcs->arc.ticks = 0;
  arcs->next = 0;
  for (size_t n = 0; n < NSVCD__KNOWN_POSES; n++) arcs->poses[n].ticks = 0;
}

// Answers in float cannot tell things apart that are nearer to each other than this.
static double nsvcd__epsilon(const nsvcd__proof *p) {
  return nsvcd__off_meshes(p) + NSVCD__LEAST_EPSILON * (double)p->given.lengths;
}
#endif  // NSVCD_NO_PROOF
