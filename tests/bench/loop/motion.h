// motion.h - the motion of one body as the other sees it: knots, and spans of time.
// In: nsvcd__motion (both bodies' poses and scales), two tree bodies. Out: the pose of a, the moving
// body, about its middle, in the frame of b about its middle and in b's units, at every knot; and
// `span`: a stretch of time, with both end poses and how far any point strays from its chord.
//
// THE BOUND. Over a span let L be the linear interpolation of a's matrix and place between the
// span's ends, and K the piecewise linear one through the knots within. A point y of a (about its
// middle, |y| <= r) is truly at M(t) y + p(t). Within an arc it strays from K by its bulge,
//   h^2 / 8 (off + r) scale,
// where h is the angle of the arc and off how far the middle is from the origin that goes straight
// (where both bodies move, arc.bulge (off + r) + arc.drift: see bend_arc). And K - L is
// largest at a knot, where it is |p_k - L| + |M_k - L| r, found for the actual knots. So all places
// of y in the span are within ea + eb r of the chord between its places at the two ends; and a plane
// that has both of these on one side by more than that, has all of the chord there, and so all
// places. `ea` also holds what all float computations may be off by: NSVCD__ROUNDING times all
// lengths that enter them. A NaN in a pose is in ea, and parts nothing.
//
// Along a direction n there is often less: n is split into its part along a unit vector w and that
// across, and along w points stray by no more than ea_w + eb_w r, with |w.(p_k - L)| and
// |(M_k - L)^T w| at knots, and within an arc that turns about a, by |w x a| of its bulge, for
// w.(a x (a x y)) = (w x a).(a x y). So |n.w| (ea_w + eb_w r) + |n x w| (ea + eb r). w is the axis
// of the turn from end to end; where nothing turns, across the way and where it bends most.
//
// Spans are numbered like a heap: 1 is all of the motion, the halves of n are 2 n and 2 n + 1. A
// span of several arcs is halved at a knot, one within an arc in the middle. They are made when they
// are asked for and kept in a small table; what is no longer there is made again. An instant is a
// span of one knot, in which a witness is looked for: nothing that is parted there is parted for good.
#ifndef LOOP_MOTION_H
#define LOOP_MOTION_H

#include "body.h"

#define SPAN_SLOTS 64
#define MOST_HALVINGS 58  // of all of the motion: 64 bits
#define ARC_SLOTS 4
#ifndef FEW_ARCS
#define FEW_ARCS 8
#endif
#define INSTANT ((uint64_t)1 << 63)  // of a span: no more than a knot, the one below

// Rows of so many knots; rows end in 16 that nobody reads for what they are.
typedef struct knot_table {
  uint32_t count, stride;
  float *matrix[9], *place[3];
  float *share;         // of the motion, gone by at the knot
  float *bulge, *drift;  // of the arc after it: strays by drift + bulge r
  float *turn[3];        // along its axis; 0 where it has none
  uint32_t *tick;
} knot_table;

typedef struct span {
  uint64_t id;
  uint32_t first, last;  // knots; within one arc where they are neighbours
  double from, to;       // shares of that arc, else 0 and 1
  float start[9], end[9], start_at[3], end_at[3];
  float ea, eb, rounding;  // ea does not hold the rounding, which holds the clearance
  float hair;              // the rounding by itself
  float w[3], ea_w, eb_w;  // along w
  float way;               // of the middle, and
  float turn;              // of what is one unit from it
  int has_ends;
  // faces' directions, not longer than 1: b's, and a's half way; as b sees them, as a does at the
  // start and the end, the middle's heights then, and strays of ea + eb reach (with rounding)
  float axes[6][3], at_start[6][3], at_end[6][3];
  float start_height[6], end_height[6];
  float axes_ea[6], axes_eb[6];
  nsvcd__placement exact_start, exact_end;  // in double
  double exact_rounding;  // of bounds found among knots in float
} span;

typedef struct motion {
  const nsvcd__motion *of;
  const tree_body *a, *b;
  float scale;    // of a
  float lengths;  // that enter computations, but for places
  float clearance;  // what comes as near as this counts as meeting; added to all rounding but hair
  float off;      // of a's middle from its origin
  knot_table knots;
  nsvcd__arc arcs[ARC_SLOTS];
  uint64_t known[SPAN_SLOTS];  // which spans
  span spans[SPAN_SLOTS];
} motion;

// ---- arcs, in double

// What both bodies' turns do: see nsvcd__cut_double_arc.
static void bend_arc(nsvcd__arc *arc) {
  const nsvcd__d3 fixed_turn = nsvcd__leg_turn(&arc->fixed);
  const nsvcd__d3 turn = nsvcd__d3_sub(nsvcd__leg_turn(&arc->moving), fixed_turn);
  const nsvcd__d3 end = nsvcd__d3_add(arc->from, arc->moved);
  const double twist = nsvcd__d3_length(nsvcd__d3_cross(turn, fixed_turn));
  const double angle = nsvcd__d3_length(fixed_turn);
  const double swing = fmax(nsvcd__d3_length(nsvcd__d3_cross(fixed_turn, arc->from)),
                            nsvcd__d3_length(nsvcd__d3_cross(fixed_turn, end)));
  const double across = nsvcd__d3_length(nsvcd__d3_cross(fixed_turn, arc->moved));
  arc->turn = nsvcd__d3_length(turn);
  arc->speed = nsvcd__d3_length(arc->moved) + swing;
  arc->bulge = 0.1250001 * arc->scale * (arc->turn * arc->turn + twist);
  arc->drift = 0.1250001 * (2 * across + angle * swing);
}

static const nsvcd__arc *arc_at(motion *m, uint32_t knot) {
  const nsvcd__motion *of = m->of;
  const uint32_t first = m->knots.tick[knot];
  nsvcd__arc *arc = &m->arcs[knot % ARC_SLOTS];
  nsvcd__d3 ends[2], fixed_ends[2];
  if (arc->first == first && arc->ticks)
    return arc;
  const uint32_t ticks = nsvcd__next_knot(of, first) - first;
  const double per_metre = 1 / (double)of->unit;
  arc->first = first;
  arc->ticks = ticks;
  arc->fixed_moves = of->fixed_moves;
  arc->scale = (double)of->scale;
  arc->lift = nsvcd__d3_widen(of->lift);
  nsvcd__leg_init(&of->moving, first, ticks, &arc->moving, ends);
  nsvcd__leg_init(&of->fixed, first, ticks, &arc->fixed, fixed_ends);
  const nsvcd__d3 from = nsvcd__d3_sub(ends[0], fixed_ends[0]);
  const nsvcd__d3 to = nsvcd__d3_sub(ends[1], fixed_ends[1]);
  arc->from = nsvcd__d3_scale(from, per_metre);
  arc->moved = nsvcd__d3_scale(nsvcd__d3_sub(to, from), per_metre);
  if (arc->fixed_moves) {
    bend_arc(arc);
    return arc;
  }
  const nsvcd__dmat3 fixed = nsvcd__dmat3_of(arc->fixed.start);
  arc->moving.start = nsvcd__dquat_inverse_mul(arc->fixed.start, arc->moving.start);
  arc->moving.end = nsvcd__dquat_inverse_mul(arc->fixed.start, arc->moving.end);
  arc->from = nsvcd__dmat3_apply_transpose(&fixed, arc->from);
  arc->moved = nsvcd__dmat3_apply_transpose(&fixed, arc->moved);
  arc->turn = 2 * arc->moving.half_angle * arc->moving.share;
  arc->speed = nsvcd__d3_length(arc->moved);
  arc->bulge = 0.1250001 * arc->scale * arc->turn * arc->turn;
  arc->drift = 0;
  return arc;
}

// The true pose of a about its middle, in b's frame about its middle.
static nsvcd__placement true_pose(motion *m, uint32_t knot, double share) {
  if (knot + 1 == m->knots.count && m->knots.count > 1) {
    knot--;
    share = 1;
  }
  nsvcd__placement at = nsvcd__placement_at(arc_at(m, knot), share);
  const nsvcd__d3 middle = nsvcd__dmat3_apply(&at.rotation, nsvcd__d3_load(m->a->centre));
  const nsvcd__d3 place = nsvcd__d3_add(at.position, middle);
  at.position = nsvcd__d3_sub(place, nsvcd__d3_load(m->b->centre));
  return at;
}

static void store_pose(const nsvcd__placement *at, float *matrix, float *place) {
  const nsvcd__d3 *rows = &at->rotation.x;
  for (int r = 0; r < 3; r++)
    nsvcd__f3_store(nsvcd__d3_narrow(rows[r]), matrix + 3 * r);
  nsvcd__f3_store(nsvcd__d3_narrow(at->position), place);
}

// ---- knots

// Where both bodies move: one by one, in double.
static void knots_of_two(motion *m) {
  knot_table *k = &m->knots;
  for (uint32_t n = 0; n < k->count; n++) {
    const nsvcd__placement at = true_pose(m, n, 0);
    float matrix[9];
    float place[3];
    store_pose(&at, matrix, place);
    for (int r = 0; r < 9; r++)
      k->matrix[r][n] = matrix[r];
    for (int r = 0; r < 3; r++)
      k->place[r][n] = place[r];
    k->bulge[n] = k->drift[n] = 0;
    k->turn[0][n] = k->turn[1][n] = k->turn[2][n] = 0;
    if (n + 1 < k->count) {
      const nsvcd__arc *arc = arc_at(m, n);
      k->bulge[n] = 1.00001f * (float)arc->bulge;
      k->drift[n] = 1.00001f * (float)(arc->bulge * (double)m->off + arc->drift);
    }
  }
}

// Where b rests: 16 at a time. Quaternions are those of the poses, made unit by their matrix.
static void knots_of_one(motion *m) {
  const nsvcd__motion *of = m->of;
  knot_table *k = &m->knots;
  const nsvcd__quat f = of->to_fixed_quat;
  const float per_metre = 1 / of->unit;
  const float *c = m->a->centre;
  const float *d = m->b->centre;
  const float *turn = &of->to_fixed.x.x;
  // poses lane by lane, where the table will be: quaternions in four of its rows
  for (uint32_t n = 0; n <= k->count + LANES; n++) {
    const nsvcd_pose *pose = &of->moving.poses[n < k->count ? n : k->count - 1];
    k->place[0][n] = pose->position[0] - of->fixed_position.x;
    k->place[1][n] = pose->position[1] - of->fixed_position.y;
    k->place[2][n] = pose->position[2] - of->fixed_position.z;
    for (int i = 0; i < 4; i++)
      k->matrix[i][n] = pose->rotation[i];
  }
  for (uint32_t first = 0; first < k->count; first += LANES) {
    const lanes x = lanes_load(k->matrix[0] + first);
    const lanes y = lanes_load(k->matrix[1] + first);
    const lanes z = lanes_load(k->matrix[2] + first);
    const lanes w = lanes_load(k->matrix[3] + first);
    const lanes nx = lanes_load(k->matrix[0] + first + 1);
    const lanes ny = lanes_load(k->matrix[1] + first + 1);
    const lanes nz = lanes_load(k->matrix[2] + first + 1);
    const lanes nw = lanes_load(k->matrix[3] + first + 1);
    // f times the pose's
    const lanes qx = f.w * x + f.x * w + f.y * z - f.z * y;
    const lanes qy = f.w * y - f.x * z + f.y * w + f.z * x;
    const lanes qz = f.w * z + f.x * y - f.y * x + f.z * w;
    const lanes qw = f.w * w - f.x * x - f.y * y - f.z * z;
    const lanes two = 2 * of->scale / (qx * qx + qy * qy + qz * qz + qw * qw);
    const lanes s = lanes_set(of->scale);
    const lanes row[9] = {s - two * (qy * qy + qz * qz), two * (qx * qy - qz * qw),
                          two * (qx * qz + qy * qw),     two * (qx * qy + qz * qw),
                          s - two * (qx * qx + qz * qz), two * (qy * qz - qx * qw),
                          two * (qx * qz - qy * qw),     two * (qy * qz + qx * qw),
                          s - two * (qx * qx + qy * qy)};
    lanes3 p = {lanes_load(k->place[0] + first), lanes_load(k->place[1] + first),
                lanes_load(k->place[2] + first)};
    p = lanes3_scale(lanes3_turn(turn, p), lanes_set(per_metre));
    p.x += row[0] * c[0] + row[1] * c[1] + row[2] * c[2] - d[0];
    p.y += row[3] * c[0] + row[4] * c[1] + row[5] * c[2] - d[1];
    p.z += row[6] * c[0] + row[7] * c[1] + row[8] * c[2] - d[2];
    for (int r = 0; r < 9; r++)
      lanes_store(k->matrix[r] + first, row[r]);
    lanes_store(k->place[0] + first, p.x);
    lanes_store(k->place[1] + first, p.y);
    lanes_store(k->place[2] + first, p.z);
    // A bound of the angle to the next: see nsvcd__v_arc_bound.
    const lanes dot = x * nx + y * ny + z * nz + w * nw;
    const lanes sign = lanes_pick(lanes_above(lanes_set(0), dot), lanes_set(-1), lanes_set(1));
    const lanes ex = sign * nx - x;
    const lanes ey = sign * ny - y;
    const lanes ez = sign * nz - z;
    const lanes ew = sign * nw - w;
    // the vector part of the next times this one's inverse, and as b sees it
    const lanes3 u = {x, y, z};
    const lanes3 v = {nx, ny, nz};
    const lanes3 across = lanes3_cross(u, v);
    const lanes3 axis =
        lanes3_turn(turn, (lanes3){w * nx - nw * x + across.x, w * ny - nw * y + across.y,
                                   w * nz - nw * z + across.z});
    lanes_store(k->turn[0] + first, axis.x);
    lanes_store(k->turn[1] + first, axis.y);
    lanes_store(k->turn[2] + first, axis.z);
    const lanes half = 0.50025f * lanes_sqrt(ex * ex + ey * ey + ez * ez + ew * ew);
    const lanes angle = half * (4 + 2.2832f * half * half);
    const lanes bulge = (0.12501f * of->scale) * angle * angle;
    lanes_store(k->bulge + first, bulge);
    lanes_store(k->drift + first, bulge * lanes_set(m->off));
  }
}

static uint32_t count_knots(const nsvcd__motion *of) {
  if (of->moving.count == 1 && of->fixed.count == 1)
    return 1;
  if (!of->fixed_moves)
    return (uint32_t)of->moving.count;
  uint32_t count = 1;
  for (uint32_t tick = 0; tick < of->ticks; tick = nsvcd__next_knot(of, tick))
    count++;
  return count;
}

// Floats that the rows of a table take.
static size_t knot_floats(uint32_t count) {
  return 19 * ((size_t)count + 2 * LANES);
}

// m->clearance is set. memory: knot_floats(count_knots()).
static void motion_begin(motion *m, const nsvcd__motion *of, const tree_body *a, const tree_body *b,
                         float *memory, uint32_t knots) {
  knot_table *k = &m->knots;
  m->of = of;
  m->a = a;
  m->b = b;
  m->scale = of->scale;
  m->off = a->off;
  m->lengths = of->scale * (a->reach + a->off) + b->reach + b->off;
  memset(m->known, 0, sizeof m->known);
  for (int i = 0; i < ARC_SLOTS; i++)
    m->arcs[i].ticks = 0;
  k->count = knots;
  k->stride = knots + 2 * LANES;
  for (int r = 0; r < 9; r++)
    k->matrix[r] = memory + (size_t)r * k->stride;
  for (int r = 0; r < 3; r++)
    k->place[r] = memory + (size_t)(9 + r) * k->stride;
  k->share = memory + (size_t)12 * k->stride;
  k->bulge = memory + (size_t)13 * k->stride;
  k->drift = memory + (size_t)14 * k->stride;
  k->tick = (uint32_t *)(void *)(memory + (size_t)15 * k->stride);
  for (int r = 0; r < 3; r++)
    k->turn[r] = memory + (size_t)(16 + r) * k->stride;
  const float per_tick = 1 / (float)of->ticks;
  for (uint32_t n = 0, tick = 0; n < knots; n++) {
    k->tick[n] = tick;
    k->share[n] = (float)tick * per_tick;
    if (n + 1 < knots)
      tick = nsvcd__next_knot(of, tick);
  }
  if (of->fixed_moves)
    knots_of_two(m);
  else
    knots_of_one(m);
}

// ---- spans

// The direction w of a span: the axis of its turn, or across its way and where it bends.
static void choose_w(const motion *m, span *s) {
  const knot_table *k = &m->knots;
  const float *a = s->start;
  const float *b = s->end;
  const uint32_t middle = (s->first + s->last) / 2;
  nsvcd__f3 w = {0, 0, 0};
  // of start transposed times end, its antisymmetric part as b sees it: sum of row_i x row_i
  for (int c = 0; c < 3; c++) {
    const nsvcd__f3 from = {a[c], a[3 + c], a[6 + c]};
    const nsvcd__f3 to = {b[c], b[3 + c], b[6 + c]};
    w = nsvcd__f3_add(w, nsvcd__f3_cross(from, to));
  }
  const float floor = 1e-3f * m->scale * m->scale;
  if (!(nsvcd__f3_dot(w, w) > floor * floor)) {
    const nsvcd__f3 way = {s->end_at[0] - s->start_at[0], s->end_at[1] - s->start_at[1],
                           s->end_at[2] - s->start_at[2]};
    const nsvcd__f3 bend = {k->place[0][middle] - s->start_at[0],
                            k->place[1][middle] - s->start_at[1],
                            k->place[2][middle] - s->start_at[2]};
    w = nsvcd__f3_cross(way, bend);
  }
  const float length = nsvcd__f3_length(w);
  const float unit = length > 1e-15f ? 1 / length : 0;
  nsvcd__f3_store(nsvcd__f3_scale(w, unit), s->w);
  if (!(length > 1e-15f))
    s->w[2] = 1;
}

// By how much knots and arcs of a span stray from its chord.
static void bound_span(const motion *m, span *s) {
  const knot_table *k = &m->knots;
  const float length = k->share[s->last] - k->share[s->first];
  const lanes zero = lanes_set(0);
  const lanes3 w = lanes3_set(s->w[0], s->w[1], s->w[2]);
  lanes turn = zero;
  lanes stray = zero;
  lanes turn_w = zero;
  lanes stray_w = zero;
  lanes bulge = zero;
  lanes drift = zero;
  lanes bulge_w = zero;
  lanes drift_w = zero;
  for (uint32_t n = s->first; n < s->last; n += LANES) {
    const uint32_t there = first_lanes(s->last - n);
    const lanes u = (lanes_load(k->share + n) - k->share[s->first]) * lanes_set(1 / length);
    lanes d[12];
    for (int r = 0; r < 9; r++)
      d[r] = lanes_load(k->matrix[r] + n) - s->start[r] - u * (s->end[r] - s->start[r]);
    for (int r = 0; r < 3; r++)
      d[9 + r] = lanes_load(k->place[r] + n) - s->start_at[r] - u * (s->end_at[r] - s->start_at[r]);
    // the square of its norm: no more than the greatest sum of a row of D D^T
    const lanes3 row[3] = {{d[0], d[1], d[2]}, {d[3], d[4], d[5]}, {d[6], d[7], d[8]}};
    const lanes xy = lanes_abs(lanes3_dot(row[0], row[1]));
    const lanes xz = lanes_abs(lanes3_dot(row[0], row[2]));
    const lanes yz = lanes_abs(lanes3_dot(row[1], row[2]));
    const lanes xx = lanes3_dot(row[0], row[0]);
    const lanes yy = lanes3_dot(row[1], row[1]);
    const lanes zz = lanes3_dot(row[2], row[2]);
    const lanes widest = lanes_max(xx + xy + xz, lanes_max(yy + xy + yz, zz + xz + yz));
    const lanes square = lanes_min(widest, xx + yy + zz);
    lanes square_w = zero;
    for (int c = 0; c < 3; c++) {
      const lanes3 column = {d[c], d[3 + c], d[6 + c]};
      const lanes along = lanes3_dot(w, column);
      square_w += along * along;
    }
    const lanes3 off = {d[9], d[10], d[11]};
    const lanes3 axis = {lanes_load(k->turn[0] + n), lanes_load(k->turn[1] + n),
                         lanes_load(k->turn[2] + n)};
    const lanes3 across = lanes3_cross(axis, w);
    const lanes axis2 = lanes3_dot(axis, axis);
    const lanes share2 = lanes3_dot(across, across) / axis2;
    const lanes share = lanes_pick(lanes_above(axis2, lanes_set(1e-6f)),
                                   lanes_min(lanes_sqrt(share2) + 1e-3f, lanes_set(1)), lanes_set(1));
    const lanes here = lanes_load(k->bulge + n);
    const lanes off_here = lanes_load(k->drift + n);
    turn = lanes_max(turn, lanes_pick(there, square, zero));
    turn_w = lanes_max(turn_w, lanes_pick(there, square_w, zero));
    stray = lanes_max(stray, lanes_pick(there, lanes3_dot(off, off), zero));
    stray_w = lanes_max(stray_w, lanes_pick(there, lanes_abs(lanes3_dot(w, off)), zero));
    bulge = lanes_max(bulge, lanes_pick(there, here, zero));
    drift = lanes_max(drift, lanes_pick(there, off_here, zero));
    bulge_w = lanes_max(bulge_w, lanes_pick(there, here * share, zero));
    drift_w = lanes_max(drift_w, lanes_pick(there, off_here * share, zero));
  }
  s->eb = 1.00001f * (sqrtf(lanes_most(turn)) + lanes_most(bulge));
  s->ea = 1.00001f * (sqrtf(lanes_most(stray)) + lanes_most(drift));
  s->eb_w = 1.00001f * (sqrtf(lanes_most(turn_w)) + lanes_most(bulge_w)) + 1e-6f * s->eb;
  s->ea_w = 1.00001f * (lanes_most(stray_w) + lanes_most(drift_w)) + 1e-6f * s->ea;
}

// The same where the arcs are few, in any direction alike: along w little would be gained.
static void bound_few(const motion *m, span *s) {
  const knot_table *k = &m->knots;
  const uint32_t there = first_lanes(s->last - s->first);
  const uint32_t n = s->first;
  const float per_length = 1 / (k->share[s->last] - k->share[s->first]);
  const lanes u = (lanes_load(k->share + n) - k->share[s->first]) * per_length;
  const lanes zero = lanes_set(0);
  lanes square = zero;
  lanes off = zero;
  for (int r = 0; r < 9; r++) {
    const lanes d = lanes_load(k->matrix[r] + n) - s->start[r] - u * (s->end[r] - s->start[r]);
    square += d * d;
  }
  for (int r = 0; r < 3; r++) {
    const lanes d = lanes_load(k->place[r] + n) - s->start_at[r] - u * (s->end_at[r] - s->start_at[r]);
    off += d * d;
  }
  // for any vectors, the length of a difference of matrices is no more than its Frobenius norm
  const float turn = lanes_most(lanes_pick(there, square, zero));
  const float stray = lanes_most(lanes_pick(there, off, zero));
  s->eb = 1.00001f * (sqrtf(turn) + lanes_most(lanes_pick(there, lanes_load(k->bulge + n), zero)));
  s->ea = 1.00001f * (sqrtf(stray) + lanes_most(lanes_pick(there, lanes_load(k->drift + n), zero)));
  s->eb_w = s->eb;
  s->ea_w = s->ea;
  s->w[0] = s->w[1] = s->w[2] = 0;
}

// The same within one arc. Where b turns, an arc has no axis of which this would hold.
static void bound_part(const motion *m, span *s) {
  const knot_table *k = &m->knots;
  const float part = (float)((s->to - s->from) * (s->to - s->from) * 1.00001);
  const uint32_t n = s->first;
  const nsvcd__f3 axis = {k->turn[0][n], k->turn[1][n], k->turn[2][n]};
  const float length = nsvcd__f3_length(axis);
  s->eb = part * k->bulge[n];
  s->ea = part * k->drift[n];
  s->eb_w = s->eb;
  s->ea_w = s->ea;
  s->w[0] = s->w[1] = s->w[2] = 0;  // then all of a direction is across
  if (!(length > 1e-3f))
    return;
  nsvcd__f3_store(nsvcd__f3_scale(axis, 1 / length), s->w);
  s->eb_w *= 1e-3f;
  s->ea_w *= 1e-3f;
}

// By how much points `reach` from a's middle stray along n, |n| <= 1, but for rounding.
FAST lanes stray_along(const span *s, lanes3 n, float reach) {
  const lanes along = lanes_abs(n.x * s->w[0] + n.y * s->w[1] + n.z * s->w[2]);
  const lanes across = lanes_sqrt(lanes_max(1.000004f - along * along, lanes_set(0)));
  return along * (s->ea_w + s->eb_w * reach) + across * (s->ea + s->eb * reach);
}
FAST float stray_of(const span *s, const float *n, float reach) {
  const float along = fabsf(n[0] * s->w[0] + n[1] * s->w[1] + n[2] * s->w[2]);
  const float square = 1.000004f - along * along;
  const float across = sqrtf(square > 0 ? square : 0);
  return along * (s->ea_w + s->eb_w * reach) + across * (s->ea + s->eb * reach);
}
// What stray_of grows by with the reach.
FAST float stray_along_reach(const span *s, const float *n) {
  const float along = fabsf(n[0] * s->w[0] + n[1] * s->w[1] + n[2] * s->w[2]);
  const float square = 1.000004f - along * along;
  return along * s->eb_w + sqrtf(square > 0 ? square : 0) * s->eb;
}
static inline double stray_along_one(const span *s, nsvcd__d3 n, double reach) {
  const nsvcd__d3 w = nsvcd__d3_load(s->w);
  const double along = fabs(nsvcd__d3_dot(n, w));
  const double beside = nsvcd__d3_length(nsvcd__d3_cross(n, w)) + 1e-6;
  const double across = nsvcd__d3_dot(w, w) > 0.5 ? beside : nsvcd__d3_length(n);
  return along * ((double)s->ea_w + (double)s->eb_w * reach) +
         across * ((double)s->ea + (double)s->eb * reach);
}

// How a direction looks from a, at the start and the end.
FAST void turn_back(const float *matrix, const float *n, float *out) {
  for (int k = 0; k < 3; k++)
    out[k] = matrix[k] * n[0] + matrix[3 + k] * n[1] + matrix[6 + k] * n[2];
}
FAST float dot3(const float *a, const float *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void span_axes(span *s) {
  for (int j = 0; j < 3; j++) {
    float *n = s->axes[3 + j];
    for (int k = 0; k < 3; k++) {
      s->axes[j][k] = j == k;
      s->at_start[j][k] = s->start[3 * j + k];
      s->at_end[j][k] = s->end[3 * j + k];
      n[k] = s->start[3 * k + j] + s->end[3 * k + j];
    }
    const float square = dot3(n, n);
    const float unit = square > 1e-30f ? 0.999999f / sqrtf(square) : 0;
    for (int k = 0; k < 3; k++)
      n[k] *= unit;
    turn_back(s->start, n, s->at_start[3 + j]);
    turn_back(s->end, n, s->at_end[3 + j]);
  }
  for (int j = 0; j < 6; j++) {
    s->start_height[j] = dot3(s->axes[j], s->start_at);
    s->end_height[j] = dot3(s->axes[j], s->end_at);
    const float along = fabsf(dot3(s->axes[j], s->w));
    const float square = 1.000004f - along * along;
    const float across = sqrtf(square > 0 ? square : 0);
    s->axes_ea[j] = along * s->ea_w + across * s->ea + s->rounding;
    s->axes_eb[j] = along * s->eb_w + across * s->eb;
  }
}

static void read_knot(const knot_table *k, uint32_t n, float *matrix, float *place) {
  for (int r = 0; r < 9; r++)
    matrix[r] = k->matrix[r][n];
  for (int r = 0; r < 3; r++)
    place[r] = k->place[r][n];
}

// Which knots, and which part of an arc, a span is.
static void find_span(const motion *m, uint64_t id, span *s) {
  s->id = id;
  if (id & INSTANT) {
    s->first = s->last = (uint32_t)id;
    s->from = s->to = 0;
    return;
  }
  s->first = 0;
  s->last = m->knots.count - 1;
  s->from = 0;
  s->to = 1;
  for (int bit = 62 - __builtin_clzll(id); bit >= 0; bit--) {
    const int later = id >> bit & 1;
    if (s->last - s->first > 1) {
      const uint32_t middle = (s->first + s->last) / 2;
      *(later ? &s->first : &s->last) = middle;
    } else {
      const double middle = 0.5 * (s->from + s->to);
      *(later ? &s->from : &s->to) = middle;
    }
  }
}

static void make_span(motion *m, uint64_t id, span *s) {
  find_span(m, id, s);
  const int in_arc = s->last > s->first && (s->from > 0 || s->to < 1);
  s->has_ends = 0;
  if (in_arc) {
    s->exact_start = true_pose(m, s->first, s->from);
    s->exact_end = true_pose(m, s->first, s->to);
    store_pose(&s->exact_start, s->start, s->start_at);
    store_pose(&s->exact_end, s->end, s->end_at);
    bound_part(m, s);
    s->has_ends = 1;
  } else {
    read_knot(&m->knots, s->first, s->start, s->start_at);
    read_knot(&m->knots, s->last, s->end, s->end_at);
    if (s->last - s->first > 1 && s->last - s->first <= FEW_ARCS) {
      bound_few(m, s);
    } else if (s->last - s->first > 1) {
      choose_w(m, s);
      bound_span(m, s);
    } else if (s->last > s->first) {
      bound_part(m, s);
    } else {
      s->ea = s->eb = s->ea_w = s->eb_w = s->w[0] = s->w[1] = s->w[2] = 0;
    }
  }
  float remote = 0;
  float way = 0;
  float turn = 0;
  float places = 0;
  for (int k = 0; k < 3; k++) {
    const float d = s->end_at[k] - s->start_at[k];
    way += d * d;
    remote += s->start_at[k] * s->start_at[k];
    places += s->end_at[k] * s->end_at[k];
  }
  for (int k = 0; k < 9; k++)
    turn += (s->end[k] - s->start[k]) * (s->end[k] - s->start[k]);
  s->way = sqrtf(way);
  s->turn = sqrtf(turn);
  s->hair = NSVCD__ROUNDING * (m->lengths + sqrtf(remote) + sqrtf(places));
  s->rounding = s->hair + m->clearance;
  s->exact_rounding = s->last - s->first > 1 ? (double)s->hair : 0;
  span_axes(s);
}

// It stays where it is while its halves are asked for: slots are odd or even as their spans' depths
// are.
static span *span_at(motion *m, uint64_t id) {
  const unsigned odd = (unsigned)__builtin_clzll(id) & 1;
  const unsigned slot = 2 * (unsigned)((id ^ id >> 5 ^ id >> 17) % (SPAN_SLOTS / 2)) + odd;
  if (m->known[slot] != id) {
    m->known[slot] = id;
    make_span(m, id, &m->spans[slot]);
  }
  return &m->spans[slot];
}

// The true poses at its ends.
static void span_ends(motion *m, span *s) {
  if (s->has_ends)
    return;
  s->has_ends = 1;
  s->exact_start = true_pose(m, s->first, s->from);
  s->exact_end = s->last > s->first ? true_pose(m, s->last - 1, s->to) : s->exact_start;
}

// When it begins and ends, in [0,1].
static void span_times(const motion *m, const span *s, double *start, double *end) {
  const double ticks = (double)m->of->ticks;
  const double first = (double)m->knots.tick[s->first];
  const double last = (double)m->knots.tick[s->last];
  *start = (first + s->from * (last - first)) / ticks;
  *end = (first + s->to * (last - first)) / ticks;
}

#endif
