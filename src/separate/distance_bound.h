// In: a motion whose segments have been chosen. Out: an upper bound of the least distance, which
// two vertices have at some time: the search for that distance begins with it.
#pragma once
#include "../search/search.h"
#include "witnesses.h"

#ifndef NSVCD_NO_PROOF
// Of the patches with a surface, the one whose centre is nearest to a point of the body's frame. Of
// a large body, one near it: the nearest sphere on each level leads there.
static size_t nsvcd__patch_near(const nsvcd__geometry *f, nsvcd__f3 point) {
  const nsvcd_body *body = f->body;
  size_t from = 0;
  size_t count = body->patches;
  size_t patch = 0;
  float least = HUGE_VALF;
  size_t k = nsvcd__is_large(body) ? nsvcd__level_count(body->padded) : 0;
  if (k > 0) count = nsvcd__level_of(body->padded, k - 1).count;
  while (k-- > 0) {
    const nsvcd__level level = nsvcd__level_of(body->padded, k);
    const nsvcd__spheres all = nsvcd__level_spheres(body, level);
    size_t nearest = from;
    float best = HUGE_VALF;
    for (size_t n = from; n < from + count && n < level.count; n++) {
      const nsvcd__f3 off = nsvcd__f3_sub(nsvcd__centre_of(all, n), point);
      const float distance = nsvcd__f3_norm(off) - all.r[n];
      if (distance >= best) continue;
      best = distance;
      nearest = n;
    }
    from = NSVCD__GROUP * nearest;
    count = NSVCD__GROUP;
  }
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  for (size_t first = from; first < from + count; first += NSVCD__LANES) {
    float squares[NSVCD__LANES];
    uint32_t nearer = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 off =
          nsvcd__v3_sub(nsvcd__v3_centres(patches, first + l), nsvcd__v3_set(point));
      const nsvcd__v square = nsvcd__v3_dot(off, off);
      nearer |= nsvcd__v_lt(square, nsvcd__v_set(least)) << l;
      nsvcd__v_store(squares + l, square);
    }
    for (; nearer; nearer &= nearer - 1) {
      const size_t l = nsvcd__low_bit(nearer);
      const size_t n = first + l;
      if (n >= body->patches || f->hull_counts[n] == 0 || squares[l] >= least) continue;
      least = squares[l];
      patch = n;
    }
  }
  return patch;
}

// When the sphere whose chords are q->group comes nearest to a fixed one, in ticks. Returns 0
// if that is no nearer than *gap, metres; else *gap becomes how near.
static int nsvcd__nearest_tick(const nsvcd__search *q, nsvcd__sphere fixed, float *gap,
                               double *tick) {
  int found = 0;
  for (size_t b = 0; NSVCD__LANES * b < q->segments; b++) {
    const nsvcd__chords *c = &q->group[b];
    float gaps[NSVCD__LANES], fraction[NSVCD__LANES];
    uint32_t nearer = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 travel = nsvcd__chords_travel(c, l);
      const nsvcd__v3 d =
          nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(fixed.centre));
      const nsvcd__v tau = nsvcd__nearest_at(d, travel, nsvcd__v_load(c->inverse + l));
      const nsvcd__v3 off = nsvcd__v3_fma(tau, travel, d);
      const nsvcd__v radius = nsvcd__v_load(c->radius + l);
      const nsvcd__v between = nsvcd__v_sub(nsvcd__v3_norm(off), radius);
      nearer |= nsvcd__v_lt(between, nsvcd__v_set(*gap + fixed.radius)) << l;
      nsvcd__v_store(gaps + l, between);
      nsvcd__v_store(fraction + l, tau);
    }
    for (; nearer; nearer &= nearer - 1) {
      const size_t l = nsvcd__low_bit(nearer);
      const size_t s = NSVCD__LANES * b + l;
      if (s >= q->segments || !(gaps[l] - fixed.radius < *gap)) continue;
      *gap = gaps[l] - fixed.radius;
      *tick = (double)q->begin[s];
      *tick += (double)fraction[l] * ((double)q->begin[s + 1] - *tick);
      found = 1;
    }
  }
  return found;
}

// The two groups that come nearest to each other; of large bodies, the bodies' own spheres.
static void nsvcd__nearest_groups(const nsvcd__proof *p, nsvcd__search *q,
                                  nsvcd__sphere *moving, nsvcd__sphere *fixed) {
  const nsvcd_body *a = p->moving.body;
  const nsvcd_body *b = p->fixed.body;
  float gap = HUGE_VALF;
  double tick;
  *moving = nsvcd__body_sphere(a);
  *fixed = nsvcd__body_sphere(b);
  for (size_t g = 0; g < nsvcd__body_groups(a) && !nsvcd__is_tiled(a, b); g++) {
    const nsvcd__sphere own = nsvcd__sphere_of(nsvcd__groups_of(a), g);
    nsvcd__chords_in_all(q, own);
    for (size_t h = 0; h < nsvcd__body_groups(b); h++) {
      const nsvcd__sphere other = nsvcd__sphere_of(nsvcd__groups_of(b), h);
      if (!nsvcd__nearest_tick(q, other, &gap, &tick)) continue;
      *moving = own;
      *fixed = other;
    }
  }
}

// The least distance between hull vertices of moving patch i and fixed patch j.
static double nsvcd__vertex_distance(const nsvcd__proof *p, const nsvcd__transform *pose,
                                     size_t i, size_t j) {
  float lanes[3][NSVCD__LANES];
  float least = HUGE_VALF;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 moving = nsvcd__hull_of(&p->moving, i, l);
    nsvcd__v3_store(lanes, l, nsvcd__v3_transform(pose, moving));
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 fixed = nsvcd__hull_of(&p->fixed, j, l);
    for (size_t n = 0; n < NSVCD__LANES; n++) {
      const nsvcd__v3 d = nsvcd__v3_sub(fixed, nsvcd__v3_set(nsvcd__lane_of(lanes, n)));
      least = nsvcd__least_of(least, nsvcd__v3_dot(d, d));
    }
  }
  return sqrt((double)least);
}

// An upper bound of the least distance, from which its search begins: a distance that vertices of
// two patches have, and a little more. The patches, and the time when they are nearest, are found
// in turns. If the bound is within the clearance, triangles of these patches are a contact, which
// is sought there.
static NSVCD__NOINLINE double nsvcd__bound_distance(nsvcd__solver *w, nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  nsvcd__sphere moving, fixed;
  double tick = 0;
  double least = HUGE_VAL;
  double fraction = 0;
  uint32_t from = 0;
  size_t nearest[2] = {0, 0};
  // Bodies that never come near have been told apart without segments.
  nsvcd__cut_segments(p->arcs.motion, p->given.lengths, 0, q);
  nsvcd__nearest_groups(p, q, &moving, &fixed);
  for (size_t turn = 0; turn < NSVCD__TURNS; turn++) {
    float gap = HUGE_VALF;
    double u;
    nsvcd__chords_in_all(q, moving);
    (void)nsvcd__nearest_tick(q, fixed, &gap, &tick);
    const uint32_t first = nsvcd__arc_of(p->arcs.motion, tick, &u);
    const nsvcd__dtransform at = nsvcd__dtransform_at(nsvcd__arc_at(&p->arcs, first), u);
    const nsvcd__transform pose = nsvcd__transform_of(&at);
    const nsvcd__dtransform back = nsvcd__inverse_dtransform(&at, p->arcs.arc.scale);
    size_t i = 0;
    size_t j = 0;
    for (size_t round = 0; round < 2; round++) {
      const nsvcd__d3 seen = nsvcd__d3_transform(&back, nsvcd__d3_widen(fixed.centre));
      i = nsvcd__patch_near(&p->moving, nsvcd__f3_round(seen));
      moving = nsvcd__sphere_of(nsvcd__body_patches(p->moving.body), i);
      j = nsvcd__patch_near(&p->fixed, nsvcd__f3_transform(&pose, moving.centre));
      fixed = nsvcd__sphere_of(nsvcd__body_patches(p->fixed.body), j);
    }
    const float lengths = p->given.lengths + nsvcd__f3_norm(pose.position);
    const double rounding =
        (double)(4 * NSVCD__ROUNDING * lengths + 2 * nsvcd__errors_of(p, i, j));
    const double apart = 1.0001 * nsvcd__vertex_distance(p, &pose, i, j) + rounding;
    if (!(apart < least)) continue;
    least = apart;
    fraction = u;
    from = first;
    nearest[0] = i;
    nearest[1] = j;
  }
  p->known.has_contact = 0;
  if (!(least <= p->given.clearance)) return least;
  p->goal.clearance = least;
  p->goal.limit = p->work + NSVCD__END_BUDGET;
  (void)nsvcd__find_witness(w, nearest[0], nearest[1], from, fraction);
  return p->known.has_contact ? p->known.found.distance : least;
}
#endif  // NSVCD_NO_PROOF
