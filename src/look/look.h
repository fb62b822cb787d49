// In: two bodies in 16 places. Out: the places in which they seem to meet.
//
// All is computed in the frame of b, and in its lengths: a's balls are moved there, 16 places at a
// time, while b's stay as they are stored. Balls are kept in clusters of 16. A cluster of a goes
// down the levels of b's spheres; where it meets a cluster, its balls are tried against that
// cluster's, and, where these are patches, against their slabs.
#pragma once
#include "../body/covering.h"
#include "../interface/looks.h"
#include "../lanes/turns.h"

#ifndef NSVCD_NO_PROOF
#define NSVCD__ALL_LOOKS 0xffffu

// A body as balls, in clusters of 16, with levels of spheres over 16 clusters each, and so on.
typedef struct nsvcd__ball_tree {
  // balls, clusters, ...
  nsvcd__spheres levels[1 + NSVCD__LEVELS];
  // how many there are of each, and levels in use
  size_t counts[1 + NSVCD__LEVELS], level_count;
  // over all, `round` included
  nsvcd__sphere whole;
  // metres, to be added to each radius
  float more;
  // of the patches that the balls are, (6, stride); NULL: balls of a cover
  const float *slabs;
  size_t stride;
  // 1: a box along the axes, and metres that it goes beyond that
  int is_box;
  nsvcd__f3 middle, half;
  float round;
} nsvcd__ball_tree;

static nsvcd__ball_tree nsvcd__ball_tree_of(const nsvcd_body *body) {
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  const nsvcd__covering f = nsvcd__covering_of(triangles);
  nsvcd__ball_tree out;
  memset(&out, 0, sizeof out);
  out.whole = nsvcd__body_sphere(triangles);
  out.is_box = (int)f.counts->is_box;
  out.round = f.counts->convex_radius;
  out.whole.radius += out.round;
  const nsvcd__f3 low = nsvcd__f3_load(f.box);
  const nsvcd__f3 high = nsvcd__f3_load(f.box + 3);
  out.middle = nsvcd__f3_scale(nsvcd__f3_add(low, high), 0.5f);
  out.half = nsvcd__f3_scale(nsvcd__f3_sub(high, low), 0.5f);
  if (f.counts->balls > 0) {
    out.levels[0] = f.balls;
    out.levels[1] = f.clusters;
    out.counts[0] = f.counts->balls;
    out.counts[1] = (f.counts->balls + NSVCD__GROUP - 1) / NSVCD__GROUP;
    out.level_count = 2;
    return out;
  }
  out.more = out.round;
  out.levels[0] = nsvcd__body_patches(triangles);
  out.counts[0] = triangles->patches;
  out.slabs = f.slabs;
  out.stride = triangles->padded;
  out.level_count = 1 + nsvcd__level_count(triangles->padded);
  for (size_t k = 1; k < out.level_count; k++) {
    const nsvcd__level level = nsvcd__level_of(triangles->padded, k - 1);
    out.levels[k] = nsvcd__level_spheres(triangles, level);
    out.counts[k] = level.count;
  }
  return out;
}

// Points in 16 places: (3, 16) each.
typedef struct nsvcd__look_point {
  nsvcd__row at[3];
} nsvcd__look_point;

typedef struct nsvcd__look_state {
  nsvcd__ball_tree a, b;
  // from a's frame to b's: matrices times a's scale over b's, (9, 16); positions, (3, 16)
  nsvcd__row turn[9], position[3];
  // of a over that of b
  float scale;
  // (16): metres of b's, to be added to sums of radii: the margin, and roundings
  nsvcd__row room;
  // places, a bit for each
  uint32_t met;
  int any;
  // balls of the cluster of a that is at hand, (16), once they are placed
  nsvcd__look_point balls[NSVCD__GROUP];
  uint32_t placed;
} nsvcd__look_state;

// Is there nothing left to find?
static int nsvcd__look_ends(const nsvcd__look_state *s) {
  return s->any ? s->met != 0 : s->met == NSVCD__ALL_LOOKS;
}

// A point of a's frame in b's.
static void nsvcd__look_place(nsvcd__look_state *s, nsvcd__f3 point, nsvcd__look_point *out) {
  const nsvcd__v3 p = nsvcd__v3_set(point);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__vmat3 turn = nsvcd__vmat3_load(s->turn, l);
    const nsvcd__v3 at = nsvcd__v3_load(s->position, l);
    nsvcd__v3_store(out->at, l, nsvcd__vmat3_apply_add(turn, p, at));
  }
}

// In which places is a point within `reach`, and the room, of a sphere of b's?
static uint32_t nsvcd__look_at_sphere(const nsvcd__look_state *s, nsvcd__look_point *point,
                                      float reach, nsvcd__f3 centre) {
  const nsvcd__v3 c = nsvcd__v3_set(centre);
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 offset = nsvcd__v3_sub(nsvcd__v3_load(point->at, l), c);
    const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(s->room + l), reach);
    met |= nsvcd__v_le(nsvcd__v3_dot(offset, offset), nsvcd__v_signed_square(sum)) << l;
  }
  return met;
}

// The same of b's box.
static uint32_t nsvcd__look_at_box(const nsvcd__look_state *s, nsvcd__look_point *point,
                                   float reach) {
  const nsvcd__v3 middle = nsvcd__v3_set(s->b.middle);
  const nsvcd__v3 half = nsvcd__v3_set(s->b.half);
  const nsvcd__v3 zero = nsvcd__v3_set(nsvcd__f3_of(0, 0, 0));
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 offset = nsvcd__v3_sub(nsvcd__v3_load(point->at, l), middle);
    const nsvcd__v3 size = nsvcd__v3_max(offset, nsvcd__v3_negate(offset));
    const nsvcd__v3 beyond = nsvcd__v3_max(nsvcd__v3_sub(size, half), zero);
    const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(s->room + l), reach + s->b.round);
    met |= nsvcd__v_le(nsvcd__v3_dot(beyond, beyond), nsvcd__v_signed_square(sum)) << l;
  }
  return met;
}

// The same of what the slab of a patch of b's leaves: a cylinder.
static uint32_t nsvcd__look_at_slab(const nsvcd__look_state *s, nsvcd__look_point *point,
                                    float reach, size_t patch) {
  const nsvcd__slab slab = nsvcd__slab_at(s->b.slabs, s->b.stride, patch);
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__centre_of(s->b.levels[0], patch));
  const nsvcd__v3 normal = nsvcd__v3_set(slab.normal);
  const nsvcd__v zero = nsvcd__v_set(0);
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 offset = nsvcd__v3_sub(nsvcd__v3_load(point->at, l), centre);
    const nsvcd__v height = nsvcd__v3_dot(offset, normal);
    const nsvcd__v over = nsvcd__v_plus(height, -slab.high);
    const nsvcd__v under = nsvcd__v_sub(nsvcd__v_set(slab.low), height);
    const nsvcd__v along = nsvcd__v_max(nsvcd__v_max(over, under), zero);
    const nsvcd__v3 flat = nsvcd__v3_fma(nsvcd__v_negate(height), normal, offset);
    const nsvcd__v across =
        nsvcd__v_max(nsvcd__v_plus(nsvcd__v3_norm(flat), -slab.across), zero);
    const nsvcd__v square = nsvcd__v_fma(along, along, nsvcd__v_mul(across, across));
    const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(s->room + l), reach + s->b.more);
    met |= nsvcd__v_le(square, nsvcd__v_signed_square(sum)) << l;
  }
  return met;
}

// Ball i of a, placed, if it is not yet. Returns its radius.
static float nsvcd__look_ball(nsvcd__look_state *s, size_t i, nsvcd__look_point **out) {
  const size_t n = i % NSVCD__GROUP;
  *out = &s->balls[n];
  if (!(s->placed >> n & 1)) nsvcd__look_place(s, nsvcd__centre_of(s->a.levels[0], i), *out);
  s->placed |= (uint32_t)1 << n;
  return s->scale * (s->a.levels[0].r[i] + s->a.more);
}

// A cluster of a, point and radius, that meets a cluster of b in the places `open`.
static void nsvcd__look_into(nsvcd__look_state *s, size_t of_a, size_t of_b,
                             nsvcd__look_point *point, float radius, uint32_t open) {
  const nsvcd__spheres balls = s->b.levels[0];
  const nsvcd__sphere over = nsvcd__sphere_of(s->b.levels[1], of_b);
  const size_t first = NSVCD__GROUP * of_b;
  const size_t count = nsvcd__group_members(s->b.counts[0], first);
  // balls of b that the cluster meets
  uint32_t near_places[NSVCD__GROUP];
  for (size_t n = 0; n < count; n++) {
    const float reach = radius + balls.r[first + n] + s->b.more;
    const nsvcd__f3 centre = nsvcd__centre_of(balls, first + n);
    near_places[n] = open & nsvcd__look_at_sphere(s, point, reach, centre);
  }
  const size_t begin = NSVCD__GROUP * of_a;
  const size_t end = begin + nsvcd__group_members(s->a.counts[0], begin);
  for (size_t i = begin; i < end; i++) {
    nsvcd__look_point *ball;
    const float own = nsvcd__look_ball(s, i, &ball);
    const float to_all = own + over.radius + s->b.more;
    const uint32_t left = open & ~s->met;
    if (!(left & nsvcd__look_at_sphere(s, ball, to_all, over.centre))) continue;
    for (size_t n = 0; n < count; n++) {
      if (!(near_places[n] & ~s->met)) continue;
      const float reach = own + balls.r[first + n] + s->b.more;
      const nsvcd__f3 centre = nsvcd__centre_of(balls, first + n);
      uint32_t met = near_places[n] & nsvcd__look_at_sphere(s, ball, reach, centre);
      if (met && s->b.slabs) met &= nsvcd__look_at_slab(s, ball, own, first + n);
      s->met |= met;
      if (nsvcd__look_ends(s)) return;
    }
  }
}

// A cluster of a goes down b's levels: sphere n of level k.
static void nsvcd__look_down(nsvcd__look_state *s, size_t of_a, nsvcd__look_point *point,
                             float radius, size_t k, size_t n, uint32_t open) {
  const nsvcd__sphere sphere = nsvcd__sphere_of(s->b.levels[k], n);
  open &= ~s->met;
  open &= nsvcd__look_at_sphere(s, point, radius + sphere.radius + s->b.more, sphere.centre);
  if (!open) return;
  if (k == 1) {
    nsvcd__look_into(s, of_a, n, point, radius, open);
    return;
  }
  const size_t first = NSVCD__GROUP * n;
  const size_t count = nsvcd__group_members(s->b.counts[k - 1], first);
  for (size_t i = 0; i < count && !nsvcd__look_ends(s); i++)
    nsvcd__look_down(s, of_a, point, radius, k - 1, first + i, open);
}

// A cluster of a, against b's box.
static void nsvcd__look_into_box(nsvcd__look_state *s, size_t of_a) {
  const size_t begin = NSVCD__GROUP * of_a;
  const size_t end = begin + nsvcd__group_members(s->a.counts[0], begin);
  for (size_t i = begin; i < end && !nsvcd__look_ends(s); i++) {
    nsvcd__look_point *ball;
    const float own = nsvcd__look_ball(s, i, &ball);
    s->met |= nsvcd__look_at_box(s, ball, own);
  }
}

// Fills in how a is seen from b. room: metres, besides roundings.
static void nsvcd__look_relate(nsvcd__look_state *s, const nsvcd_places *a,
                               const nsvcd_places *b, float scale_b, float room) {
  const float unit = 1 / scale_b;
  const nsvcd__sphere *whole = &s->a.whole;
  const float extent_a = s->scale * (nsvcd__f3_norm(whole->centre) + whole->radius);
  const float extent = extent_a + nsvcd__f3_norm(s->b.whole.centre) + s->b.whole.radius;
  NSVCD__EACH_SLICE(l) {
    nsvcd__v3 from[3], to[3];
    for (size_t k = 0; k < 3; k++) {
      // columns of b's matrices are its axes
      from[k] = nsvcd__v3_get(a->rotation[k] + l, 3 * NSVCD__LANES);
      to[k] = nsvcd__v3_get(b->rotation[k] + l, 3 * NSVCD__LANES);
    }
    const nsvcd__v3 offset =
        nsvcd__v3_sub(nsvcd__v3_rows(a->position[0] + l), nsvcd__v3_rows(b->position[0] + l));
    for (size_t i = 0; i < 3; i++) {
      for (size_t k = 0; k < 3; k++)
        nsvcd__v_store(s->turn[3 * i + k] + l,
                       nsvcd__v_scale(nsvcd__v3_dot(to[i], from[k]), s->scale));
      nsvcd__v_store(s->position[i] + l, nsvcd__v_scale(nsvcd__v3_dot(to[i], offset), unit));
    }
    const nsvcd__v far_off = nsvcd__v_scale(nsvcd__v3_norm(offset), 1e-6f * unit);
    nsvcd__v_store(s->room + l, nsvcd__v_plus(far_off, 1e-6f * extent + room * unit));
  }
}

// Which of two bodies should stay as it is stored: a box, of two the one without balls; else the
// one of more patches; else one of balls.
static size_t nsvcd__look_rank(const nsvcd__ball_tree *tree) {
  if (tree->is_box) return tree->slabs ? SIZE_MAX : SIZE_MAX - 1;
  return tree->slabs ? tree->counts[0] : 0;
}

// nsvcd_look of two bodies in order.
static uint32_t nsvcd__look_all(const nsvcd_looked *a, const nsvcd_looked *b, float margin,
                                int any) {
  nsvcd__look_state s;
  s.a = nsvcd__ball_tree_of(a->body);
  s.b = nsvcd__ball_tree_of(b->body);
  if (nsvcd__look_rank(&s.a) > nsvcd__look_rank(&s.b)) {
    const nsvcd__ball_tree tree = s.a;
    const nsvcd_looked *other = a;
    s.a = s.b;
    s.b = tree;
    a = b;
    b = other;
  }
  const float scale_b = b->scale > 0 ? b->scale : 1;
  s.scale = (a->scale > 0 ? a->scale : 1) / scale_b;
  s.met = 0;
  s.any = any;
  nsvcd__look_relate(&s, a->places, b->places, scale_b, margin);
  nsvcd__look_point point;
  const float whole = s.scale * s.a.whole.radius;
  nsvcd__look_place(&s, s.a.whole.centre, &point);
  uint32_t open =
      nsvcd__look_at_sphere(&s, &point, whole + s.b.whole.radius, s.b.whole.centre);
  if (open && s.b.is_box) open = nsvcd__look_at_box(&s, &point, whole);
  if (!open) return 0;
  for (size_t n = 0; n < s.a.counts[1] && !nsvcd__look_ends(&s); n++) {
    const nsvcd__sphere sphere = nsvcd__sphere_of(s.a.levels[1], n);
    const float radius = s.scale * (sphere.radius + s.a.more);
    nsvcd__look_place(&s, sphere.centre, &point);
    s.placed = 0;
    if (s.b.is_box) {
      if (nsvcd__look_at_box(&s, &point, radius) & open & ~s.met) nsvcd__look_into_box(&s, n);
      continue;
    }
    const float to_all = radius + s.b.whole.radius;
    if (!(open & ~s.met & nsvcd__look_at_sphere(&s, &point, to_all, s.b.whole.centre)))
      continue;
    const size_t top = s.b.level_count - 1;
    for (size_t i = 0; i < s.b.counts[top] && !nsvcd__look_ends(&s); i++)
      nsvcd__look_down(&s, n, &point, radius, top, i, open);
  }
  return s.met;
}
#endif
