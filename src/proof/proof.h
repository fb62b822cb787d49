// In: two bodies of triangles and a motion. Out: a witness (two triangles that meet, and when), a
// certificate that the surfaces never do, or neither: undecided.
//
// THEOREM. Let both bodies be scaled and posed by the motions of motion/motion: between two
// poses the position is linear in t and the rotation a slerp. If the proof ends in FREE,
// then at no t in [0,1] do the surfaces of the two meshes come within the clearance of each other,
// and no component of one lies within what closed components of the other enclose (a body that is
// said to be open encloses nothing). src/proof/THEOREM.md walks through it. Bodies that at no time
// come as near as their extents and the clearance together need none of this: nsvcd__prove.
//   1. Every point of a surface lies in a piece of some patch (surface/surface). So it is enough
//      to separate each patch of one body from each of the other, at all times.
//   2. The broad phase leaves out only patches and segments of time in which the spheres over the
//      pieces stay apart. What it leaves is a *patch pair*: two patches in one segment. Every patch
//      pair is separated by one of the steps below, or the verdict is not FREE.
//   3. An *interval* of the motion is a segment or a part of one. Within it, a point x of the
//      moving body (body frame) leaves the chord between its positions at the two ends by no more
//      than nsvcd__deviation_of along any direction: the deviation of motion/segments, taken along
//      a plane's normal (within one arc of angle h of one body it is h^2 / 8 |x|, and nothing along
//      the axis). A plane that has the moving side's places at both ends on one side,
//      by more than that and the clearance, has their chords there too, for a chord is convex, and
//      so all places between.
//   4. Slabs: the plane is normal to a patch, or to a group of 16; what each side reaches along it
//      follows from its slab. Hulls: any plane; a patch's pieces are within its margin of the hull
//      of its first vertices. Triangles: a plane for a triangle pair, two listed triangles. A patch
//      lists all triangles of its pieces, whole or in parts.
//   5. Rounding: every plane allows for NSVCD__ROUNDING of all lengths that enter a float
//      computation: that is `rounding`, in intervals and segments alike. Stored points are off by
//      the patch's margin or quantization error, which every plane in float allows for too.
//      Triangle pairs are separated in double, whole and as the caller gave them, whatever pieces
//      are stored. No NaN occurs: questions and bodies are checked to be finite and within bounds.
//      Where floats could overflow all the same, in hulls, a NaN separates nothing.
//   6. Containment is decided at t = 0, component by component: a component that is inside of the
//      other body then, and not later, or the other way about, has crossed a surface in between. A
//      component is asked about by one of its vertices, its seed. A ray from the seed counts, with
//      their signs, the triangles of the other body's closed components that it leaves and enters
//      through: the sum is how often these wind about the seed, 0 outside. A ray that passes an
//      edge within rounding, and what triangles are off the mesh's, is given up for another; open
//      components enclose nothing. Where flaws are set aside (patches/solids), what counts is still
//      a cycle: each edge has its reverse; or it has an even number of triangles, and then a ray
//      from inside crosses an odd number of them. Corners that were joined leave gaps between
//      edges, and the cycle has strips there, nowhere farther from an edge than `gap`: a ray that
//      passes an edge within that is given up as well, so it crosses no strip; and what is so near
//      to the surface is told only by planes. FREE says then that nothing crosses the surface but
//      through a gap. What is nearly a solid is no cycle: what most rays have inside of it is
//      UNDECIDED. Where a triangle is that near to the seed, the answer counts only if planes
//      separate all patches at t = 0: then the seed, the surface that was looked at and the true
//      one are, patch by patch, on one side of a plane, and agree.
//
// A long motion is cut into intervals (motion/choice), and 2 to 5 are applied to each: FREE is said
// if it is true of all of them. Each begins at the tick at which the one before it ends, and the
// last ends at 1. Containment is decided at t = 0 alone: 6 holds for all of the motion.
//
// A witness is a pair of the meshes' triangles that share a point at the true pose, in double, or,
// where a clearance is asked for, come within it. In a coarse body, or one that was scaled, they
// are those of a mesh that is a little off (nsvcd__off_mesh). Faces that are parallel when they
// meet do so at one time only, which rounded numbers miss: there, a corner that is on one side of
// the other triangle at one time and on the other at another, and within its edges all the while,
// has met it between (an edge and an edge likewise), and halving finds when. UNDECIDED: two
// triangles come closer than NSVCD__TOO_NEAR and the tolerance without meeting, or the limit of
// work was reached. After such an unresolved pair only a contact can still decide, and flat on flat
// there are as many unresolved pairs as triangles: so a share of the limit is all that is left
// then, more than a yes or no takes on any problem of the sets.
//
// FIRST CONTACT. Contacts end the motion: whenever one is found, only what is more than `first`
// before it matters from then on, and is proven free, or gives an earlier contact, or is
// unresolved. Segments are searched some at a time, in their order, so that what is found first is
// early. Once the share that an unresolved pair leaves is spent, the unresolved pair is the end,
// and what is before it is proven. Where there is not work enough for that, what is left goes to
// what is proven soonest: part after part of the motion, the first a short one, from where nothing
// is resolved on.
//
// THE LIMIT ends the search, and changes nothing before that: what is tried, and in which order,
// depends on the units that were taken, not on those that are allowed. So a higher limit never
// takes more units for what a lower one decides, but where this one has come to its last eighth:
// that is the time for what has not been decided.
//
// THE LEAST DISTANCE. Asked last, when it is known whether they come within the clearance. Contacts
// lower the clearance: it begins as a distance that two vertices have, and whenever triangles are
// found nearer than that, it becomes their distance less `measure`. What has been separated stays
// separated, by more than that. So both are one search whose question shrinks, and in the end all
// of the motion that matters is proven free at the clearance that matters.
//
// Work is counted in units: a plane sought for two hulls, 16 triangles against the box of 16, one
// of them against these, a triangle pair at one time, a ray against 16 triangles or one. Spheres,
// slabs and planes that held before are not counted. A query stops within one patch's entries, or
// one ray, of its limit: nsvcd__is_exhausted.
#pragma once
#include "../body/geometry.h"
#include "../motion/motion.h"

#ifndef NSVCD_NO_PROOF
// THE SCHEDULE, in the order in which a query comes to it. A budget is in units of work.
//
// The search hands over patch pairs as it finds them.
#define NSVCD__FRESH \
  48  // patch pairs on which nothing has been tried: there is room for so many
#define NSVCD__NEWS 8  // and so many are worth a look before the search goes on

// A look tries planes and seeks witnesses, in the deepest patch pair first.
// In patch pairs deeper than this a witness is sought before any plane is tried.
#define NSVCD__DEEP 0.2f
// Steps of Gilbert's iteration, for a plane between two hulls.
#define NSVCD__PLANE_STEPS 12
// After so many failed looks for a witness, triangles are tried as well; after so many, where all
// that is asked is yes or no, no more witnesses are sought.
#define NSVCD__HOPE 8
#define NSVCD__DESPAIR 128
// Remembered heights over the plane that held last: of moving patches, and of resting ones.
#define NSVCD__HEIGHTS 256
#define NSVCD__REST_HEIGHTS 64

// What no plane separates is resolved by its triangles, arc by arc.
// Room for such patch pairs. When it is full, they are resolved first.
#define NSVCD__PATCH_PAIRS 256
// Blocks of a resting patch that are loaded at once.
#define NSVCD__WINDOW 8
// A interval is halved for all its triangle pairs once these have asked for more parts than this,
// if it is longer than this fraction of an arc.
#define NSVCD__PATIENCE_TO_PART 1
#define NSVCD__SHORTEST 0.015
// A plane is tried on all of two patches once it has separated so many of their triangle pairs in
// a row.
#define NSVCD__SHARED 4
// Parts of an arc that wait; halvings of a interval for one triangle pair; remembered poses.
#define NSVCD__ARC_PARTS 8
#define NSVCD__HALVINGS 40
#define NSVCD__PLACED 8
// In units of all lengths: a distance in double that is none; and one too short to halve for.
#define NSVCD__SAME_POSITION 1e-13
#define NSVCD__TOO_NEAR 1e-9
// After an unresolved pair 1 / this of the budget is left; where the first contact is sought, so
// many units.
#define NSVCD__AFTER_UNRESOLVED 8
#define NSVCD__AFTER_FIRST_UNRESOLVED 3000

// What else a question asks.
// The budget of the first attempt, before the two ends of the motion are tried by themselves.
#define NSVCD__LONG 6000
// The budget at each end.
#define NSVCD__END_BUDGET 1000
// The budget for triangles that meet where one body is inside the other.
#define NSVCD__INSIDE_BUDGET 200
// Times that the search for a first bound of the distance alternates between when and where the
// bodies are nearest.
#define NSVCD__TURNS 2
// A long motion. An interval of many arcs is tried with a small budget, and so is what is hard.
#define NSVCD__TRY 64
// What takes no more than this is easy. Then the next try takes so many times as many arcs; after
// a try in vain so many times fewer, and up to so many intervals must be easy before the next.
#define NSVCD__EASY 16
#define NSVCD__LARGER 4
#define NSVCD__SMALLER 8
#define NSVCD__WAIT 64
// The least distance is measured in passes, each so many times finer.
#define NSVCD__FINER 2
// Segments that are searched together where the first contact is sought.
#define NSVCD__IN_ORDER 4
// If that exhausts its budget, the motion is proven part by part. The first part, in segments; and
// the budget of a part besides eight times that of the part before.
#define NSVCD__FIRST_PART 0.0625
#define NSVCD__PART_BUDGET 250

// Where there is a slop: contacts at the start that are looked at together; directions in which
// they are undone; looks at what is touched on the way off; and the share of the slop that is kept
// where a body is set down.
#define NSVCD__TOUCHES 26
#define NSVCD__PUSH_OUTS 6
#define NSVCD__DEEPEN 16
#define NSVCD__SET_DOWN 0.02
// An epsilon, of all lengths, is what a float of an answer can tell. A safe place is so many of
// them before a contact.
#define NSVCD__LEAST_EPSILON 1.2e-7
#define NSVCD__EPSILONS 3

// Contact points are sought along so many directions, and along two across the line that they
// interval if their width is less than so much of its length; in so many patch pairs.
#define NSVCD__AROUND 8
#define NSVCD__SUPPORTS 10
#define NSVCD__SLIM 0.3
#define NSVCD__HOLDS 64
// Containment: triangles that a ray may cross.
#define NSVCD__CROSSED 128
#define NSVCD__NEVER 1e300  // ticks

typedef struct nsvcd__patch_pair {
  uint16_t moving, fixed, segment;
  uint16_t sought;  // 1: a witness has been looked for
  // 1 - least distance of the centres / (r1 + r2)
  float depth;
  // of the segment, gone by at that time
  float fraction;
} nsvcd__patch_pair;

// How a body turns over an arc.
typedef struct nsvcd__slerp {
  // at its poses before and after: unit, on the shorter side
  nsvcd__dquat start, end;
  double half_angle;  // between them as quaternions: half the angle of the turn
  // where between these poses the arc begins, and how much of the way it lasts
  double from, fraction;
} nsvcd__slerp;

// The motion between two keyframes, in double and in the fixed body's units.
typedef struct nsvcd__arc {
  // when it begins, and how long it lasts; no ticks: none
  uint32_t first, ticks;
  int fixed_moves;
  // of the moving body
  double scale;
  nsvcd__slerp moving;  // as the fixed body sees it; where that moves, in the world, and so is
  nsvcd__slerp fixed;   // the fixed body's own
  // from the fixed body's origin to the moving one's, and how it changes; in the same axes
  nsvcd__d3 from, moved;
  // what is added to that as the fixed body sees it
  nsvcd__d3 push_out;
  // of the turn where the arc begins, unit: as the fixed body has it, and as the moving one has it;
  // and by how much it deviates from either, an angle, where both bodies turn
  nsvcd__d3 axis, own_axis;
  double waver;
  // over the arc, as the fixed body sees it: radians, and the way of the moving origin, at most
  double turn, speed;
  // What points leave their chord by: a metre from the turn's axis; a metre from the moving body's
  // origin besides, where both bodies turn; and that origin itself.
  double bend, twist, origin_bend;
} nsvcd__arc;

// A pose in double.
typedef struct nsvcd__dtransform {
  nsvcd__dmat3 rotation;
  nsvcd__d3 position;
} nsvcd__dtransform;

// A interval of the motion. t in [0,1]. In it the true place of a point of the moving body at r
// metres from its origin is off the chord between its places at both ends by no more than origin
// deviation + bend r, and what float computation of it is off by is no more than
// `rounding`.
typedef struct nsvcd__interval {
  nsvcd__transform start, end;
  double t_start, t_end;
  float rounding, origin_bend, bend;
  // unit; of the turn from start to end, and of the origin's way
  nsvcd__f3 axis, heading;
  // the same along the axis; and origin bend across the way
  float bend_along_axis, origin_along_axis, origin_off_heading;
} nsvcd__interval;

// 16 triangles of a patch, lane by lane: corners (corner, axis, lane), and their boxes.
typedef struct nsvcd__block {
  float corners[3][3][NSVCD__LANES];
  float low[3][NSVCD__LANES], high[3][NSVCD__LANES];
  size_t patch, first, count;  // entries
} nsvcd__block;

typedef struct nsvcd__pair_contact {
  double tick;      // when
  double distance;  // of the triangles
  // the fixed body's frame; out of the fixed body
  nsvcd__d3 point, normal;
  uint32_t moving_triangle, fixed_triangle;
  uint32_t moving_entry, fixed_entry;
  uint16_t moving_patch, fixed_patch;
} nsvcd__pair_contact;

// How the moving body goes, as the fixed one sees it: a point x by `along` and turn x x in a tick.
typedef struct nsvcd__twist {
  nsvcd__d3 along, turn;
} nsvcd__twist;

// Two triangles that touch at the start, as the fixed body sees them.
typedef struct nsvcd__triangle_contact {
  nsvcd__d3 moving[3], fixed[3];
  // directions that may undo it, unit: against the normal of the moving one; the normal of the
  // fixed one; and from its nearest point to that of the moving one, 0 if they meet
  nsvcd__d3 directions[3];
} nsvcd__triangle_contact;

// Places where the bodies touch when a contact is: proof/manifold.
typedef struct nsvcd__manifold {
  // unit: the contact's, and directions across it
  nsvcd__d3 normal, along[NSVCD__SUPPORTS];
  nsvcd__twist twist;
  // nearer than `tolerance` is touching; nearer to each other than `same` is the same place
  double tolerance, same;
  // the farthest along each: how far that is, -HUGE_VAL: there is none, HUGE_VAL: it is not
  // sought; and the number of the corner or the edges
  nsvcd__pair_contact supports[NSVCD__SUPPORTS];
  double farthest[NSVCD__SUPPORTS];
  uint32_t numbers[NSVCD__SUPPORTS];
} nsvcd__manifold;

// What is done with triangles that come within the clearance: they are contacts; or, of a motion at
// rest, all are gathered, as touches or as supports.
typedef enum nsvcd__collecting {
  NSVCD__CONTACTS,
  NSVCD__TOUCHING,
  NSVCD__SUPPORTING
} nsvcd__collecting;

// What is said of a question in the end.
typedef enum nsvcd__finding {
  NSVCD__FOUND_FREE,
  NSVCD__FOUND_CONTACT,
  NSVCD__FOUND_INSIDE,
  NSVCD__FOUND_NEITHER
} nsvcd__finding;

// What becomes of a part of it: a pair of patches, or of triangles, over a interval of the motion.
typedef enum nsvcd__outcome {
  // separated, or kept as an unresolved pair, or no longer asked about
  NSVCD__RESOLVED,
  // the same of all triangles of both patches
  NSVCD__ALL_RESOLVED,
  // where a contact was looked for, there is none
  NSVCD__NOTHING,
  // a contact was found that answers the question
  NSVCD__ANSWERED,
  // a contact was found that shrinks the question: ask again
  NSVCD__SHRUNK,
  // the interval is to be looked at again: in halves, or with a clearance that is less
  NSVCD__TOO_LONG,
  // the work allowed is: from then on it always is
  NSVCD__EXHAUSTED
} nsvcd__outcome;

// A pose that has been computed.
typedef struct nsvcd__placed {
  uint32_t arc, ticks;  // as the arc has them
  double u;
  nsvcd__dtransform transform;
} nsvcd__placed;

// A patch's height over a plane, of a moving patch in a segment.
typedef struct nsvcd__height {
  uint32_t plane, key;
  float height;
} nsvcd__height;

// The question, in the fixed body's units.
typedef struct nsvcd__given {
  // extents of both bodies
  float lengths;
  // beyond the quantization errors
  double tolerance;
  double clearance, slop;
  // how far both bodies together go beyond their triangles: the clearance has that in it
  double radius;
  // to which share of the motion the first contact is asked for, and to which width the least
  // distance; 0: it is not
  double fraction, width;
  // FIRST: how far bodies may be from each other when the motion ends; 0: nothing is said
  double to;
  // is more asked for than yes or no?
  int tells;
  // The budget, of all or, if it grows, of each interval of a long motion; and the part of it that
  // what is beside the question may take, above all what follows an unresolved pair.
  size_t work, aside;
  int grows;
} nsvcd__given;

// What is asked at a time, of a motion. A search only ever makes it less: a contact is two
// triangles that come within the clearance. With `measure` each contact makes that the distance of
// its triangles, less this; with `first` each ends the motion so many ticks before it. So what is
// proven in the end holds for the rest.
typedef struct nsvcd__asked {
  nsvcd__motion *motion;
  // ticks: what begins then or later does not matter
  double end;
  // The first unresolved pair ends the search, too.
  int unresolved_ends;
  double clearance, measure;
  // a share of the motion, and as ticks
  double fraction, first;
  // Budgets: of this search, of all, and of what goes on after an unresolved pair.
  size_t limit, most, after_unresolved;
  // A first attempt, with a small budget.
  int is_brief;
  nsvcd__collecting collects;
  // how deep touches may be
  double slop;
} nsvcd__asked;

// What is known, of a motion.
typedef struct nsvcd__known {
  int has_contact;
  nsvcd__pair_contact found;
  // ticks: when the first unresolved pair begins, two triangles too near to tell; and these
  double unresolved;
  nsvcd__pair_contact unresolved_pair;
  // the work allowed was not enough: all from `resolved` on, ticks, is undecided
  int lost;
  double resolved;
} nsvcd__known;

// What is only remembered: where there is an NSVCD__PAUSE it may be forgotten, and what is proven
// then is as true; only the work may differ. Zeros: nothing.
typedef struct nsvcd__memo {
  // poses in arcs, the next to be forgotten
  nsvcd__placed placed[NSVCD__PLACED];
  size_t next_placed;
  // segments that have been made intervals
  uint64_t intervals;
  // the normal of the plane between hulls that held last, how many held before, 0: none; and over
  // it the heights of patches, moving ones and resting ones
  nsvcd__f3 held;
  uint32_t plane;
  nsvcd__height heights[NSVCD__HEIGHTS], rest_heights[NSVCD__REST_HEIGHTS];
  // unit: of the plane that separated a triangle pair last
  nsvcd__d3 separating;
  // how many triangle pairs it has separated after that, one after the other
  size_t shared;
  // how many blocks of a resting patch are in p->fixed_blocks; is one in p->moving_block?
  size_t window;
  int has_block;
} nsvcd__memo;

typedef struct nsvcd__proof {
  nsvcd__geometry moving, fixed;
  nsvcd__given given;
  nsvcd__asked ask;
  nsvcd__known known;
  nsvcd__memo memo;
  // the last one asked for, if it has ticks; patch pairs and triangle pairs are looked at within it
  nsvcd__arc arc;
  size_t work;
  // the least distance is known to be between these
  double low, high;

  // Containment, at the start: a component seems to be within the other body, but close to its
  // surface; a point of it, in the fixed body's frame; or that could not be told.
  int inside;
  nsvcd__d3 enclosed;
  int unclear;
  // it could not, since the other is nearly a solid, but not closed
  int in_open;
  // there was not work enough to know the least distance as narrowly as was asked for
  int wide;
  // FIRST: nothing of the motion is proven free but its start
  int starts_free;

  // With a slop: how many touches have been gathered that a push-out along no normal known undoes;
  // the normals, unit, of what the moving body touches, towards it.
  size_t contact_count, normal_count;
  // one has been found that nothing undoes; of directions that undo as many, which have more faces
  // counts, not which is shorter
  int too_deep, by_faces;
  nsvcd__d3 normals[NSVCD__PUSH_OUTS];
  // how deep it is in contact along each; and by how much a plane normal to one is to be pushed out
  double depths[NSVCD__PUSH_OUTS];
  double needed;

  // Segments as intervals (S), where the memo says so; which have been cut off, and the end, ticks,
  // when that was done last.
  nsvcd__interval *intervals;
  uint64_t clipped;
  double clipped_end;

  // segments in which 16 resting patches are met
  uint64_t met_in[NSVCD__GROUP];
  // Patch pairs: as the search finds them, and those that no plane separates over their segment;
  // and looks for a witness that found none.
  size_t fresh_count, count, misses;
  nsvcd__patch_pair fresh[NSVCD__FRESH];
  union {
    struct {
      nsvcd__patch_pair items[NSVCD__PATCH_PAIRS];
      nsvcd__manifold manifold;
    } kept;
    // gathered before there are any
    nsvcd__triangle_contact touches[NSVCD__TOUCHES];
  } of;

  // A patch pair: its hulls, posed, and its triangles, block by block, with boxes about the fixed
  // blocks.
  float hull_start[3][NSVCD__LANES], hull_end[3][NSVCD__LANES], hull_rest[3][NSVCD__LANES];
  nsvcd__block moving_block, fixed_blocks[NSVCD__WINDOW];
  nsvcd__box bounds[NSVCD__WINDOW];
  // The moving block's corners at the start of the interval `over`, and at its end (corner, axis,
  // lane). NULL: 3, at one pose.
  const nsvcd__interval *over;
  float corners[6][3][NSVCD__LANES];
  size_t corner_count;

  // A patch pair over an arc, and a triangle pair: later ends of the parts to come, the last one
  // first; and how many parts of the interval its triangle pairs asked for.
  nsvcd__interval interval;
  double arc_ends[NSVCD__ARC_PARTS];
  double pair_ends[NSVCD__HALVINGS + 2];
  size_t parts;
  // how often a plane has been tried on all of both patches
  size_t all_tried;

  // triangles that a ray has crossed
  uint32_t crossed[NSVCD__CROSSED];
} nsvcd__proof;

// Forgets all that is only remembered. The tests do so at random, where NSVCD__PAUSE stands.
static void nsvcd__forget(nsvcd__memo *memo) {
  memset(memo, 0, sizeof *memo);
}
#ifndef NSVCD__PAUSE
#define NSVCD__PAUSE(p) ((void)0)
#endif

// A limit that leaves so many units, if there are as many.
static size_t nsvcd__limit_after(const nsvcd__proof *p, size_t units) {
  const size_t left = p->work < p->ask.most ? p->ask.most - p->work : 0;
  return left > units ? p->work + units : p->ask.most;
}

// What the search for the first contact may take; the rest is for what can be proven by time.
static size_t nsvcd__limit_of_first(const nsvcd__proof *p) {
  return p->ask.most - p->given.aside;
}

// Is all work done that is allowed? Where the first contact is sought, what an unresolved pair has
// left for contacts after it may be: then the unresolved pair becomes the end here, and what comes
// before it can be proven.
static int nsvcd__is_exhausted(nsvcd__proof *p) {
  nsvcd__asked *ask = &p->ask;
  if (p->work > ask->limit && ask->first > 0 && !ask->is_brief && !ask->unresolved_ends &&
      p->known.unresolved < NSVCD__NEVER) {
    ask->unresolved_ends = 1;
    ask->end = nsvcd__min(ask->end, p->known.unresolved);
    const size_t left = (NSVCD__AFTER_UNRESOLVED - 1) * p->given.aside;
    ask->limit = nsvcd__limit_of_first(p);
    if (p->work + left < ask->limit) ask->limit = p->work + left;
  }
  return p->work > ask->limit;
}

// The clearance, in float: not less.
static float nsvcd__clearance(const nsvcd__proof *p) {
  return 1.000001f * (float)p->ask.clearance;
}

// How far triangles may be off the meshes', both together.
static double nsvcd__off_meshes(const nsvcd__proof *p) {
  const double moving = (double)nsvcd__off_mesh(&p->moving);
  return p->ask.motion->ratio * moving + (double)nsvcd__off_mesh(&p->fixed);
}

// What stored points of two patches may be off by, both together.
static float nsvcd__quanta_of(const nsvcd__proof *p, size_t i, size_t j) {
  return p->ask.motion->scale * p->moving.errors[i] + p->fixed.errors[j];
}

// How far points of the moving body are, in its own units, as bends have it: none is
// farther from its origin than `from_origin`, nor from the line through that along the axis of a
// turn than `from_axis`.
typedef struct nsvcd__arm {
  float from_origin, from_axis;
} nsvcd__arm;

// Of a sphere. axis: unit, as the body has it; radial is rounded for that, too.
static nsvcd__arm nsvcd__arm_of(nsvcd__f3 centre, float radius, nsvcd__f3 axis) {
  const float distance = nsvcd__f3_length(centre);
  const float aside = nsvcd__f3_length(nsvcd__f3_cross(centre, axis));
  const nsvcd__arm out = {1.000001f * (distance + radius),
                          1.000001f * (aside + radius) + 1e-6f * distance};
  return out;
}

// Tests hear of every plane of slabs, hulls and triangles (spheres and boxes have tests of their
// own): kind, patches, entries (or NSVCD_NONE), times, and the plane's normal (3), fixed body's
// frame, which points to the moving side.
#ifndef NSVCD__CERTIFY
#define NSVCD__CERTIFY(kind, moving, fixed, moving_entry, fixed_entry, t_start, t_end, \
                       normal) \
  ((void)(moving), (void)(fixed), (void)(moving_entry), (void)(fixed_entry), (void)(t_start), \
   (void)(t_end), (void)(normal))
#endif
enum { NSVCD__BY_SLAB, NSVCD__BY_HULL, NSVCD__BY_TRIANGLES };
#endif  // NSVCD_NO_PROOF
