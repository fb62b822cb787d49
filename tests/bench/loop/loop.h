// loop.h - the proof: one loop over one list of work.
// In: two tree bodies and a motion. Out: a witness (two triangles that meet, and when), a
// certificate that the surfaces never do, or neither (undecided), and what it took.
//
// A piece of work is a child of a's tree, one of b's and a span of time. Everything that the
// question asks for is in one piece at first: both tops, all of the motion. A piece leaves the list
// in four ways and no other:
//   - parted: a plane holds over all of its span (part.h);
//   - met: two of its triangles meet at the true pose, in double: that is the answer;
//   - doubt: two triangles come nearer than their quanta without meeting; the answer can then only
//     be a witness or undecided. So is what remains when the limit of steps is reached;
//   - split into pieces that together are all of it: shorter spans, children of the larger node or
//     of both, or couples of its leaves' triangles. Pieces that are parted at once are not even put
//     on the list, and two leaves are gone through where the nodes above them are opened.
// A span of several arcs is cut at once: the two boxes are posed at all of its knots, and what is
// left are the arcs in which they may meet, in spans as short as the boxes ask for. Of two leaves,
// planes leave out triangles that they part from all of the other leaf; then those of the leaf with
// fewer left go one by one against 16 of the other; then couples. Few couples that are left wait, in
// turns, until all else is done; many mean that the span is too long.
// So when the list is empty and there was no doubt, everything has been parted: the surfaces never
// meet. The order is of no account to that: what has the least gap comes first, since it is the
// likeliest to hold a witness. Before all else one is looked for, for some steps, at the knot where
// the boxes are deepest in each other (an instant: what is parted there is not parted for good).
#ifndef LOOP_LOOP_H
#define LOOP_LOOP_H

#include "part.h"

#define COUPLE 0x80000000u  // of work.a: a and b are triangles, a leaf's word and a lane
#define WORK_SLOTS 1024
#define COUPLE_SLOTS 1024
#ifndef FEW_COUPLES
#define FEW_COUPLES 2
#endif
#ifndef LONG_WAY
#define LONG_WAY 0.4f  // halve a span in which the way is longer than this share of the boxes
#endif
#ifndef STRAY_WEIGHT
#define STRAY_WEIGHT 1
#endif
#ifndef SHORT_SPAN
#define SHORT_SPAN 0.015  // of an arc: couples of one leaf are no longer halved together
#endif

typedef struct work_item {
  uint64_t span;
  uint32_t a, b;  // places
} work_item;

typedef enum loop_verdict { LOOP_FREE, LOOP_HIT, LOOP_INSIDE, LOOP_UNDECIDED } loop_verdict;

typedef struct loop_answer {
  loop_verdict verdict;
  double time;        // of the contact, or of the end of a short span in which one was passed
  double free_until;  // no contact is before this
  uint32_t triangle_a, triangle_b;
  // what it took
  uint32_t steps, visits, leaves, rows, couples, halvings, cuts, most_waiting;
} loop_answer;

// Leaves' triangles, as the loop needs them.
typedef struct moving_leaf {
  uint64_t span;
  const tree_leaf *leaf;
  lanes3 start[3], end[3];  // corners, posed
  lanes3 low, high;         // their boxes over the span, with stray, but for slack
  int has_normals;          // what follows is known
  lanes3 normals;           // half way,
  lanes below, above;       // and its triangles' heights along these, as low and high
} moving_leaf;
typedef struct resting_leaf {
  const tree_leaf *leaf;
  triangles t;
  int has_normals;
  lanes3 normals;
  lanes height;  // of their planes
} resting_leaf;

#define MOVED_SLOTS 8
#define MOVING_LEAVES 4
#define RESTING_LEAVES 32

// What has been reckoned before; it may be wiped at any time, and no verdict changes.
typedef struct memo {
  moving_children moved[MOVED_SLOTS];
  moving_leaf moving[MOVING_LEAVES];
  resting_leaf resting[RESTING_LEAVES];
} memo;

typedef struct loop {
  motion m;
  memo known;
  const tree_body *a, *b;
  uint32_t limit;
  double clearance;   // as m's, in double
  double first;       // share of the motion; 0: any contact will do
  double end;         // nothing matters that is not before this: a contact less `first`
  int has_contact;
  int doubt;
  double doubt_from;  // the earliest
  uint32_t count;
  uint32_t look_end;  // instants are done with at so many steps; 0: none was looked at
  nsvcd__d3 parting;  // parted a couple last,
  nsvcd__f3 held;     // and leaves
  loop_answer out;
  work_item list[WORK_SLOTS];
  // couples wait in a ring until nothing else is left: flat on flat they may be halved for ever
  uint32_t couple_first, couple_count;
  work_item couples[COUPLE_SLOTS];
} loop;

static int is_spent(loop *p) {
  return p->out.steps > p->limit;
}
static void push(loop *p, uint64_t span, uint32_t a, uint32_t b) {
  if (p->count == WORK_SLOTS) {
    p->doubt = 1;
    p->doubt_from = 0;
    p->limit = 0;
    return;
  }
  const work_item item = {span, a, b};
  p->list[p->count++] = item;
  if (p->count > p->out.most_waiting)
    p->out.most_waiting = p->count;
}

static void push_couple(loop *p, uint64_t span, uint32_t a, uint32_t b) {
  if (p->couple_count == COUPLE_SLOTS) {
    push(p, span, a, b);
    return;
  }
  const work_item item = {span, a, b};
  p->couples[(p->couple_first + p->couple_count++) % COUPLE_SLOTS] = item;
}

// ---- couples: a triangle of each body

typedef struct couple {
  nsvcd__d3 a[3], b[3];
  uint32_t number_a, number_b;
  double reach;     // of a's, from its middle
  double rounding;  // in double
  double slack;     // quanta, and that
} couple;

static couple couple_at(const loop *p, const span *s, uint32_t a, uint32_t b) {
  const tree_leaf *leaf_a = (const tree_leaf *)body_at(p->a, (a & ~COUPLE) >> 4);
  const tree_leaf *leaf_b = (const tree_leaf *)body_at(p->b, b >> 4);
  couple c;
  leaf_triangle(p->a, leaf_a, a & 15, c.a);
  leaf_triangle(p->b, leaf_b, b & 15, c.b);
  c.number_a = leaf_number(p->a, leaf_a, a & 15);
  c.number_b = leaf_number(p->b, leaf_b, b & 15);
  c.reach = 0;
  for (int k = 0; k < 3; k++)
    c.reach = fmax(c.reach, nsvcd__d3_length(c.a[k]));
  // s->hair is NSVCD__ROUNDING of the same lengths
  c.rounding = NSVCD__SAME_PLACE / (double)NSVCD__ROUNDING * (double)s->hair;
  c.slack = (double)p->m.scale * (double)leaf_error(leaf_a) + (double)leaf_error(leaf_b);
  c.slack += c.rounding;
  return c;
}

// Where the first contact is asked for, only what is so much before this one matters from then on.
static int take_contact(loop *p, const couple *c, double time) {
  p->out.verdict = LOOP_HIT;
  p->out.time = time;
  p->out.triangle_a = c->number_a;
  p->out.triangle_b = c->number_b;
  p->has_contact = 1;
  p->end = time - p->first;
  return 1;
}

// Do they meet at that pose, or come within the clearance?
static int couple_meets(loop *p, const couple *c, const nsvcd__placement *at, double time) {
  nsvcd__d3 posed[3];
  nsvcd__d3 point;
  if (!(time < p->end))
    return 0;
  p->out.couples++;
  p->out.steps++;
  nsvcd__place_triangle(at, c->a, posed);
  if (nsvcd__triangles_meet(posed, c->b, &point))
    return take_contact(p, c, time);
  if (!(p->clearance > 0))
    return 0;
  const double square = nsvcd__nearest_of(posed, c->b).square;
  return square <= p->clearance * p->clearance && take_contact(p, c, time);
}

// Does a plane part them over a span?
static int plane_parts_couple(const span *s, const couple *c, double clearance, nsvcd__d3 n) {
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (int k = 0; k < 3; k++) {
    lowest = fmin(lowest, nsvcd__d3_dot(n, nsvcd__place_point(&s->exact_start, c->a[k])));
    lowest = fmin(lowest, nsvcd__d3_dot(n, nsvcd__place_point(&s->exact_end, c->a[k])));
    highest = fmax(highest, nsvcd__d3_dot(n, c->b[k]));
  }
  const double allowed = c->slack + s->exact_rounding + clearance;
  return lowest - highest > allowed + stray_along_one(s, n, c->reach);
}

// The middle of a span: the knot, or within the arc.
static nsvcd__placement middle_pose(loop *p, const span *s, double *time) {
  double start;
  double end;
  span_times(&p->m, s, &start, &end);
  if (s->last - s->first > 1) {
    const uint32_t middle = (s->first + s->last) / 2;
    *time = (double)p->m.knots.tick[middle] / (double)p->m.of->ticks;
    return true_pose(&p->m, middle, 0);
  }
  *time = 0.5 * (start + end);
  return true_pose(&p->m, s->first, 0.5 * (s->from + s->to));
}

// Has a corner passed through the other triangle, or an edge through an edge?
static int triangles_pass(const nsvcd__passage *p, const nsvcd__d3 *fixed, double margin) {
  const nsvcd__d3 *start = p->corners[0];
  const nsvcd__d3 *middle = p->corners[1];
  const nsvcd__d3 *end = p->corners[2];
  const double room = 2 * p->way;
  for (size_t k = 0; k < 3; k++) {
    const int is_over = nsvcd__foot_well_within(middle[k], fixed, room);
    if (is_over && nsvcd__changes_sides(start[k], fixed, end[k], fixed, margin))
      return 1;
    const int is_under = nsvcd__foot_well_within(fixed[k], middle, room);
    if (is_under && nsvcd__changes_sides(fixed[k], start, fixed[k], end, margin))
      return 1;
    for (size_t n = 0; n < 3; n++) {
      if (nsvcd__edges_cross(p, k, fixed[n], fixed[(n + 1) % 3], margin))
        return 1;
    }
  }
  return 0;
}

// Have they passed through each other within a short span, at one time only?
static int couple_passes(loop *p, const span *s, const couple *c, const nsvcd__placement *middle,
                         double way) {
  nsvcd__passage passage;
  nsvcd__place_triangle(&s->exact_start, c->a, passage.corners[0]);
  nsvcd__place_triangle(middle, c->a, passage.corners[1]);
  nsvcd__place_triangle(&s->exact_end, c->a, passage.corners[2]);
  passage.way = way;
  if (!triangles_pass(&passage, c->b, c->rounding))
    return 0;
  double start;
  double end;
  span_times(&p->m, s, &start, &end);
  return end < p->end && take_contact(p, c, end);
}

static void certify_couple(const loop *p, const span *s, const work_item *item) {
  (void)p, (void)s, (void)item;
  LOOP_CERTIFY_PLANE(p, s, body_at(p->a, (item->a & ~COUPLE) >> 4), 1u << (item->a & 15),
                     body_at(p->b, item->b >> 4), 1u << (item->b & 15), p->parting);
}

// 1: they meet.
static int settle_couple(loop *p, const work_item *item) {
  span *s = span_at(&p->m, item->span);
  const couple c = couple_at(p, s, item->a, item->b);
  double time;
  double end;
  p->out.steps++;
  p->out.couples++;
  span_ends(&p->m, s);
  if (plane_parts_couple(s, &c, p->clearance, p->parting)) {
    certify_couple(p, s, item);
    return 0;
  }
  const nsvcd__placement middle = middle_pose(p, s, &time);
  nsvcd__d3 posed[3];
  nsvcd__place_triangle(&middle, c.a, posed);
  const nsvcd__nearest nearest = nsvcd__nearest_of(posed, c.b);
  const double distance = sqrt(nearest.square);
  if (distance <= p->clearance + c.rounding && time < p->end)
    return take_contact(p, &c, time);
  p->parting = nsvcd__d3_scale(nsvcd__d3_sub(nearest.on_a, nearest.on_b), 1 / distance);
  if (plane_parts_couple(s, &c, p->clearance, p->parting)) {
    certify_couple(p, s, item);
    return 0;
  }
  const double way = (double)s->way + (double)s->turn * c.reach;
  const double strays = (double)s->ea + (double)s->eb * c.reach;
  const int tiny = way + 2 * strays <= 0.25 * c.slack || item->span >> MOST_HALVINGS;
  if (!tiny) {
    p->out.halvings++;
    push_couple(p, 2 * item->span, item->a, item->b);
    push_couple(p, 2 * item->span + 1, item->a, item->b);
    return 0;
  }
  if (couple_passes(p, s, &c, &middle, way + 2 * strays))
    return 1;
  span_times(&p->m, s, &time, &end);
  p->doubt_from = fmin(p->doubt_from, time);
  if (!p->doubt && p->limit > p->out.steps)  // only a witness still decides
    p->limit = p->out.steps + (p->limit - p->out.steps) / NSVCD__IN_DOUBT;
  p->doubt = 1;
  return 0;
}

// ---- leaves

// Two leaves' triangles.
typedef struct leaf_pair {
  moving_leaf *a;
  resting_leaf *b;
  lanes resting_stray;  // along b's normals
  float slack;          // rounding and both leaves' quanta
  float reach;          // of a's leaf
  uint32_t in_a, in_b;  // lanes that may matter
  lanes low, high;      // heights along the plane that was tried last,
  nsvcd__f3 plane;
  float limit;          // which parts those that are farther apart than this
} leaf_pair;

static moving_leaf *moving_leaf_at(loop *p, const span *s, uint32_t word, float reach) {
  const tree_leaf *leaf = (const tree_leaf *)body_at(p->a, word);
  moving_leaf *out = &p->known.moving[(word >> 3 ^ s->id) % MOVING_LEAVES];
  if (out->leaf == leaf && out->span == s->id)
    return out;
  leaf_points points;
  leaf_points posed;
  out->leaf = leaf;
  out->span = s->id;
  out->has_normals = 0;
  leaf_read(p->a, leaf, &points);
  posed.sets = points.sets;
  for (int k = 0; k < points.sets; k++)
    posed.at[k] = lanes3_add(lanes3_turn(s->start, points.at[k]),
                             lanes3_set(s->start_at[0], s->start_at[1], s->start_at[2]));
  leaf_corners(leaf, &posed, out->start);
  for (int k = 0; k < points.sets; k++)
    posed.at[k] = lanes3_add(lanes3_turn(s->end, points.at[k]),
                             lanes3_set(s->end_at[0], s->end_at[1], s->end_at[2]));
  leaf_corners(leaf, &posed, out->end);
  lanes3 low = out->start[0];
  lanes3 high = low;
  for (int k = 0; k < 3; k++) {
    low = lanes3_min(low, lanes3_min(out->start[k], out->end[k]));
    high = lanes3_max(high, lanes3_max(out->start[k], out->end[k]));
  }
  float stray[3];
  for (int k = 0; k < 3; k++)
    stray[k] = s->axes_ea[k] + s->axes_eb[k] * reach;
  out->low = lanes3_sub(low, lanes3_set(stray[0], stray[1], stray[2]));
  out->high = lanes3_add(high, lanes3_set(stray[0], stray[1], stray[2]));
  return out;
}

static resting_leaf *resting_leaf_at(loop *p, uint32_t word) {
  const tree_leaf *leaf = (const tree_leaf *)body_at(p->b, word);
  resting_leaf *out = &p->known.resting[(word >> 3) % RESTING_LEAVES];
  if (out->leaf == leaf)
    return out;
  leaf_points points;
  out->leaf = leaf;
  out->has_normals = 0;
  leaf_read(p->b, leaf, &points);
  leaf_corners(leaf, &points, out->t.corner);
  bound_triangles(&out->t);
  return out;
}

// The normals of both leaves, if they were not asked for before.
static void find_normals(const span *s, moving_leaf *a, resting_leaf *b, float reach) {
  if (!b->has_normals) {
    b->has_normals = 1;
    b->normals = face_normals(b->t.corner);
    b->height = lanes3_dot(b->normals, b->t.corner[0]);
  }
  if (a->has_normals)
    return;
  lanes3 half_way[3];
  for (int k = 0; k < 3; k++)
    half_way[k] = lanes3_add(a->start[k], a->end[k]);
  a->has_normals = 1;
  a->normals = face_normals(half_way);
  const lanes stray = stray_along(s, a->normals, reach);
  a->below = lanes_set(HUGE_VALF);
  a->above = -a->below;
  for (int k = 0; k < 3; k++) {
    const lanes by_start = lanes3_dot(a->normals, a->start[k]);
    const lanes by_end = lanes3_dot(a->normals, a->end[k]);
    a->below = lanes_min(a->below, lanes_min(by_start, by_end));
    a->above = lanes_max(a->above, lanes_max(by_start, by_end));
  }
  a->below -= stray;
  a->above += stray;
}

// How far 16 boxes stay from another one, less the slack.
FAST lanes boxes_gap(const lanes3 *low, const lanes3 *high, const float *from, const float *to,
                     float slack) {
  lanes gap = lanes_max(low->x - to[0], from[0] - high->x);
  LOOP_AXIS(0, gap - slack, lanes3_set(1, 0, 0));
  gap = wider(gap, low->y, high->y, lanes_set(from[1]), lanes_set(to[1]));
  LOOP_AXIS(0, gap - slack, lanes3_set(0, 1, 0));
  gap = wider(gap, low->z, high->z, lanes_set(from[2]), lanes_set(to[2]));
  LOOP_AXIS(0, gap - slack, lanes3_set(0, 0, 1));
  return gap - slack;
}

#ifndef CUT_WAY
#define CUT_WAY 0.4f
#endif
#ifndef CUT_PARTS
#define CUT_PARTS 0.25f
#endif
#ifndef LOOK_DEEP
#define LOOK_DEEP 0.5f
#endif
#ifndef LOOK_STEPS
#define LOOK_STEPS 12
#endif
#ifndef PLANE_STEPS
#define PLANE_STEPS 6
#endif

// The corner of triangle l that is lowest; heights are those of the three, or their negatives.
FAST float lowest_corner(const lanes3 *corner, const lanes3 *heights, unsigned l, float least,
                         float sign, nsvcd__f3 *out) {
  const lanes *h = &heights->x;
  for (int k = 0; k < 3; k++) {
    const float here = sign * h[k][l];
    if (!(here < least))
      continue;
    least = here;
    *out = nsvcd__f3_of(corner[k].x[l], corner[k].y[l], corner[k].z[l]);
  }
  return least;
}

FAST lanes3 corner_heights(const lanes3 *corner, nsvcd__f3 n) {
  return (lanes3){n.x * corner[0].x + n.y * corner[0].y + n.z * corner[0].z,
                  n.x * corner[1].x + n.y * corner[1].y + n.z * corner[1].z,
                  n.x * corner[2].x + n.y * corner[2].y + n.z * corner[2].z};
}

// Seeks planes between what is left of two leaves: the one that held last, then such as Gilbert's
// iteration finds. A triangle is left out once a plane parts it from all that are left of the other
// leaf; so of any two, one was left out by a plane that parts both. 1: nothing is left.
static int plane_parts_leaves(loop *p, const span *s, leaf_pair *t) {
  nsvcd__f3 n = p->held;
  nsvcd__f3 v = {0, 0, 0};
  for (int step = 0; step < PLANE_STEPS; step++) {
    const lanes3 start = corner_heights(t->a->start, n);
    const lanes3 end = corner_heights(t->a->end, n);
    const lanes3 rest = corner_heights(t->b->t.corner, n);
    t->low = lanes_min(lanes_min(lanes_min(start.x, start.y), lanes_min(start.z, end.x)),
                       lanes_min(end.y, end.z));
    t->high = lanes_max(lanes_max(rest.x, rest.y), rest.z);
    const lanes low = lanes_pick(t->in_a, t->low, lanes_set(HUGE_VALF));
    const lanes high = lanes_pick(t->in_b, t->high, lanes_set(-HUGE_VALF));
    const float lowest = lanes_least(low);
    const float highest = lanes_most(high);
    t->limit = stray_of(s, &n.x, t->reach) + t->slack;
    const unsigned a = lowest_bit(t->in_a & ~lanes_above(low, lanes_set(lowest)));
    const unsigned b = lowest_bit(t->in_b & ~lanes_above(lanes_set(highest), high));
    const uint32_t above = t->in_a & lanes_above(low, lanes_set(highest + t->limit));
    const uint32_t below = t->in_b & lanes_above(lanes_set(lowest - t->limit), high);
    t->plane = n;
    LOOP_CERTIFY_PLANE(p, s, t->a->leaf, above, t->b->leaf, t->in_b, nsvcd__d3_widen(n));
    LOOP_CERTIFY_PLANE(p, s, t->a->leaf, t->in_a, t->b->leaf, below, nsvcd__d3_widen(n));
    t->in_a &= ~above;
    t->in_b &= ~below;
    if (!t->in_a || !t->in_b) {
      p->held = n;
      return 1;
    }
    nsvcd__f3 on_a = {0, 0, 0};
    nsvcd__f3 on_b = {0, 0, 0};
    const float at_start = lowest_corner(t->a->start, &start, a, HUGE_VALF, 1, &on_a);
    lowest_corner(t->a->end, &end, a, at_start, 1, &on_a);
    lowest_corner(t->b->t.corner, &rest, b, HUGE_VALF, -1, &on_b);
    const nsvcd__f3 w = nsvcd__f3_sub(on_a, on_b);
    if (step > 0) {
      const nsvcd__f3 d = nsvcd__f3_sub(w, v);
      const float square = nsvcd__f3_dot(d, d);
      const float share = square > 0 ? -nsvcd__f3_dot(v, d) / square : 0;
      if (!(share > 0))
        return 0;
      v = nsvcd__f3_fma(share < 1 ? share : 1, d, v);
    } else {
      v = w;
    }
    const float length = nsvcd__f3_length(v);
    if (!(length > t->limit))
      return 0;
    n = nsvcd__f3_scale(v, 0.999999f / length);
  }
  return 0;
}

// Triangle l of a, at both ends of the span.
static void read_moving(const leaf_pair *t, unsigned l, couple_places *c) {
  for (int k = 0; k < 3; k++) {
    c->start[k][0] = t->a->start[k].x[l];
    c->start[k][1] = t->a->start[k].y[l];
    c->start[k][2] = t->a->start[k].z[l];
    c->end[k][0] = t->a->end[k].x[l];
    c->end[k][1] = t->a->end[k].y[l];
    c->end[k][2] = t->a->end[k].z[l];
  }
}
static void read_resting(const leaf_pair *t, unsigned l, couple_places *c) {
  for (int k = 0; k < 3; k++) {
    c->rest[k][0] = t->b->t.corner[k].x[l];
    c->rest[k][1] = t->b->t.corner[k].y[l];
    c->rest[k][2] = t->b->t.corner[k].z[l];
  }
}

// Triangles of b that no box, normal or the plane tried last parts from triangle l of a.
static uint32_t row_left(const leaf_pair *t, unsigned l, const couple_places *c) {
  const triangles *r = &t->b->t;
  const lanes3 *low_a = &t->a->low;
  const lanes3 *high_a = &t->a->high;
  const float from[3] = {low_a->x[l], low_a->y[l], low_a->z[l]};
  const float to[3] = {high_a->x[l], high_a->y[l], high_a->z[l]};
  lanes gap = boxes_gap(&r->low, &r->high, from, to, t->slack);
  gap = lanes_max(gap, t->low[l] - t->high - t->limit);
  LOOP_AXIS(0, gap, lanes3_row(&t->plane.x));
  const uint32_t left = t->in_b & ~lanes_above(gap, lanes_set(0));
  if (!left)
    return 0;
  const lanes3 n = t->b->normals;
  const float v[3] = {t->a->normals.x[l], t->a->normals.y[l], t->a->normals.z[l]};
  lanes low = lanes_set(HUGE_VALF);
  lanes high = -low;
  lanes rest_low = low;
  lanes rest_high = high;
  for (int k = 0; k < 3; k++) {
    const lanes start = n.x * c->start[k][0] + n.y * c->start[k][1] + n.z * c->start[k][2];
    const lanes end = n.x * c->end[k][0] + n.y * c->end[k][1] + n.z * c->end[k][2];
    const lanes3 at = r->corner[k];
    const lanes rest = v[0] * at.x + v[1] * at.y + v[2] * at.z;
    low = lanes_min(low, lanes_min(start, end));
    high = lanes_max(high, lanes_max(start, end));
    rest_low = lanes_min(rest_low, rest);
    rest_high = lanes_max(rest_high, rest);
  }
  gap = lanes_max(low - t->b->height, t->b->height - high) - t->resting_stray;
  LOOP_AXIS(0, gap - t->slack, n);
  gap = lanes_max(gap, lanes_max(t->a->below[l] - rest_high, rest_low - t->a->above[l]));
  LOOP_AXIS(0, gap - t->slack, lanes3_row(v));
  return left & ~lanes_above(gap, lanes_set(t->slack));
}

// Triangles of a that none of these parts from triangle l of b.
static uint32_t column_left(const leaf_pair *t, unsigned l, const couple_places *c) {
  const triangles *r = &t->b->t;
  const moving_leaf *a = t->a;
  const float low_b[3] = {r->low.x[l], r->low.y[l], r->low.z[l]};
  const float high_b[3] = {r->high.x[l], r->high.y[l], r->high.z[l]};
  lanes gap = boxes_gap(&a->low, &a->high, low_b, high_b, t->slack);
  gap = lanes_max(gap, t->low - t->high[l] - t->limit);
  LOOP_AXIS(0, gap, lanes3_row(&t->plane.x));
  const uint32_t left = t->in_a & ~lanes_above(gap, lanes_set(0));
  if (!left)
    return 0;
  const lanes3 n = a->normals;
  const nsvcd__f3 v = {t->b->normals.x[l], t->b->normals.y[l], t->b->normals.z[l]};
  const float height = t->b->height[l];
  lanes low = lanes_set(HUGE_VALF);
  lanes high = -low;
  lanes rest_low = low;
  lanes rest_high = high;
  for (int k = 0; k < 3; k++) {
    const lanes3 from = a->start[k];
    const lanes3 to = a->end[k];
    const lanes start = v.x * from.x + v.y * from.y + v.z * from.z;
    const lanes end = v.x * to.x + v.y * to.y + v.z * to.z;
    const lanes rest = n.x * c->rest[k][0] + n.y * c->rest[k][1] + n.z * c->rest[k][2];
    low = lanes_min(low, lanes_min(start, end));
    high = lanes_max(high, lanes_max(start, end));
    rest_low = lanes_min(rest_low, rest);
    rest_high = lanes_max(rest_high, rest);
  }
  gap = lanes_max(low - height, height - high) - t->resting_stray[l];
  LOOP_AXIS(0, gap - t->slack, lanes3_row(&v.x));
  gap = lanes_max(gap, lanes_max(a->below - rest_high, rest_low - a->above));
  LOOP_AXIS(0, gap - t->slack, n);
  return left & ~lanes_above(gap, lanes_set(t->slack));
}

typedef struct couple_list {
  uint32_t count;
  uint8_t a[256], b[256];
} couple_list;

typedef enum couple_verdict { COUPLE_PARTED, COUPLE_LEFT, COUPLE_MEETS } couple_verdict;

static couple_verdict look_at_couple(loop *p, span *s, const leaf_pair *t, const couple_places *c,
                                     uint32_t a, uint32_t b) {
  const couple_gaps gaps = part_couple(s, c, t->reach);
  const int is_parted = gaps.all - t->slack > 0;
  p->out.couples++;
  LOOP_CERTIFY_BEST(p, s, t->a->leaf, a & 15, t->b->leaf, b & 15, is_parted);
  if (is_parted)
    return COUPLE_PARTED;
  if (gaps.start > s->rounding && gaps.end > s->rounding)
    return COUPLE_LEFT;
  double start;
  double end;
  const couple exact = couple_at(p, s, a, b);
  span_ends(&p->m, s);
  span_times(&p->m, s, &start, &end);
  if (!(gaps.start > s->rounding) && couple_meets(p, &exact, &s->exact_start, start))
    return COUPLE_MEETS;
  if (s->last > s->first && !(gaps.end > s->rounding) &&
      couple_meets(p, &exact, &s->exact_end, end))
    return COUPLE_MEETS;
  return COUPLE_LEFT;
}

// The lane that is deepest in the other leaf along the plane that was tried last.
FAST unsigned deepest_lane(uint32_t in, lanes height) {
  const lanes here = lanes_pick(in, height, lanes_set(HUGE_VALF));
  const uint32_t above = lanes_above(here, lanes_set(lanes_least(here)));
  return lowest_bit(in & ~above);
}

// Couples that no plane parts; 1: one of them meets at an end of the span. The leaf of which fewer
// triangles are left goes one by one, the other one 16 at a time.
static int find_couples(loop *p, span *s, leaf_pair *t, uint32_t word_a, uint32_t word_b,
                        int may_halve, couple_list *list) {
  const int by_a = __builtin_popcount(t->in_a) <= __builtin_popcount(t->in_b);
  list->count = 0;
  find_normals(s, t->a, t->b, t->reach);
  t->resting_stray = stray_along(s, t->b->normals, t->reach);
  for (uint32_t in = by_a ? t->in_a : t->in_b; in;) {
    unsigned i = by_a ? deepest_lane(in, t->low) : deepest_lane(in, -t->high);
    in &= ~(1u << i);
    unsigned j = i;
    couple_places c;
    p->out.rows++;
    p->out.steps++;
    if (by_a)
      read_moving(t, i, &c);
    else
      read_resting(t, j, &c);
    uint32_t left = by_a ? row_left(t, i, &c) : column_left(t, j, &c);
    LOOP_CERTIFY(p, s, (by_a ? t->in_b : t->in_a) & ~left, t->a->leaf, by_a ? 1u << i : 0,
                 t->b->leaf, by_a ? 0 : 1u << j);
    while (left) {
      const unsigned l = by_a ? deepest_lane(left, -t->high) : deepest_lane(left, t->low);
      left &= ~(1u << l);
      *(by_a ? &j : &i) = l;
      if (by_a)
        read_resting(t, j, &c);
      else
        read_moving(t, i, &c);
      const couple_verdict verdict = look_at_couple(p, s, t, &c, word_a << 4 | i, word_b << 4 | j);
      if (verdict == COUPLE_MEETS)
        return 1;
      if (verdict == COUPLE_PARTED)
        continue;
      if (list->count == FEW_COUPLES && may_halve) {
        list->count++;
        return 0;
      }
      list->a[list->count] = (uint8_t)i;
      list->b[list->count++] = (uint8_t)j;
    }
  }
  return 0;
}

// ---- the loop

static moving_children *moving_at(loop *p, const span *s, uint32_t word) {
  moving_children *out = &p->known.moved[(word >> 3 ^ s->id) % MOVED_SLOTS];
  const tree_node *node = node_at(p->a, word);
  if (out->span != s->id || out->node != node)
    move_along_b(s, p->a, node, out);
  return out;
}
static void moving_child_at(loop *p, const span *s, uint32_t place, moving_child *out) {
  moving_children *of = moving_at(p, s, place >> 4);
  if (!of->all)
    move_all(s, p->m.scale, p->a, of);
  child_of_lane(of, place & 15, out);
}

// Puts the halves of a span on the list in which two children still meet, the nearer one on top.
static void halve(loop *p, uint64_t id, uint32_t place_a, const tree_child *a, uint32_t place_b,
                  const tree_child *b) {
  float gaps[2];
  p->out.halvings++;
  for (uint64_t k = 0; k < 2; k++) {
    const span *s = span_at(&p->m, 2 * id + k);
    gaps[k] = pair_gap(s, a, b);
    LOOP_CERTIFY(p, s, gaps[k] > 0, node_at(p->a, place_a >> 4), 1u << (place_a & 15),
                 node_at(p->b, place_b >> 4), 1u << (place_b & 15));
  }
  const uint64_t nearer = gaps[1] < gaps[0] && !(p->first > 0);
  if (!(gaps[1 - nearer] > 0))
    push(p, 2 * id + 1 - nearer, place_a, place_b);
  if (!(gaps[nearer] > 0))
    push(p, 2 * id + nearer, place_a, place_b);
}

// Of the motion, gone by at a knot.
static double share_at(const loop *p, uint32_t knot) {
  return (double)p->m.knots.tick[knot] / (double)p->m.of->ticks;
}

// How far what is at c may go in a span.
static float way_of(const span *s, const tree_child *c) {
  float square = 0;
  for (int k = 0; k < 3; k++) {
    const float d = dot3(s->at_end[k], c->centre) + s->end_height[k] -
                    dot3(s->at_start[k], c->centre) - s->start_height[k];
    square += d * d;
  }
  return sqrtf(square) + STRAY_WEIGHT * (s->ea + s->eb * c->reach);
}

// A span of arcs, and which of them are left.
typedef struct arc_share {
  uint64_t span;
  uint32_t first, count;  // of those in arc_places
} arc_share;

// How far the child goes in some of the arcs; of no account to what is proven.
static float way_in_arcs(const loop *p, const arc_places *of, const tree_child *a,
                         const arc_share *share, uint32_t first_knot) {
  const uint32_t last = share->first + share->count;
  const uint32_t middle = first_knot + (share->first + last) / 2;
  float square = 0;
  for (int k = 0; k < 3; k++) {
    const float d = of->at[k][last] - of->at[k][share->first];
    square += d * d;
  }
  const float bulge = p->m.knots.bulge[middle] * a->reach + p->m.knots.drift[middle];
  return sqrtf(square) + STRAY_WEIGHT * bulge * (float)(share->count * share->count);
}

static uint32_t deepest_arc(const arc_places *of, uint64_t met) {
  uint32_t best = (uint32_t)__builtin_ctzll(met);
  for (; met; met &= met - 1) {
    const uint32_t arc = (uint32_t)__builtin_ctzll(met);
    best = of->gaps[arc] < of->gaps[best] ? arc : best;
  }
  return best;
}

// Before anything else a witness is looked for where two children are deepest in each other.
static void look_at_deepest(loop *p, uint32_t knot, float gap, float far, uint32_t a, uint32_t b) {
  if (!(gap < -LOOK_DEEP * far))
    return;
  p->look_end = p->out.steps + LOOK_STEPS;
  push(p, INSTANT | knot, a, b);
}

// Cuts a span of some arcs at once into spans in which two children do not move far, and leaves out
// those in which their boxes do not meet. The one with the least gap is on top.
static void cut_arcs(loop *p, const span *s, uint32_t place_a, const tree_child *a,
                     uint32_t place_b, const tree_child *b, float far) {
  arc_places of;
  arc_share list[8];
  arc_share kept[MOST_ARCS];
  float gaps[MOST_ARCS];
  uint32_t count = 0;
  uint32_t n = 0;
  uint64_t met = arcs_met(&p->m, s->first, s->last - s->first, a, b, &of);
  p->out.cuts++;
  LOOP_CERTIFY_ARCS(p, s, met, place_a, place_b);
  for (uint32_t k = s->last - s->first; p->has_contact && k-- > 0;) {
    if (share_at(p, s->first + k) >= p->end)
      met &= ~((uint64_t)1 << k);
  }
  const arc_share all = {s->id, 0, s->last - s->first};
  list[count++] = all;
  while (count) {
    const arc_share share = list[--count];
    const uint64_t lanes_of = share.count < 64 ? ((uint64_t)1 << share.count) - 1 : ~(uint64_t)0;
    const uint64_t here = met >> share.first & lanes_of;
    if (!here)
      continue;
    const int few = 2 * (uint32_t)__builtin_popcountll(here) < share.count;
    if (share.count > 1 && (few || share.span == s->id ||
                            way_in_arcs(p, &of, a, &share, s->first) > far)) {
      const uint32_t middle = (s->first + share.first + s->first + share.first + share.count) / 2 -
                              (s->first + share.first);
      const arc_share later = {2 * share.span + 1, share.first + middle, share.count - middle};
      const arc_share sooner = {2 * share.span, share.first, middle};
      list[count++] = later;
      list[count++] = sooner;
      continue;
    }
    float gap = p->first > 0 ? (float)(share.first + 1) : HUGE_VALF;  // then the earliest is first
    for (uint64_t left = p->first > 0 ? 0 : here; left; left &= left - 1)
      gap = less(gap, of.gaps[share.first + (uint32_t)__builtin_ctzll(left)]);
    uint32_t at = n++;
    for (; at > 0 && gaps[at - 1] < gap; at--) {
      gaps[at] = gaps[at - 1];
      kept[at] = kept[at - 1];
    }
    gaps[at] = gap;
    kept[at] = share;
  }
  for (uint32_t k = 0; k < n; k++)
    push(p, kept[k].span, place_a, place_b);
  if (!p->look_end && n)
    look_at_deepest(p, s->first + deepest_arc(&of, met), of.gaps[deepest_arc(&of, met)], far,
                    place_a, place_b);
}

static void cut_span(loop *p, const span *s, uint32_t place_a, const tree_child *a,
                     uint32_t place_b, const tree_child *b, float far) {
  const uint32_t arcs = s->last - s->first;
  if (arcs > 1 && arcs <= MOST_ARCS)
    cut_arcs(p, s, place_a, a, place_b, b, far);
  else
    halve(p, s->id, place_a, a, place_b, b);
}

// t is filled in. 1: two triangles meet.
static int open_leaves(loop *p, span *s, leaf_pair *t, uint32_t place_a, uint32_t place_b) {
  couple_list list;
  const uint32_t word_a = (uint32_t)((const uint32_t *)(const void *)t->a->leaf -
                                     (const uint32_t *)(const void *)p->a);
  const uint32_t word_b = (uint32_t)((const uint32_t *)(const void *)t->b->leaf -
                                     (const uint32_t *)(const void *)p->b);
  t->low = t->high = lanes_set(0);
  t->limit = HUGE_VALF;
  if (__builtin_popcount(t->in_a) * __builtin_popcount(t->in_b) > 1 &&
      plane_parts_leaves(p, s, t))
    return 0;
  const int may_halve = (s->last - s->first > 1 || s->to - s->from > SHORT_SPAN) &&
                        s->way + s->turn * t->reach > 0;
  if (find_couples(p, s, t, word_a, word_b, may_halve, &list))
    return 1;
  if (list.count > FEW_COUPLES && may_halve) {
    const tree_child a = child_at(p->a, place_a);
    const tree_child b = child_at(p->b, place_b);
    const float size = less(p->m.scale * a.size, b.size);
    cut_span(p, s, place_a, &a, place_b, &b, more(CUT_WAY * size, CUT_PARTS * way_of(s, &a)));
    return 0;
  }
  for (uint32_t k = 0; k < list.count && !(s->id & INSTANT); k++)
    push_couple(p, s->id, COUPLE | word_a << 4 | list.a[k], word_b << 4 | list.b[k]);
  return 0;
}

// A leaf of a against one of b whose boxes meet: that of a over the span along b's axes, and b's.
// 1: two triangles meet.
static int open_pair(loop *p, span *s, uint32_t place_a, const float *low_a, const float *high_a,
                     float reach, uint32_t place_b, const float *low_b, const float *high_b) {
  leaf_pair t;
  const uint32_t link_a = node_at(p->a, place_a >> 4)->links[place_a & 15];
  const uint32_t link_b = node_at(p->b, place_b >> 4)->links[place_b & 15];
  t.b = resting_leaf_at(p, link_b & ~LEAF_LINK);
  float slack = s->rounding + leaf_error(t.b->leaf);
  p->out.leaves++;
  const uint32_t all_b = first_lanes(t.b->leaf->count);
  const lanes gap_b = boxes_gap(&t.b->t.low, &t.b->t.high, low_a, high_a, slack);
  t.in_b = all_b & ~lanes_above(gap_b, lanes_set(0));
  LOOP_CERTIFY(p, s, all_b & ~t.in_b, node_at(p->a, place_a >> 4), 1u << (place_a & 15),
               t.b->leaf, 0);
  if (!t.in_b)
    return 0;
  t.a = moving_leaf_at(p, s, link_a & ~LEAF_LINK, reach);
  t.slack = slack + p->m.scale * leaf_error(t.a->leaf);
  const uint32_t all_a = first_lanes(t.a->leaf->count);
  const lanes gap_a = boxes_gap(&t.a->low, &t.a->high, low_b, high_b, t.slack);
  t.in_a = all_a & ~lanes_above(gap_a, lanes_set(0));
  LOOP_CERTIFY(p, s, all_a & ~t.in_a, t.a->leaf, 0, node_at(p->b, place_b >> 4),
               1u << (place_b & 15));
  p->out.steps++;
  t.reach = reach;
  return t.in_a && open_leaves(p, s, &t, place_a, place_b);
}

// The lanes that met, the greatest gap first.
static int sort_met(uint32_t met, lanes gaps, uint32_t *slots) {
  float sorted[LANES];
  int n = 0;
  for (; met; met &= met - 1, n++) {
    const uint32_t slot = lowest_bit(met);
    const float gap = gaps[slot];
    int at = n;
    for (; at > 0 && sorted[at - 1] < gap; at--) {
      sorted[at] = sorted[at - 1];
      slots[at] = slots[at - 1];
    }
    sorted[at] = gap;
    slots[at] = slot;
  }
  return n;
}

// A child of a (what is at its place) against those of a node of b. 1: two triangles meet.
static int open_resting(loop *p, span *s, uint32_t place, const moving_child *a, uint32_t word,
                        const resting_children *b) {
  lanes gaps;
  uint32_t slots[LANES];
  const tree_node *node = node_at(p->b, word);
  const uint32_t met = part_resting(s, a, b, &gaps);
  LOOP_CERTIFY(p, s, b->there & ~met, node_at(p->a, place >> 4), 1u << (place & 15), node, 0);
  if (!met)
    return 0;
  const uint32_t link = node_at(p->a, place >> 4)->links[place & 15];
  const int leaves = (node->links[0] & link & LEAF_LINK) != 0;
  const int n = sort_met(met, gaps, slots);
  for (int k = 0; k < n && !leaves; k++)
    push(p, s->id, place, place_of(word, slots[k]));
  for (int k = n - 1; k >= 0 && leaves; k--) {
    const unsigned l = slots[k];
    const float low[3] = {b->low[0][l], b->low[1][l], b->low[2][l]};
    const float high[3] = {b->high[0][l], b->high[1][l], b->high[2][l]};
    if (open_pair(p, s, place, a->low, a->high, a->reach, place_of(word, l), low, high))
      return 1;
  }
  return 0;
}

// What are left of a node's children, each against those of a node of b: the one with the least gap
// first, or, where they go on the list, last.
static int open_both(loop *p, span *s, uint32_t word_a, const moving_children *a, uint32_t word_b,
                     const uint32_t *slots, int n) {
  resting_children b;
  moving_child child;
  const int leaves =
      (node_at(p->a, word_a)->links[0] & node_at(p->b, word_b)->links[0] & LEAF_LINK) != 0;
  rest_all(s, p->b, node_at(p->b, word_b), &b);
  for (int k = 0; k < n; k++) {
    const unsigned l = slots[leaves ? n - 1 - k : k];
    child_of_lane(a, l, &child);
    p->out.steps++;
    if (open_resting(p, s, place_of(word_a, l), &child, word_b, &b))
      return 1;
  }
  return 0;
}

// Children of a against one of b, which is opened too if it is not much smaller.
static int open_moving(loop *p, const work_item *item, span *s, uint32_t word, const tree_child *b,
                       int both) {
  lanes gaps;
  uint32_t slots[LANES];
  const tree_node *node = node_at(p->a, word);
  moving_children *children = moving_at(p, s, word);
  const uint32_t met = part_moving(s, p->m.scale, p->a, children, b, &gaps);
  LOOP_CERTIFY(p, s, children->there & ~met, node, 0, node_at(p->b, item->b >> 4),
               1u << (item->b & 15));
  if (!met)
    return 0;
  const int n = sort_met(met, gaps, slots);
  if (both)
    return open_both(p, s, word, children, b->link, slots, n);
  const int leaves = (node->links[0] & b->link & LEAF_LINK) != 0;
  for (int k = 0; k < n && !leaves; k++)
    push(p, s->id, place_of(word, slots[k]), item->b);
  if (!leaves)
    return 0;
  float from[3];
  float to[3];
  for (int k = 0; k < 3; k++) {
    from[k] = b->centre[k] - b->half[k];
    to[k] = b->centre[k] + b->half[k];
  }
  for (int k = n - 1; k >= 0; k--) {
    const unsigned l = slots[k];
    const float low[3] = {children->low[0][l], children->low[1][l], children->low[2][l]};
    const float high[3] = {children->high[0][l], children->high[1][l], children->high[2][l]};
    if (open_pair(p, s, place_of(word, l), low, high, children->reach[l], item->b, from, to))
      return 1;
  }
  return 0;
}

// Two leaves, of a span that was halved for them.
static int open_last(loop *p, const work_item *item, span *s, const tree_child *a,
                     const tree_child *b) {
  float low[3];
  float high[3];
  float from[3];
  float to[3];
  box_over_span(s, a, low, high);
  for (int k = 0; k < 3; k++) {
    from[k] = b->centre[k] - b->half[k];
    to[k] = b->centre[k] + b->half[k];
  }
  return open_pair(p, s, item->a, low, high, a->reach, item->b, from, to);
}

#ifndef ALIKE
#define ALIKE 4  // both are opened if one is no larger than this times the other
#endif

// 1: two triangles meet.
static int work_on(loop *p, const work_item *item) {
  if (item->a & COUPLE)
    return settle_couple(p, item);
  span *s = span_at(&p->m, item->span);
  const tree_child a = child_at(p->a, item->a);
  const tree_child b = child_at(p->b, item->b);
  const float size_a = p->m.scale * a.size;
  const float size_b = b.size;
  const float way = way_of(s, &a);
  p->out.visits++;
  p->out.steps++;
  const int is_leaf_a = (a.link & LEAF_LINK) != 0;
  const int is_leaf_b = (b.link & LEAF_LINK) != 0;
  const float far = LONG_WAY * more(size_a, size_b);
  // the end is in it: what comes after is left out
  if (p->has_contact && s->last - s->first > 1 && !(share_at(p, s->last) <= p->end)) {
    cut_span(p, s, item->a, &a, item->b, &b, far);
    return 0;
  }
  if (way > far && way > 4 * s->hair && !(item->span >> 40)) {
    cut_span(p, s, item->a, &a, item->b, &b, far);
    return 0;
  }
  if (is_leaf_a && is_leaf_b)
    return open_last(p, item, s, &a, &b);
  if (!is_leaf_a && (is_leaf_b || ALIKE * size_a > size_b))
    return open_moving(p, item, s, a.link, &b, !is_leaf_b && size_a < ALIKE * size_b);
  moving_child child;
  resting_children resting;
  moving_child_at(p, s, item->a, &child);
  rest_all(s, p->b, node_at(p->b, b.link), &resting);
  return open_resting(p, s, item->a, &child, b.link, &resting);
}

static double item_start(const loop *p, const work_item *item) {
  span s;
  double start;
  double end;
  find_span(&p->m, item->span, &s);
  span_times(&p->m, &s, &start, &end);
  return start;
}

// A contact was found. 1: that is the answer. Else what the item is about is still to be proven,
// as far as it is before the end; what was made of it since is left out.
static int goes_on(loop *p, const work_item *item, uint32_t count, uint32_t couple_count) {
  if (!(p->first > 0) || !(p->end > 0))
    return 0;
  p->count = count;
  p->couple_count = couple_count;
  if (!(item->span & INSTANT))
    push(p, item->span, item->a, item->b);
  return 1;
}

static void begin_loop(loop *p) {
  p->count = p->couple_first = p->couple_count = 0;
  p->doubt = p->has_contact = 0;
  p->doubt_from = p->end = HUGE_VAL;
  p->look_end = 0;
  p->parting = nsvcd__d3_of(0, 0, 0);
  p->held = nsvcd__f3_of(0, 0, 0);
  for (int k = 0; k < MOVED_SLOTS; k++)
    p->known.moved[k].node = NULL;
  for (int k = 0; k < MOVING_LEAVES; k++)
    p->known.moving[k].leaf = NULL;
  for (int k = 0; k < RESTING_LEAVES; k++)
    p->known.resting[k].leaf = NULL;
}

// p->m, a, b, limit, clearance and first are set.
static void run_loop(loop *p) {
  begin_loop(p);
  push(p, 1, place_of(p->a->top, 0), place_of(p->b->top, 0));
  while (p->count || p->couple_count) {
    work_item item;
    if (p->count) {
      item = p->list[--p->count];
    } else {
      item = p->couples[p->couple_first % COUPLE_SLOTS];
      p->couple_first++;
      p->couple_count--;
    }
    if (item.span & INSTANT && !(item.a & COUPLE) && p->out.steps > p->look_end)
      continue;
    if (p->has_contact && item_start(p, &item) >= p->end)
      continue;
    const uint32_t count = p->count;
    const uint32_t couple_count = p->couple_count;
    if (work_on(p, &item) && !goes_on(p, &item, count, couple_count))
      break;
    if (is_spent(p)) {
      p->doubt |= p->count + p->couple_count > 0;
      break;
    }
  }
  if (!p->has_contact)
    p->out.verdict = p->doubt ? LOOP_UNDECIDED : LOOP_FREE;
  // what is left was not proven
  while (p->first > 0 && p->count + p->couple_count > 0) {
    const work_item *item = p->count ? &p->list[--p->count]
                                     : &p->couples[p->couple_first++ % COUPLE_SLOTS];
    p->couple_count -= item >= p->couples && item < p->couples + COUPLE_SLOTS;
    p->doubt_from = fmin(p->doubt_from, item_start(p, item));
  }
  p->out.free_until = p->first > 0 ? fmax(0, fmin(p->doubt_from, fmin(p->end, 1)))
                                   : p->out.verdict == LOOP_FREE;
}

#endif
