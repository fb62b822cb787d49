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
//   - split into pieces that together are all of it: halves of its span, children of the larger
//     node, or couples of its leaves' triangles. Pieces of these that are parted at once are not
//     even put on the list.
// So when the list is empty and there was no doubt, everything has been parted: the surfaces never
// meet. The order is of no account to that: what has the least gap comes first, since it is the
// likeliest to hold a witness.
#ifndef LOOP_LOOP_H
#define LOOP_LOOP_H

#include "part.h"

#define COUPLE 0x80000000u  // of work.a: a and b are triangles, a leaf's word and a lane
#define WORK_SLOTS 1024
#ifndef FEW_COUPLES
#define FEW_COUPLES 3
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
  double time;
  uint32_t triangle_a, triangle_b;
  // what it took
  uint32_t steps, visits, leaves, rows, couples, halvings, most_waiting;
} loop_answer;

// Leaves' triangles, as the loop needs them.
typedef struct moving_leaf {
  uint64_t span;
  const tree_leaf *leaf;
  triangles start, end;  // posed
  leaf_points at_start, at_end;
  lanes3 low, high;      // their boxes over the span, with stray, but for slack
  lanes3 normals;        // half way
} moving_leaf;
typedef struct resting_leaf {
  const tree_leaf *leaf;
  triangles t;
  leaf_points points;
  lanes3 normals;
  lanes height;  // of their planes
} resting_leaf;

#define MOVED_SLOTS 16
#define MOVING_LEAVES 4
#define RESTING_LEAVES 8

// What has been reckoned before; it may be wiped at any time, and no verdict changes.
typedef struct memo {
  uint64_t moved_span[MOVED_SLOTS];
  uint32_t moved_place[MOVED_SLOTS];
  moving_child moved[MOVED_SLOTS];
  moving_leaf moving[MOVING_LEAVES];
  resting_leaf resting[RESTING_LEAVES];
} memo;

typedef struct loop {
  motion m;
  memo known;
  const tree_body *a, *b;
  uint32_t limit;
  int doubt;
  uint32_t count;
  nsvcd__d3 parting;  // parted a couple last,
  nsvcd__f3 held;     // and leaves
  loop_answer out;
  work_item list[WORK_SLOTS];
} loop;

static int is_spent(loop *p) {
  return p->out.steps > p->limit;
}
static void push(loop *p, uint64_t span, uint32_t a, uint32_t b) {
  if (p->count == WORK_SLOTS) {
    p->doubt = 1;
    p->limit = 0;
    return;
  }
  const work_item item = {span, a, b};
  p->list[p->count++] = item;
  if (p->count > p->out.most_waiting)
    p->out.most_waiting = p->count;
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
  // s->rounding is NSVCD__ROUNDING of the same lengths
  c.rounding = NSVCD__SAME_PLACE / (double)NSVCD__ROUNDING * (double)s->rounding;
  c.slack = (double)p->m.scale * (double)leaf_error(leaf_a) + (double)leaf_error(leaf_b) + c.rounding;
  return c;
}

// Do they meet at that pose? Then that is the answer.
static int couple_meets(loop *p, const couple *c, const nsvcd__placement *at, double time) {
  nsvcd__d3 posed[3];
  nsvcd__d3 point;
  p->out.couples++;
  p->out.steps++;
  nsvcd__place_triangle(at, c->a, posed);
  if (!nsvcd__triangles_meet(posed, c->b, &point))
    return 0;
  p->out.verdict = LOOP_HIT;
  p->out.time = time;
  p->out.triangle_a = c->number_a;
  p->out.triangle_b = c->number_b;
  return 1;
}

// Does a plane part them over a span?
static int plane_parts_couple(const span *s, const couple *c, nsvcd__d3 n) {
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (int k = 0; k < 3; k++) {
    lowest = fmin(lowest, nsvcd__d3_dot(n, nsvcd__place_point(&s->exact_start, c->a[k])));
    lowest = fmin(lowest, nsvcd__d3_dot(n, nsvcd__place_point(&s->exact_end, c->a[k])));
    highest = fmax(highest, nsvcd__d3_dot(n, c->b[k]));
  }
  return lowest - highest > c->slack + s->exact_rounding + stray_along_one(s, n, c->reach);
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

// Have they passed through each other within a short span, at one time only?
static int couple_passes(loop *p, const span *s, const couple *c, const nsvcd__placement *middle,
                         double way) {
  nsvcd__passage passage;
  nsvcd__place_triangle(&s->exact_start, c->a, passage.start);
  nsvcd__place_triangle(middle, c->a, passage.middle);
  nsvcd__place_triangle(&s->exact_end, c->a, passage.end);
  passage.way = way;
  if (!nsvcd__triangles_pass(&passage, c->b, c->rounding))
    return 0;
  double end;
  p->out.verdict = LOOP_HIT;
  span_times(&p->m, s, &p->out.time, &end);
  p->out.triangle_a = c->number_a;
  p->out.triangle_b = c->number_b;
  return 1;
}

// 1: they meet.
static int settle_couple(loop *p, const work_item *item) {
  span *s = span_at(&p->m, item->span);
  const couple c = couple_at(p, s, item->a, item->b);
  double time;
  p->out.steps++;
  p->out.couples++;
  span_ends(&p->m, s);
  if (plane_parts_couple(s, &c, p->parting))
    return 0;
  const nsvcd__placement middle = middle_pose(p, s, &time);
  nsvcd__d3 posed[3];
  nsvcd__place_triangle(&middle, c.a, posed);
  const nsvcd__nearest nearest = nsvcd__triangles_nearest(posed, c.b);
  const double distance = sqrt(nearest.square);
  if (distance <= c.rounding) {
    p->out.verdict = LOOP_HIT;
    p->out.time = time;
    p->out.triangle_a = c.number_a;
    p->out.triangle_b = c.number_b;
    return 1;
  }
  p->parting = nsvcd__d3_scale(nsvcd__d3_sub(nearest.on_a, nearest.on_b), 1 / distance);
  if (plane_parts_couple(s, &c, p->parting))
    return 0;
  const double way = (double)s->way + (double)s->turn * c.reach;
  const double strays = (double)s->ea + (double)s->eb * c.reach;
  const int tiny = way + 2 * strays <= 0.25 * c.slack || item->span >> MOST_HALVINGS;
  if (!tiny) {
    p->out.halvings++;
    push(p, 2 * item->span, item->a, item->b);
    push(p, 2 * item->span + 1, item->a, item->b);
    return 0;
  }
  if (couple_passes(p, s, &c, &middle, way + 2 * strays))
    return 1;
  if (!p->doubt && p->limit > p->out.steps)  // only a witness still decides
    p->limit = p->out.steps + (p->limit - p->out.steps) / NSVCD__IN_DOUBT;
  p->doubt = 1;
  return 0;
}

// ---- leaves

// Two leaves' triangles.
typedef struct leaf_pair {
  const moving_leaf *a;
  const resting_leaf *b;
  lanes resting_stray;  // along b's normals
  float slack;          // rounding and both leaves' quanta
  float reach;          // of a's leaf
  uint32_t in_a, in_b;  // lanes that may matter
} leaf_pair;

static const moving_leaf *moving_leaf_at(loop *p, const span *s, const moving_child *a) {
  const uint32_t word = a->child.link & ~LEAF_LINK;
  const tree_leaf *leaf = (const tree_leaf *)body_at(p->a, word);
  moving_leaf *out = &p->known.moving[(word >> 3 ^ s->id) % MOVING_LEAVES];
  if (out->leaf == leaf && out->span == s->id)
    return out;
  leaf_points points;
  lanes3 half_way[3];
  out->leaf = leaf;
  out->span = s->id;
  leaf_read(p->a, leaf, &points);
  out->at_start.sets = out->at_end.sets = points.sets;
  for (int k = 0; k < points.sets; k++) {
    out->at_start.at[k] = lanes3_add(lanes3_turn(s->start, points.at[k]),
                             lanes3_set(s->start_at[0], s->start_at[1], s->start_at[2]));
    out->at_end.at[k] = lanes3_add(lanes3_turn(s->end, points.at[k]),
                           lanes3_set(s->end_at[0], s->end_at[1], s->end_at[2]));
  }
  leaf_corners(leaf, &out->at_start, out->start.corner);
  leaf_corners(leaf, &out->at_end, out->end.corner);
  bound_triangles(&out->start);
  bound_triangles(&out->end);
  float stray[3];
  for (int k = 0; k < 3; k++) {
    stray[k] = s->axes_ea[k] + s->axes_eb[k] * a->child.reach;
    half_way[k] = lanes3_add(out->start.corner[k], out->end.corner[k]);
  }
  out->low = (lanes3){lanes_min(out->start.low.x, out->end.low.x) - stray[0],
                      lanes_min(out->start.low.y, out->end.low.y) - stray[1],
                      lanes_min(out->start.low.z, out->end.low.z) - stray[2]};
  out->high = (lanes3){lanes_max(out->start.high.x, out->end.high.x) + stray[0],
                       lanes_max(out->start.high.y, out->end.high.y) + stray[1],
                       lanes_max(out->start.high.z, out->end.high.z) + stray[2]};
  out->normals = face_normals(half_way);
  return out;
}

static const resting_leaf *resting_leaf_at(loop *p, const resting_child *b) {
  const uint32_t word = b->child.link & ~LEAF_LINK;
  const tree_leaf *leaf = (const tree_leaf *)body_at(p->b, word);
  resting_leaf *out = &p->known.resting[(word >> 3) % RESTING_LEAVES];
  if (out->leaf == leaf)
    return out;
  out->leaf = leaf;
  leaf_read(p->b, leaf, &out->points);
  leaf_corners(leaf, &out->points, out->t.corner);
  bound_triangles(&out->t);
  out->normals = face_normals(out->t.corner);
  out->height = lanes3_dot(out->normals, out->t.corner[0]);
  return out;
}

// Lanes of either that come near the other's box.
static int near_lanes(const moving_child *a, const resting_child *b, leaf_pair *t) {
  const lanes zero = lanes_set(0);
  const float slack = t->slack;
  const lanes3 low = t->a->low;
  const lanes3 high = t->a->high;
  const float *c = b->child.centre;
  float from[3];
  float to[3];
  for (int k = 0; k < 3; k++) {
    from[k] = c[k] - b->child.half[k] - slack;
    to[k] = c[k] + b->child.half[k] + slack;
  }
  lanes gap = lanes_max(low.x - to[0], from[0] - high.x);
  gap = wider(gap, low.y, high.y, lanes_set(from[1]), lanes_set(to[1]));
  gap = wider(gap, low.z, high.z, lanes_set(from[2]), lanes_set(to[2]));
  t->in_a = first_lanes(t->a->leaf->count) & ~lanes_above(gap, zero);
  if (!t->in_a)
    return 0;
  const triangles *r = &t->b->t;
  gap = lanes_max(r->low.x - (a->high[0] + slack), (a->low[0] - slack) - r->high.x);
  gap = wider(gap, r->low.y, r->high.y, lanes_set(a->low[1] - slack), lanes_set(a->high[1] + slack));
  gap = wider(gap, r->low.z, r->high.z, lanes_set(a->low[2] - slack), lanes_set(a->high[2] + slack));
  t->in_b = first_lanes(t->b->leaf->count) & ~lanes_above(gap, zero);
  return t->in_b != 0;
}

#ifndef PLANE_STEPS
#define PLANE_STEPS 6
#endif
#ifndef PLANE_ROWS
#define PLANE_ROWS 2
#endif

// The farthest of a leaf's vertices against n; *best is the least height so far.
static void farthest(const leaf_points *points, uint32_t last, const float *n, float *best,
                     nsvcd__f3 *where) {
  for (int k = 0; k < points->sets; k++) {
    const lanes3 *at = &points->at[k];
    const lanes height = n[0] * at->x + n[1] * at->y + n[2] * at->z;
    const uint32_t there = k + 1 < points->sets ? ALL_LANES : last;
    const lanes known = lanes_pick(there, height, lanes_set(HUGE_VALF));
    const float least = lanes_least(known);
    if (!(least < *best))
      continue;
    const unsigned l = lowest_bit(ALL_LANES & ~lanes_above(known, lanes_set(least)));
    *best = least;
    *where = nsvcd__f3_of(at->x[l], at->y[l], at->z[l]);
  }
}

// Does a plane part all of two leaves, whatever their triangles? The one that held last, then such
// as Gilbert's iteration finds.
static int plane_parts_leaves(loop *p, const span *s, const leaf_pair *t) {
  const uint32_t last_a = first_lanes((t->a->leaf->vertices - 1u) % LANES + 1);
  const uint32_t last_b = first_lanes((t->b->leaf->vertices - 1u) % LANES + 1);
  nsvcd__f3 n = p->held;
  nsvcd__f3 v = {0, 0, 0};
  for (int step = 0; step < PLANE_STEPS; step++) {
    float lowest = HUGE_VALF;
    float highest = HUGE_VALF;
    nsvcd__f3 low = {0, 0, 0};
    nsvcd__f3 high = low;
    const float back[3] = {-n.x, -n.y, -n.z};
    farthest(&t->a->at_start, last_a, &n.x, &lowest, &low);
    farthest(&t->a->at_end, last_a, &n.x, &lowest, &low);
    farthest(&t->b->points, last_b, back, &highest, &high);
    const float stray = stray_of(s, &n.x, t->reach) + t->slack;
    if (lowest + highest > stray) {
      p->held = n;
      return 1;
    }
    const nsvcd__f3 w = nsvcd__f3_sub(low, high);
    if (step > 0) {
      const nsvcd__f3 d = nsvcd__f3_sub(w, v);
      const float square = nsvcd__f3_dot(d, d);
      const float share = square > 0 ? -nsvcd__f3_dot(v, d) / square : 0;
      if (!(share > 0))
        return 0;
      v = nsvcd__f3_add_scaled(v, share < 1 ? share : 1, d);
    } else {
      v = w;
    }
    const float length = nsvcd__f3_length(v);
    if (!(length > stray))
      return 0;
    n = nsvcd__f3_scale(v, 0.999999f / length);
  }
  return 0;
}

// Triangle l of a, at both ends of the span.
static void read_moving(const leaf_pair *t, unsigned l, couple_places *c) {
  for (int k = 0; k < 3; k++) {
    c->start[k][0] = t->a->start.corner[k].x[l];
    c->start[k][1] = t->a->start.corner[k].y[l];
    c->start[k][2] = t->a->start.corner[k].z[l];
    c->end[k][0] = t->a->end.corner[k].x[l];
    c->end[k][1] = t->a->end.corner[k].y[l];
    c->end[k][2] = t->a->end.corner[k].z[l];
  }
}
static void read_resting(const leaf_pair *t, unsigned l, couple_places *c) {
  for (int k = 0; k < 3; k++) {
    c->rest[k][0] = t->b->t.corner[k].x[l];
    c->rest[k][1] = t->b->t.corner[k].y[l];
    c->rest[k][2] = t->b->t.corner[k].z[l];
  }
}

// Triangles of b that neither their boxes nor a normal part from triangle l of a.
static uint32_t row_left(const span *s, const leaf_pair *t, unsigned l, const couple_places *c) {
  const lanes zero = lanes_set(0);
  const triangles *r = &t->b->t;
  const lanes3 *from = &t->a->low;
  const lanes3 *to = &t->a->high;
  lanes gap = lanes_max(r->low.x - to->x[l], from->x[l] - r->high.x);
  gap = wider(gap, r->low.y, r->high.y, lanes_set(from->y[l]), lanes_set(to->y[l]));
  gap = wider(gap, r->low.z, r->high.z, lanes_set(from->z[l]), lanes_set(to->z[l]));
  gap -= t->slack;
  uint32_t left = t->in_b & ~lanes_above(gap, zero);
  if (!left)
    return 0;
  const lanes3 n = t->b->normals;
  const float v[3] = {t->a->normals.x[l], t->a->normals.y[l], t->a->normals.z[l]};
  lanes low = lanes_set(HUGE_VALF);
  lanes high = -low;
  lanes rest_low = low;
  lanes rest_high = high;
  float least = HUGE_VALF;
  float most = -HUGE_VALF;
  for (int k = 0; k < 3; k++) {
    const lanes start = n.x * c->start[k][0] + n.y * c->start[k][1] + n.z * c->start[k][2];
    const lanes end = n.x * c->end[k][0] + n.y * c->end[k][1] + n.z * c->end[k][2];
    const lanes3 at = r->corner[k];
    const lanes rest = v[0] * at.x + v[1] * at.y + v[2] * at.z;
    const float by_start = v[0] * c->start[k][0] + v[1] * c->start[k][1] + v[2] * c->start[k][2];
    const float by_end = v[0] * c->end[k][0] + v[1] * c->end[k][1] + v[2] * c->end[k][2];
    low = lanes_min(low, lanes_min(start, end));
    high = lanes_max(high, lanes_max(start, end));
    rest_low = lanes_min(rest_low, rest);
    rest_high = lanes_max(rest_high, rest);
    least = less(least, less(by_start, by_end));
    most = more(most, more(by_start, by_end));
  }
  const float stray = stray_of(s, v, t->reach);
  gap = lanes_max(low - t->b->height, t->b->height - high) - t->resting_stray;
  gap = lanes_max(gap, lanes_max(least - rest_high, rest_low - most) - stray);
  return left & ~lanes_above(gap - t->slack, zero);
}

typedef struct couple_list {
  uint32_t count;
  uint8_t a[256], b[256];
} couple_list;

// Couples that no plane parts; 1: one of them meets at an end of the span.
static int find_couples(loop *p, span *s, leaf_pair *t, uint32_t word_a, uint32_t word_b,
                        int may_halve, couple_list *list) {
  list->count = 0;
  t->resting_stray = stray_along(s, t->b->normals, t->reach);
  for (uint32_t in_a = t->in_a; in_a; in_a &= in_a - 1) {
    const unsigned i = lowest_bit(in_a);
    couple_places c;
    p->out.rows++;
    p->out.steps++;
    read_moving(t, i, &c);
    for (uint32_t left = row_left(s, t, i, &c); left; left &= left - 1) {
      const unsigned j = lowest_bit(left);
      read_resting(t, j, &c);
      const couple_gaps gaps = part_couple(s, &c, t->reach);
      p->out.couples++;
      if (gaps.all - t->slack > 0)
        continue;
      if (list->count == FEW_COUPLES && may_halve) {
        list->count++;
        return 0;
      }
      list->a[list->count] = (uint8_t)i;
      list->b[list->count++] = (uint8_t)j;
      if (gaps.start > s->rounding && gaps.end > s->rounding)
        continue;
      double start;
      double end;
      const couple exact = couple_at(p, s, word_a << 4 | i, word_b << 4 | j);
      span_ends(&p->m, s);
      span_times(&p->m, s, &start, &end);
      if (!(gaps.start > s->rounding) && couple_meets(p, &exact, &s->exact_start, start))
        return 1;
      if (!(gaps.end > s->rounding) && couple_meets(p, &exact, &s->exact_end, end))
        return 1;
    }
  }
  return 0;
}

// ---- the loop

// Puts the halves of a span on the list in which two children still meet, the nearer one on top.
static void halve(loop *p, const work_item *item, const moving_child *a, const resting_child *b) {
  float gaps[2];
  const tree_child child = a->child;
  p->out.halvings++;
  for (uint64_t k = 0; k < 2; k++) {
    span *s = span_at(&p->m, 2 * item->span + k);
    moving_child moving;
    move_child(s, &child, &moving);
    const resting_child resting = rest_child(s, &b->child);
    gaps[k] = pair_gap(s, p->m.scale, &moving, &resting);
  }
  const uint64_t nearer = gaps[1] < gaps[0];
  if (!(gaps[1 - nearer] > 0))
    push(p, 2 * item->span + 1 - nearer, item->a, item->b);
  if (!(gaps[nearer] > 0))
    push(p, 2 * item->span + nearer, item->a, item->b);
}

// 1: two triangles meet.
static int open_leaves(loop *p, const work_item *item, span *s, const moving_child *a,
                       const resting_child *b) {
  leaf_pair t;
  couple_list list;
  const uint32_t word_a = a->child.link & ~LEAF_LINK;
  const uint32_t word_b = b->child.link & ~LEAF_LINK;
  p->out.leaves++;
  t.a = moving_leaf_at(p, s, a);
  t.b = resting_leaf_at(p, b);
  t.slack = s->rounding + p->m.scale * leaf_error(t.a->leaf) + leaf_error(t.b->leaf);
  t.reach = a->child.reach;
  if (!near_lanes(a, b, &t))
    return 0;
  if (__builtin_popcount(t.in_a) >= PLANE_ROWS && plane_parts_leaves(p, s, &t))
    return 0;
  const int may_halve = (s->last - s->first > 1 || s->to - s->from > SHORT_SPAN) &&
                        s->way + s->turn * a->child.reach > 0;
  if (find_couples(p, s, &t, word_a, word_b, may_halve, &list))
    return 1;
  if (list.count > FEW_COUPLES && may_halve) {
    halve(p, item, a, b);
    return 0;
  }
  for (uint32_t k = 0; k < list.count; k++)
    push(p, item->span, COUPLE | word_a << 4 | list.a[k], word_b << 4 | list.b[k]);
  return 0;
}

// Puts children on the list, the least gap on top.
static void push_children(loop *p, const work_item *item, int of_a, uint32_t node, uint32_t met,
                          lanes gaps) {
  float sorted[LANES];
  uint32_t slots[LANES];
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
  for (int k = 0; k < n; k++) {
    const uint32_t place = place_of(node, slots[k]);
    push(p, item->span, of_a ? place : item->a, of_a ? item->b : place);
  }
}

static moving_child *moving_child_at(loop *p, span *s, uint32_t place) {
  const unsigned slot = (unsigned)((place ^ place >> 4 ^ s->id) % MOVED_SLOTS);
  memo *known = &p->known;
  if (known->moved_span[slot] != s->id || known->moved_place[slot] != place) {
    const tree_child child = child_at(p->a, place);
    move_child(s, &child, &known->moved[slot]);
    known->moved_span[slot] = s->id;
    known->moved_place[slot] = place;
  }
  return &known->moved[slot];
}

// 1: two triangles meet.
static int work_on(loop *p, const work_item *item) {
  if (item->a & COUPLE)
    return settle_couple(p, item);
  span *s = span_at(&p->m, item->span);
  moving_child *a = moving_child_at(p, s, item->a);
  const tree_child child_b = child_at(p->b, item->b);
  const resting_child b = rest_child(s, &child_b);
  const float size_a = p->m.scale * a->child.size;
  const float size_b = child_b.size;
  p->out.visits++;
  p->out.steps++;
  const float way = a->way + STRAY_WEIGHT * (a->stray - s->rounding);
  const int is_leaf_a = (a->child.link & LEAF_LINK) != 0;
  const int is_leaf_b = (child_b.link & LEAF_LINK) != 0;
  if (way > LONG_WAY * more(size_a, size_b) && way > 4 * s->rounding && !(item->span >> 40)) {
    halve(p, item, a, &b);
    return 0;
  }
  if (is_leaf_a && is_leaf_b)
    return pair_gap(s, p->m.scale, a, &b) > 0 ? 0 : open_leaves(p, item, s, a, &b);
  lanes gaps;
  const int of_a = !is_leaf_a && (is_leaf_b || size_a > size_b);
  const uint32_t node = of_a ? a->child.link : child_b.link;
  const tree_children children = children_of(of_a ? p->a : p->b, node_at(of_a ? p->a : p->b, node));
  const uint32_t met = of_a ? part_moving(s, p->m.scale, &children, &b, &gaps)
                            : part_resting(s, p->m.scale, a, &children, &gaps);
  if (met)
    push_children(p, item, of_a, node, met, gaps);
  return 0;
}

// p->m, a, b and limit are set.
static void run_loop(loop *p) {
  p->count = 0;
  p->doubt = 0;
  p->parting = nsvcd__d3_of(0, 0, 0);
  p->held = nsvcd__f3_of(0, 0, 0);
  memset(p->known.moved_span, 0, sizeof p->known.moved_span);
  for (int k = 0; k < MOVING_LEAVES; k++)
    p->known.moving[k].leaf = NULL;
  for (int k = 0; k < RESTING_LEAVES; k++)
    p->known.resting[k].leaf = NULL;
  push(p, 1, place_of(p->a->top, 0), place_of(p->b->top, 0));
  while (p->count) {
    const work_item item = p->list[--p->count];
    if (work_on(p, &item))
      return;
    if (is_spent(p)) {
      p->doubt |= p->count > 0;
      break;
    }
  }
  p->out.verdict = p->doubt ? LOOP_UNDECIDED : LOOP_FREE;
}

#endif
