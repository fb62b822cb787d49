// inside.h - is a component of one body within the other at the start of the motion?
// In: a motion and both trees. Out: 1 if a component starts within (so it
// collides), 0 if not, -1 where no ray could tell.
//
// One vertex of each component is asked about, if it is in the other body's box: a ray from it
// crosses the closed components of that body so often from within, less so often from without; the
// difference is how often they wind about it. Rays go through the tree: 16 boxes at a time, then 16
// triangles by signed volumes in float with a margin, and what is left exactly, in double
// (nsvcd__ray_crosses): a ray that passes an edge within the margin is replaced by another. What is
// asked is about stored surfaces. The true ones are within their quanta of these, so it holds for
// them where the vertex is farther than that from the stored surface: found by a walk to the boxes
// about it; then the loop need not run. Where it is nearer, the loop decides: if it parts all
// surfaces, by more than their quanta, then it holds too. It is asked before the loop where all of
// one body's box starts in the other's or where the components are few but more than one each, after
// it where only a part does, and else not at all.
#ifndef LOOP_INSIDE_H
#define LOOP_INSIDE_H

#include "loop.h"

// Children whose boxes the ray meets.
static uint32_t boxes_on_ray(const tree_children *c, const nsvcd__ray *ray, float margin) {
  const double *from = &ray->from.x;
  const double *way = &ray->direction.x;
  const lanes *low = &c->low.x;
  const lanes *high = &c->high.x;
  lanes enter = lanes_set(0);
  lanes leave = lanes_set(HUGE_VALF);
  for (int k = 0; k < 3; k++) {  // no component of a direction is near 0
    const float inverse = (float)(1 / way[k]);
    const lanes a = (low[k] - margin - (float)from[k]) * lanes_set(inverse);
    const lanes b = (high[k] + margin - (float)from[k]) * lanes_set(inverse);
    enter = lanes_max(enter, lanes_min(a, b));
    leave = lanes_min(leave, lanes_max(a, b));
  }
  return c->there & ~lanes_above(enter, leave + margin);
}

// Lanes whose triangles the ray may cross: see nsvcd__lanes_on_ray.
static uint32_t triangles_on_ray(const lanes3 *corner, const nsvcd__ray *ray, float margin,
                                 float rounding) {
  const lanes3 from = lanes3_set((float)ray->from.x, (float)ray->from.y, (float)ray->from.z);
  const lanes3 way =
      lanes3_set((float)ray->direction.x, (float)ray->direction.y, (float)ray->direction.z);
  lanes least = lanes_set(HUGE_VALF);
  lanes most = -least;
  lanes longest = lanes_set(0);
  for (int k = 0; k < 3; k++) {
    const lanes3 edge = lanes3_cross(lanes3_sub(corner[(k + 1) % 3], corner[k]), way);
    const lanes volume = lanes3_dot(edge, lanes3_sub(corner[k], from));
    least = lanes_min(least, volume);
    most = lanes_max(most, volume);
    longest = lanes_max(longest, lanes3_dot(edge, edge));
  }
  const lanes allowed = margin * lanes_sqrt(longest) + rounding;
  return ~(lanes_above(-allowed, least) & lanes_above(most, allowed));
}

static int leaf_crossings(loop *p, const tree_body *b, const tree_leaf *leaf, const nsvcd__ray *ray,
                          float rounding, int *unclear) {
  leaf_points points;
  lanes3 corner[3];
  int sum = 0;
  const double margin = (double)leaf_error(leaf) + ray->margin;
  leaf_read(b, leaf, &points);
  leaf_corners(leaf, &points, corner);
  p->out.steps++;
  uint32_t left = leaf->closed & triangles_on_ray(corner, ray, (float)(2 * margin), rounding);
  for (; left; left &= left - 1) {
    nsvcd__d3 t[3];
    leaf_triangle(b, leaf, lowest_bit(left), t);
    sum += nsvcd__ray_crosses(ray, t, margin, unclear);
  }
  return sum;
}

static int ray_crossings(loop *p, const tree_body *b, const nsvcd__ray *ray, int *unclear) {
  uint32_t list[8 * LANES];
  uint32_t count = 0;
  int sum = 0;
  const float remote = (float)nsvcd__d3_length(ray->from) + b->reach;
  const float rounding = 2 * NSVCD__ROUNDING * remote;
  list[count++] = b->top;
  while (count && !*unclear) {
    const uint32_t link = list[--count];
    if (link & LEAF_LINK) {
      const tree_leaf *leaf = (const tree_leaf *)body_at(b, link & ~LEAF_LINK);
      sum += leaf_crossings(p, b, leaf, ray, rounding * b->reach, unclear);
      continue;
    }
    const tree_node *node = node_at(b, link);
    const tree_children children = children_of(b, node);
    p->out.steps++;
    for (uint32_t met = boxes_on_ray(&children, ray, rounding); met; met &= met - 1) {
      if (count == 8 * LANES)
        *unclear = 1;
      else
        list[count++] = node->links[lowest_bit(met)];
    }
  }
  return sum;
}

// Is a place within the closed components? -1: nobody knows.
static int encloses(loop *p, const tree_body *b, double rounding, nsvcd__d3 place) {
  static const double directions[8][3] = {{0.5359, 0.6013, 0.5927},   {-0.5741, 0.6229, 0.5314},
                                          {0.6127, -0.5531, 0.5644},  {-0.5477, -0.5923, 0.5909},
                                          {0.6311, 0.5573, -0.5396},  {-0.6053, 0.5297, -0.5941},
                                          {0.5623, -0.6217, -0.5452}, {-0.5849, -0.5407, -0.6047}};
  for (size_t k = 0; k < 3; k++) {
    const double at = nsvcd__d3_axis(place, k);
    if (at < (double)b->low[k] - rounding || at > (double)b->high[k] + rounding)
      return 0;
  }
  const size_t best = (place.x < 0 ? 1u : 0u) + (place.y < 0 ? 2u : 0u) + (place.z < 0 ? 4u : 0u);
  nsvcd__ray ray;
  ray.from = place;
  ray.margin = rounding;
  for (size_t n = 0; n < 8; n++) {
    const double *d = directions[best ^ n];
    int unclear = 0;
    ray.direction = nsvcd__d3_unit(nsvcd__d3_of(d[0], d[1], d[2]), place);
    const int crossings = ray_crossings(p, b, &ray, &unclear);
    if (!unclear)
      return crossings != 0;
  }
  return -1;
}

// Does no triangle of a leaf come within a distance of a place?
static int leaf_is_clear(const tree_body *b, const tree_leaf *leaf, nsvcd__d3 place,
                         float distance) {
  const nsvcd__d3 point[3] = {place, place, place};
  const lanes3 at = lanes3_set((float)place.x, (float)place.y, (float)place.z);
  leaf_points points;
  triangles t;
  leaf_read(b, leaf, &points);
  leaf_corners(leaf, &points, t.corner);
  bound_triangles(&t);
  const lanes3 n = face_normals(t.corner);
  const lanes height = lanes_abs(lanes3_dot(n, lanes3_sub(at, t.corner[0])));
  lanes gap = lanes_max(t.low.x - at.x, at.x - t.high.x);
  gap = lanes_max(gap, lanes_max(t.low.y - at.y, at.y - t.high.y));
  gap = lanes_max(gap, lanes_max(t.low.z - at.z, at.z - t.high.z));
  gap = lanes_max(gap, height);
  uint32_t left = first_lanes(leaf->count) & ~lanes_above(gap, lanes_set(distance));
  for (; left; left &= left - 1) {
    nsvcd__d3 corners[3];
    leaf_triangle(b, leaf, lowest_bit(left), corners);
    const nsvcd__nearest nearest = nsvcd__nearest_of(point, corners);
    if (!(nearest.square > (double)distance * (double)distance))
      return 0;
  }
  return 1;
}

// The same of all of them.
static int is_clear(const tree_body *b, nsvcd__d3 place, float distance) {
  uint32_t list[8 * LANES];
  uint32_t count = 0;
  const lanes3 at = lanes3_set((float)place.x, (float)place.y, (float)place.z);
  list[count++] = b->top;
  while (count) {
    const tree_node *node = node_at(b, list[--count]);
    const tree_children c = children_of(b, node);
    const lanes height = lanes3_dot(c.normal, at);
    lanes gap = lanes_max(c.low.x - at.x, at.x - c.high.x);
    gap = lanes_max(gap, lanes_max(c.low.y - at.y, at.y - c.high.y));
    gap = lanes_max(gap, lanes_max(c.low.z - at.z, at.z - c.high.z));
    gap = lanes_max(gap, lanes_max(c.slab_low - height, height - c.slab_high));
    for (uint32_t met = c.there & ~lanes_above(gap, lanes_set(distance)); met; met &= met - 1) {
      const uint32_t link = node->links[lowest_bit(met)];
      if (link & LEAF_LINK) {
        if (!leaf_is_clear(b, (const tree_leaf *)body_at(b, link & ~LEAF_LINK), place, distance))
          return 0;
      } else if (count == 8 * LANES) {
        return 0;
      } else {
        list[count++] = link;
      }
    }
  }
  return 1;
}

// Of the components of `inner`, posed so in the frame of `outer`.
static int encloses_any(loop *p, const tree_body *inner, const tree_body *outer,
                        const nsvcd__placement *at, double rounding, float quanta, int *certain) {
  const float *seeds = (const float *)body_at(inner, inner->seeds);
  if (outer->open)
    return 0;
  for (uint32_t n = 0; n < inner->seed_count; n++) {
    const nsvcd__d3 seed = nsvcd__place_point(at, nsvcd__d3_row(seeds, n));
    const int within = encloses(p, outer, rounding, seed);
    if (within > 0 && is_clear(outer, seed, quanta))
      *certain = 1;
    if (within != 0)
      return within;
  }
  return 0;
}

// Where a box about `centre` is, posed so, along the axes of the other body: is a part of it within
// [low, high], and all of it? margin: for rounding.
static int box_in_box(const float *matrix, const float *place, const float *from, const float *to,
                      const float *low, const float *high, float margin, int *all) {
  for (int k = 0; k < 3; k++) {
    float at = place[k];
    float by = margin;
    for (int c = 0; c < 3; c++) {
      at += matrix[3 * k + c] * 0.5f * (from[c] + to[c]);
      by += fabsf(matrix[3 * k + c]) * 0.5f * (to[c] - from[c]);
    }
    if (at - by > high[k] || at + by < low[k])
      return 0;
    *all &= at - by >= low[k] && at + by <= high[k];
  }
  return 1;
}

// May a component of one body start within the other at all? 2: it is likely to, if it does not meet
// it, for all of the body's box is in the other's, or it is one of a few.
#define FEW_PARTS 8
static int may_start_within(const motion *m) {
  float matrix[9];
  float place[3];
  float back[9];
  float back_place[3] = {0, 0, 0};
  int a_in_b = 1;
  int b_in_a = 1;
  const float per_square = 1 / (m->scale * m->scale);
  read_knot(&m->knots, 0, matrix, place);
  for (int r = 0; r < 3; r++) {
    for (int c = 0; c < 3; c++)
      back[3 * r + c] = matrix[3 * c + r] * per_square;
    back_place[r] = -dot3(back + 3 * r, place);
  }
  const float lengths = m->lengths + fabsf(place[0]) + fabsf(place[1]) + fabsf(place[2]);
  const float margin = 2 * NSVCD__ROUNDING * lengths;
  const tree_body *a = m->a;
  const tree_body *b = m->b;
  const int meet = box_in_box(matrix, place, a->low, a->high, b->low, b->high, margin, &a_in_b) &&
                   box_in_box(back, back_place, b->low, b->high, a->low, a->high,
                              margin / m->scale, &b_in_a);
  // a number that is none compares with nothing
  if (!meet && lengths < HUGE_VALF)
    return 0;
  const uint32_t parts = a->seed_count + b->seed_count;
  const int some = parts > 2 && parts <= FEW_PARTS;
  return some || (a_in_b && !b->open) || (b_in_a && !a->open) ? 2 : 1;
}

// *certain: the true surfaces too, whatever the loop may find.
static int starts_within(loop *p, int *certain) {
  const double scale = (double)p->m.scale;
  const nsvcd__placement at = true_pose(&p->m, 0, 0);
  const nsvcd__placement back = nsvcd__inverse_placement(&at, scale);
  const double lengths = (double)p->m.lengths + nsvcd__d3_length(at.position);
  const double rounding = NSVCD__SAME_PLACE * lengths;
  const float quanta = 2 * (p->m.scale * p->a->quantum + p->b->quantum) +
                       4 * NSVCD__ROUNDING * (float)lengths;
  *certain = 0;
  const int within = encloses_any(p, p->a, p->b, &at, rounding, quanta, certain);
  if (within)
    return within;
  return encloses_any(p, p->b, p->a, &back, rounding / scale, quanta / (float)scale, certain);
}

// ---- a question

// Are the spheres about the bodies' origins always apart?
static int always_far(const nsvcd__motion *of, const tree_body *a, const tree_body *b,
                      float clearance) {
  const float reach = of->scale * (a->off + a->reach) + b->off + b->reach;
  return nsvcd__motion_gap(of) > 1.00001f * (reach + clearance);
}

// Bytes that a question needs.
static size_t loop_memory(uint32_t knots) {
  return sizeof(loop) + 64 + sizeof(float) * knot_floats(knots);
}

// Answers nsvcd_sweep's plain question. bodies: those of question->a and b.
static int loop_sweep(const nsvcd_question *question, const tree_body *a, const tree_body *b,
                      void *memory, loop_answer *answer) {
  nsvcd__motion of;
  loop *p = (loop *)memory;
  if (nsvcd__mover_check(&question->a) || nsvcd__mover_check(&question->b))
    return 0;
  const int swapped = nsvcd__is_swapped(&question->a, &question->b);
  nsvcd__motion_init(swapped ? &question->b : &question->a, swapped ? &question->a : &question->b,
                     &of);
  p->a = swapped ? b : a;
  p->b = swapped ? a : b;
  p->limit = question->work ? (uint32_t)question->work : NSVCD_DEFAULT_WORK;
  p->clearance = (double)(question->clearance / of.unit);
  p->m.clearance = 1.000001f * (float)p->clearance;
  p->first = question->ask == NSVCD_ASK_FIRST ? (double)question->to_time : 0;
  if (always_far(&of, p->a, p->b, p->m.clearance)) {
    memset(answer, 0, sizeof *answer);
    answer->free_until = 1;
    return 1;
  }
  motion_begin(&p->m, &of, p->a, p->b, (float *)(p + 1), count_knots(&of));
  int certain = 0;
  memset(&p->out, 0, sizeof p->out);
  const int may = may_start_within(&p->m);
  int within = may == 2 ? starts_within(p, &certain) : 0;
  if (certain) {
    p->out.verdict = LOOP_INSIDE;
  } else {
    run_loop(p);
    const int is_later = p->out.verdict == LOOP_HIT && p->out.free_until > 0;
    const int is_open = p->out.verdict != LOOP_HIT || is_later;
    if (may == 1 && is_open)
      within = starts_within(p, &certain);
    // the start is proven free: then it holds for the true surfaces
    const int is_proven = certain || p->out.verdict == LOOP_FREE || p->out.free_until > 0;
    if (within > 0 && is_open && is_proven)
      p->out.verdict = LOOP_INSIDE;
    else if (within && !is_later && is_open)
      p->out.verdict = LOOP_UNDECIDED;
    if (within)
      p->out.free_until = 0;
  }
  if (swapped) {
    const uint32_t t = p->out.triangle_a;
    p->out.triangle_a = p->out.triangle_b;
    p->out.triangle_b = t;
  }
  *answer = p->out;
  return 1;
}

#endif
