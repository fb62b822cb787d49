// SPDX-License-Identifier: MIT
// nsvcd_verify.h - checks a certificate that two moving bodies never meet, or that they do. It
// shares no line with neuralsvcd.h, which makes certificates (nsvcd_certify): who doubts that one
// reads this one, with nsvcd_verify_scene.h (meshes, motions) and nsvcd_verify_rays.h (what is
// inside, what meets). C99 or C++11, libc and libm; nothing global, no allocation, no recursion.
// MIT licence (LICENSE).
//
// STATEMENT. Two movers, a and b, each have a mesh (triangles, corners x in float), a scale s and a
// motion: at a time t in [0,1] x is at s R(t) x + p(t), by one clock and in one frame for both. What
// nsvcd_verify accepts as
//   FREE    proves: at no time does a point of a's triangles come within the clearance of one of
//           b's, and never is a component of one inside what closed components of the other
//           enclose;
//   HIT     at report.time an edge of one passes through a triangle of the other;
//   NEAR    at report.time points of two triangles are nearer to each other than the clearance;
//   INSIDE  at report.time a corner of one is inside what closed components of the other enclose.
// A component is triangles joined by corners at the same place; it is closed if each of its edges
// goes there and back equally often; closed components enclose what they, together, wind about a
// number of times that is not 0. So the space in a box is inside, whichever way its walls all face.
// Nothing is inside of the hollow of a room with thick walls, of a box whose walls are there twice,
// both ways round, or of a component that is not closed, as one with a stray triangle at a corner.
//
// WHY. FREE is a walk over (node of a's tree, node of b's, stretch of time), which begins with both
// roots and [0,1]. A visit reads one code:
//   0           visit, in place of the node whose box is longer (of equals a's), its children
//   100         visit, in place of the stretch, its halves
//   11          they are parted by a plane with the normal that was used last
//   101 normal  they are parted by a plane with this normal
// So in the end any two triangles are parted at any time. A plane of normal n parts two nodes from
// t0 to t1, with no knot between, if at both ends
//   n.(p_a - p_b) + min over a's node of n.(s R x) - max over b's node of n.(s R x)          (1)
// is more than clearance |n| and what both bodies' points deviate along n. For of any two points, one
// of each node, n.(x - y) is no less than (1) at the ends, so no less than the lesser on the chord
// between, and each point leaves its chord by its deviation at most. That goes with the distance from the
// body's origin, or, in a turn about one axis, with that from the axis (nsvcd_verify_scene.h): a
// shaft that turns in a bore hardly deviates. Over a box n.(s R x) is a sum over three sides, and so is
// each coordinate of x cross the axis; over few triangles both are most at corners.
//   Surfaces that never meet do not get inside of each other later on, for how often one winds
// about a point of the other changes only where they meet. If at some time the roots are parted,
// nothing is inside then. Else a ray follows for each component of a, from a corner of it at t = 0,
// then for each of b. It crosses the closed components of the other, summed, as often inwards as
// outwards, and passes no edge too near to tell. So these do not wind about that corner, nor about
// the rest of its component, which does not cross them.
//
// ARITHMETIC. All is computed in double, from floats. No number in (1) is off by more than 1e-11 of
// all lengths in it, those of poses before and after included: sums of some ten products, roots,
// and libm's sin and atan2 are good to units of 1e-16, a share of the way between two of 65,536
// poses to 1e-11. Joints that turn by 250 radians are off by 3.5e-13 radians each, and 128 of them
// by 5e-11 of all lengths. VERIFY__MARGIN, 1e-10 of all lengths, is asked for beyond that, of planes
// and of rays. Uniform poses are at the doubles k / (count - 1). Digests only catch mix-ups: no
// proof rests on them. formal/margins has gappa prove what paths are off by, a seventh of that margin, if
// libm's sin and atan2 are good to a share of 2^-50.
//   NaN and infinity are refused on their bits, in meshes, scales, motions and clearances. From
// what remains none arises: nothing is divided by 0, and nothing comes near 1e100. A motion of your
// own (nsvcd_verify_mover) may still place something at a NaN: what is compared with it is false,
// and then nothing is parted. Refused as it is compiled: -ffast-math and parts of it that have a
// macro, and a float or double that is not IEEE's. Refused as it runs (verify__arithmetic): a
// thread that does not round to the nearest double or takes subnormal floats for 0, and a build
// that reorders sums, divides by reciprocals, or has no NaN. Harmless: fused products, zeros
// without a sign, no infinities, doubles too small to be normal, and registers wider than a double
// (x87), but that of a turn by 180 degrees, to 1e-16, they may take the other way round.
#ifndef NSVCD_VERIFY_H
#define NSVCD_VERIFY_H
#include "nsvcd_verify_rays.h"

#define VERIFY__EXACT 24        // triangles: of no more, corners count; of more, the box
#define VERIFY__SHORTEST 1e-12  // the shortest stretch that is halved
#define VERIFY__STACK 128       // two trees of 30 levels, and 40 halvings

typedef struct verify__visit {
  nsvcd_verify_node a, b;
  double t0, t1;
} verify__visit;

/*@ predicate a_visit(verify__visit *v, verify__reader *r) =
      \valid_read(v) && a_node(&v->a, r->a->mesh) && a_node(&v->b, r->b->mesh); */

// ---- planes

// The most of n.(s R x) over a node. Where R is not finite no height of a corner is, so that it does
// not matter that one after a NaN takes its place: of what is not finite nothing is parted.
/*@ requires a_mover(mover) && \valid_read(node) && a_node(node, mover->mesh);
    requires \valid_read(turn + (0 .. 8)) && \valid_read(n + (0 .. 2));
    assigns \nothing; */
static inline double verify__most(const nsvcd_verify_mover *mover, const nsvcd_verify_node *node,
                                  const double *turn, const double *n, int exact) {
  const nsvcd_verify_mesh *m = mover->mesh;
  const float *low = m->boxes + 6 * (size_t)node->box;
  double way[3], most = 0;
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, most, way[0 .. 2];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) {
    way[i] = mover->scale * (n[0] * turn[i] + n[1] * turn[3 + i] + n[2] * turn[6 + i]);
    most += way[i] * (double)low[way[i] > 0 ? i + 3 : i];
  }
  if (!exact || node->count > VERIFY__EXACT) return most;
  most = -VERIFY__BEYOND;
  /*@ loop invariant 0 <= i <= 3 * node->count;
      loop assigns i, most;
      loop variant 3 * node->count - i; */
  for (uint32_t i = 0; i < 3 * node->count; i++) {
    const float *x = verify__corner(m, m->order[node->first + i / 3], i % 3);
    const double along = way[0] * (double)x[0] + way[1] * (double)x[1] + way[2] * (double)x[2];
    if (!(along <= most)) most = along;
  }
  return most;
}

// No point of a node is farther from the line through its body's origin along a unit axis.
/*@ requires a_mover(mover) && \valid_read(node) && a_node(node, mover->mesh);
    requires \valid_read(axis + (0 .. 2));
    assigns \nothing; */
static inline double verify__aside(const nsvcd_verify_mover *mover, const nsvcd_verify_node *node,
                                   const double *axis, int exact) {
  const nsvcd_verify_mesh *m = mover->mesh;
  const float *low = m->boxes + 6 * (size_t)node->box;
  const int corners = exact && node->count <= VERIFY__EXACT;
  double off[3], most = 0;
  /*@ loop invariant 0 <= c <= 3 * node->count;
      loop assigns c, most, off[0 .. 2];
      loop variant 3 * node->count - c; */
  for (uint32_t c = 0; c < (corners ? 3 * node->count : 1); c++) {
    const float *x = verify__corner(m, m->order[node->first + c / 3], c % 3);
    double middle[3], half[3];
    /*@ loop invariant 0 <= i <= 3;
        loop assigns i, middle[0 .. 2], half[0 .. 2];
        loop variant 3 - i; */
    for (int i = 0; i < 3; i++) {
      middle[i] = corners ? (double)x[i] : 0.5 * ((double)low[i] + (double)low[i + 3]);
      half[i] = corners ? 0 : 0.5 * ((double)low[i + 3] - (double)low[i]);
    }
    /*@ loop invariant 0 <= i <= 3;
        loop assigns i, off[0 .. 2];
        loop variant 3 - i; */
    for (int i = 0; i < 3; i++) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      off[i] = fabs(middle[j] * axis[k] - middle[k] * axis[j]) + half[j] * fabs(axis[k]) +
               half[k] * fabs(axis[j]);
    }
    most = verify__max(most, verify__dot(off, off));
  }
  return 1.000001 * mover->scale * sqrt(most);
}

// What the points of a node deviate along a normal, from a place on.
/*@ requires a_mover(mover) && \valid_read(node) && a_node(node, mover->mesh);
    requires \valid_read(at) && \valid_read(deviation + (0 .. 5)) && \valid_read(n + (0 .. 2));
    assigns \nothing; */
static inline double verify__deviation_along(const nsvcd_verify_mover *mover,
                                             const nsvcd_verify_node *node,
                                             const nsvcd_verify_place *at, const double *deviation,
                                             const double *n, int exact) {
  double axis[3], across[3];
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, axis[0 .. 2];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) axis[i] = verify__dot(at->turn + 3 * i, deviation + 3);
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, across[0 .. 2];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++)
    across[i] = n[(i + 1) % 3] * axis[(i + 2) % 3] - n[(i + 2) % 3] * axis[(i + 1) % 3];
  const double turn = deviation[2] * verify__aside(mover, node, deviation + 3, exact);
  const double any = deviation[0] + deviation[1] * verify__radius(mover, node);
  return sqrt(verify__dot(n, n)) * any + sqrt(verify__dot(across, across)) * turn;
}

// Does the plane of the last normal part two nodes at all instants and between them?
/*@ requires \valid_read(r) && a_mover(r->a) && a_mover(r->b) && a_visit(v, r);
    requires \valid_read(r->instants + (0 .. r->count - 1));
    assigns \nothing; */
static inline int verify__parts(const verify__reader *r, const verify__visit *v, int exact) {
  const double *n = r->normals[0];
  const double back[3] = {-n[0], -n[1], -n[2]};
  const double length = sqrt(verify__dot(n, n));
  const double ra = verify__radius(r->a, &v->a);
  const double rb = verify__radius(r->b, &v->b);
  const double reach = r->a->reach + r->b->reach;
  // a normal of 0 parts nothing: gap and least are 0
  double last = VERIFY__BEYOND;
  double last_lengths = 0;
  double deviation = 0;
  /*@ loop invariant 0 <= i <= r->count;
      loop assigns i, last, last_lengths, deviation;
      loop variant r->count - i; */
  for (size_t i = 0; i < r->count; i++) {
    const verify__instant *at = &r->instants[i];
    const double lengths = verify__lengths(ra + rb + r->clearance + reach, &at->a, &at->b);
    if (!(lengths < VERIFY__BEYOND)) return 0;  // a maximum would lose a NaN
    const double margin = VERIFY__MARGIN * verify__max(lengths, last_lengths);
    double gap = -verify__most(r->a, &v->a, at->a.turn, back, exact);
    gap -= verify__most(r->b, &v->b, at->b.turn, n, exact);
    /*@ loop invariant 0 <= k <= 3;
        loop assigns k, gap;
        loop variant 3 - k; */
    for (int k = 0; k < 3; k++) gap += n[k] * (at->a.at[k] - at->b.at[k]);
    const double least = length * (r->clearance + margin) + deviation;
    if (!(gap > least && last > least && gap < VERIFY__BEYOND)) return 0;
    last = gap;
    last_lengths = lengths;
    deviation = verify__deviation_along(r->a, &v->a, &at->a, at->deviation_a, n, exact) +
                verify__deviation_along(r->b, &v->b, &at->b, at->deviation_b, n, exact);
  }
  return 1;
}

// ---- the walk

// Places both bodies at t0, at t1, and at all knots between. 0: there is no room.
/*@ requires at_work(r);
    assigns r->count, r->instants[0 .. r->capacity - 1];
    ensures r->count <= r->capacity; */
static inline int verify__instants(verify__reader *r, double t0, double t1) {
  double t = t0;
  for (r->count = 0; r->count < r->capacity; t = verify__min(t, t1)) {
    verify__instant *at = &r->instants[r->count++];
    memset(at, 0, sizeof *at);  // the last one deviates no more
    at->t = t;
    r->a->place(r->a->motion, t, &at->a);
    r->b->place(r->b->motion, t, &at->b);
    if (!(t < t1)) return 1;
    t = verify__min(r->a->next(r->a->motion, t), r->b->next(r->b->motion, t));
    r->a->deviation(r->a->motion, at->t, verify__min(t, t1), at->deviation_a);
    r->b->deviation(r->b->motion, at->t, verify__min(t, t1), at->deviation_b);
  }
  return 0;
}

// The longest side of a node's box.
/*@ requires a_mover(mover) && \valid_read(node) && a_node(node, mover->mesh);
    assigns \nothing; */
static inline double verify__side(const nsvcd_verify_mover *mover, const nsvcd_verify_node *node) {
  const float *low = mover->mesh->boxes + 6 * (size_t)node->box;
  double most = 0;
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, most;
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) most = verify__max(most, (double)low[i + 3] - (double)low[i]);
  return verify__stored(mover->scale * most);
}

// Puts two visits in place of one: v, and the one after it on the stack, which comes first.
/*@ requires \valid_read(r) && a_mover(r->a) && a_mover(r->b) && a_visit(v, r);
    requires \valid(v + (0 .. 1)) && \separated(v + (0 .. 1), r, r->a, r->b, r->a->mesh, r->b->mesh);
    assigns v[0 .. 1];
    ensures \result != 0 ==> a_visit(v, r);
    ensures \result != 0 ==> a_visit(v + 1, r); */
static inline int verify__descend(const verify__reader *r, verify__visit *v) {
  const int longer = verify__side(r->a, &v->a) >= verify__side(r->b, &v->b);
  const int opens_a = v->b.count == 1 || (v->a.count > 1 && longer);
  const nsvcd_verify_node *node = opens_a ? &v->a : &v->b;
  nsvcd_verify_node child[2];
  if (node->count == 1) return 0;
  verify__children(node, child);
  //@ assert opens_a ==> a_node(&child[0], r->a->mesh) && a_node(&child[1], r->a->mesh);
  //@ assert !opens_a ==> a_node(&child[0], r->b->mesh) && a_node(&child[1], r->b->mesh);
  v[1] = *v;
  //@ assert a_visit(v, r);
  //@ assert a_visit(v + 1, r);
  if (opens_a) {
    v[0].a = child[1];
    //@ assert a_visit(v, r) && a_visit(v + 1, r);
    v[1].a = child[0];
    //@ assert a_visit(v, r) && a_visit(v + 1, r);
  } else {
    v[0].b = child[1];
    //@ assert a_visit(v, r) && a_visit(v + 1, r);
    v[1].b = child[0];
    //@ assert a_visit(v, r) && a_visit(v + 1, r);
  }
  return 1;
}

/*@ requires at_work(r) && r->at <= r->bits + 64;
    assigns r->at, r->apart, r->count, *(&r->normals[0][0] + (0 .. 23)),
            r->instants[0 .. r->capacity - 1]; */
static inline const char *verify__walk(verify__reader *r) {
  verify__visit stack[VERIFY__STACK];
  size_t height = 1;
  memset(stack, 0, sizeof *stack);
  stack->a.count = (uint32_t)r->a->mesh->triangles;
  stack->b.count = (uint32_t)r->b->mesh->triangles;
  stack->t1 = 1;
  double t0 = -1, t1 = -1;
  /*@ loop invariant 0 <= height <= VERIFY__STACK && r->at <= r->bits + 64;
      loop invariant r->count <= r->capacity;
      loop invariant \forall integer i; 0 <= i < height ==> a_visit(&stack[i], r);
      loop assigns height, t0, t1, stack[0 .. VERIFY__STACK - 1], r->at, r->apart, r->count,
                   *(&r->normals[0][0] + (0 .. 23)), r->instants[0 .. r->capacity - 1]; */
  while (height > 0) {
    verify__visit *v = &stack[height - 1];
    if (v->t0 != t0 || v->t1 != t1) {
      t0 = v->t0;
      t1 = v->t1;
      if (!verify__instants(r, t0, t1)) return "the workspace has no room for all knots";
    }
    const int opens = !verify__read(r, 1);
    const int same = !opens && verify__read(r, 1);
    const int halves = !opens && !same && !verify__read(r, 1);
    if (!opens && !halves) {
      if (!same) verify__read_normal(r);
      if (r->at > r->bits) return "it ends early";
      if (!verify__parts(r, v, 0) && !verify__parts(r, v, 1))
        return "a plane does not part its nodes";
      // box 0 is the root's alone: a child's number is more than its parent's
      if (v->a.box == 0 && v->b.box == 0) r->apart = 1;
      height--;
      continue;
    }
    if (r->at > r->bits) return "it ends early";
    if (height == VERIFY__STACK || (halves && t1 - t0 < VERIFY__SHORTEST)) return "it is too deep";
    if (opens && !verify__descend(r, v)) return "it opens triangles";
    if (halves) {  // exactly: an end is a multiple of 2^-40
      v[1] = *v;
      v[1].t1 = v->t0 = 0.5 * (t0 + t1);
    }
    height++;
  }
  return NULL;
}

// ---- certificates

// Bytes of the workspace that nsvcd_verify takes, for motions of so many knots together, ends
// included.
#define NSVCD_VERIFY_WORKSPACE_BYTES(keyframes) ((keyframes) * sizeof(verify__instant))

// Eight or 16 bits of a digest.
static inline uint32_t verify__fold(uint32_t digest, int bits) {
  digest ^= digest >> 16;
  return bits == 16 ? digest & 0xffff : (digest ^ digest >> 8) & 0xff;
}

// Does a certificate, which may be any bytes, prove something of two movers and a clearance in
// metres? 1: what report->kind says. 0: report->reason says why not. The workspace is aligned to 8
// bytes; threads that share a mesh take turns, for rays write to it. Takes the certificate's length
// times the knots and the joints, and for each ray the mesh.
static inline int nsvcd_verify(const nsvcd_verify_mover *a, const nsvcd_verify_mover *b,
                               float clearance, const uint8_t *bytes, size_t size, void *workspace,
                               size_t workspace_size, nsvcd_verify_report *report) {
  const uint32_t motion = verify__hash(a->digest + 31 * b->digest, &clearance, 1);
  verify__reader reader;
  verify__reader *r = &reader;
  memset(r, 0, sizeof *r);
  r->a = a;
  r->b = b;
  r->clearance = (double)clearance;
  r->bytes = bytes;
  r->bits = 8 * size;
  r->instants = (verify__instant *)workspace;
  r->capacity = workspace_size / sizeof *r->instants;
  memset(report, 0, sizeof *report);
  const char *why = verify__arithmetic();
  if (!why && (a->clock != b->clock || a->base != b->base))
    why = "the two are not seen from one link of one motion";
  const int is_known = verify__read(r, 6) == 1;
  if (!why && !is_known) why = "it is no certificate of version 1";
  const nsvcd_verify_kind kind = (nsvcd_verify_kind)(1 + verify__read(r, 2));
  const int is_a = verify__read(r, 8) == verify__fold(a->mesh->digest, 8);
  const int is_b = verify__read(r, 8) == verify__fold(b->mesh->digest, 8);
  if (!why && !is_a) why = "it is about another mesh a";
  if (!why && !is_b) why = "it is about another mesh b";
  const int is_motion = verify__read(r, 16) == verify__fold(motion, 16);
  if (!why && !is_motion) why = "it is about another motion, scale or clearance";
  if (!verify__within(clearance, 1e6f) || clearance < 0) why = "a clearance is out of range";
  if (size > SIZE_MAX / 16) why = "it is too large";
  if (!why && kind == NSVCD_VERIFY_FREE) {
    why = verify__walk(r);
    if (!why && !r->apart) why = verify__outside(r, a, b);
    if (!why && !r->apart) why = verify__outside(r, b, a);
  } else if (!why) {
    why = verify__meeting(r, kind, report);
  }
  if (!why && (r->at + 7) / 8 != size)
    why = r->at > r->bits ? "it ends early" : "something follows its end";
  report->reason = why;
  report->kind = why ? NSVCD_VERIFY_NOTHING : kind;
  report->position = (r->at < r->bits ? r->at : r->bits) / 8;
  return !why;
}
#endif  // NSVCD_VERIFY_H
