// In: a moving body of one group, and a motion that has been cut into few segments. Out: the same
// as the loop's: the patch pairs of each segment, in the order in which the body comes to them.
//
// Most casts are of this kind: rays, spheres, capsules, boxes. The tree of the fixed body is
// descended, 16 spheres at a time, along the chord of the group's sphere. What it comes to first is
// searched first, so that what lies behind a contact is not searched at all: a sphere of radius r
// that travels by v is nearest to another at the fraction f of its chord, and does not meet it
// before f - (r + r') / |v|.
#pragma once
#include "patch_pairs.h"
#include "slabs.h"

#ifndef NSVCD_NO_PROOF
// Segments from .. to - 1, as bits.
static uint64_t nsvcd__segments_in(size_t from, size_t to) {
  const uint64_t before_end = to < 64 ? ((uint64_t)1 << to) - 1 : ~(uint64_t)0;
  return before_end & ~(((uint64_t)1 << from) - 1);
}

// The segments being searched that still matter.
static uint64_t nsvcd__segments_that_matter(const nsvcd__proof *p, const nsvcd__search *q) {
  size_t s = q->segments;
  if (!(p->goal.first > 0) || !p->known.has_contact) return q->wanted;
  while (s > 0 && !nsvcd__matters(p, q, s - 1)) s--;
  return q->wanted & nsvcd__segments_in(0, s);
}

// Adds the patch pairs of moving group g and fixed patch j in the segments *left, and clears
// these, as long as there is room for 16 more.
static void nsvcd__add_patch_pairs(nsvcd__solver *w, const nsvcd__search *q, size_t g,
                                   size_t j, uint64_t *left) {
  nsvcd__proof *p = &w->p;
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const nsvcd__f3 centre = nsvcd__patch_centre(&p->fixed, j);
  const float radius = nsvcd__body_r(fixed)[j];
  const float *own = nsvcd__body_r(moving) + NSVCD__GROUP * g;
  *left &= nsvcd__segments_that_matter(p, q);
  for (; *left && w->fresh_count + NSVCD__GROUP <= NSVCD__FRESH; *left &= *left - 1) {
    const size_t s = nsvcd__low_bit(*left);
    const nsvcd__chords *c = &q->members[s];
    float squares[NSVCD__LANES];
    float fraction[NSVCD__LANES];
    uint32_t met = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 travel = nsvcd__chords_travel(c, l);
      const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
      const nsvcd__v tau = nsvcd__nearest_at(d, travel, nsvcd__v_load(c->inverse + l));
      const nsvcd__v3 closest = nsvcd__v3_fma(tau, travel, d);
      const nsvcd__v square = nsvcd__v3_dot(closest, closest);
      const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(c->radius + l), radius);
      met |= nsvcd__v_le(square, nsvcd__v_signed_square(sum)) << l;
      nsvcd__v_store(squares + l, square);
      nsvcd__v_store(fraction + l, tau);
    }
    if (!met) continue;
    met = nsvcd__slabs_meet(p, nsvcd__segment_interval(w, q, s), q, g, j, s, met);
    for (; met; met &= met - 1) {
      const size_t l = nsvcd__low_bit(met);
      const size_t i = NSVCD__GROUP * g + l;
      if (p->moving.hull_counts[i] == 0) continue;
      const float radii = q->scale * own[l] + radius;
      const float depth = 1 - sqrtf(squares[l]) / (radii > 1e-30f ? radii : 1e-30f);
      const nsvcd__patch_pair pair = {(uint16_t)i, (uint16_t)j, (uint16_t)s,
                                      0,           depth,       fraction[l]};
      w->fresh[w->fresh_count++] = pair;
    }
  }
}

// Processes the patch pairs that the search has found since.
static nsvcd__outcome nsvcd__take_patch_pairs(nsvcd__solver *w, nsvcd__search *q) {
  return w->p.goal.collects ? nsvcd__collect_contacts(w, q) : nsvcd__sift_patch_pairs(w, q);
}

// 16 neighbouring spheres of the fixed body: those that are left, as bits, and from which fraction
// of the chord on the moving group may meet each. The chord begins and ends at these ticks.
typedef struct nsvcd__front {
  size_t first;
  uint32_t left;
  double start, length;
  nsvcd__row from;
  // how near the centres come, squared, and at which fraction
  nsvcd__row square, fraction;
} nsvcd__front;

// The way in segment s.
static void nsvcd__way_set(nsvcd__solver *w, nsvcd__search *q, size_t s, nsvcd__way *out) {
  const nsvcd__proof *p = &w->p;
  const nsvcd_body *moving = p->moving.body;
  const nsvcd__slab own =
      nsvcd__slab_at(p->moving.group_slabs, nsvcd__group_slots(moving->padded), 0);
  const size_t lane = s % NSVCD__LANES;
  nsvcd__v_approach *a = &out->slabs;
  nsvcd__chords *c = &q->group[s / NSVCD__LANES];
  nsvcd__chords_of_group(q, 0);
  const nsvcd__interval *over = nsvcd__segment_interval(w, q, s);
  const nsvcd__mat3 *from = &over->start.rotation;
  const nsvcd__mat3 *to = &over->end.rotation;
  // rotations in an interval are times the scale
  const float half = 0.5f * p->arcs.motion->per_scale;
  const nsvcd__mat3 middle = nsvcd__mat3_mix(half, to, 1, from);
  const nsvcd__mat3 half_turn = nsvcd__mat3_mix(half, to, -1, from);
  out->segment = s;
  out->start = (double)q->begin[s];
  out->length = nsvcd__min((double)q->begin[s + 1], w->clipped_end) - out->start;
  out->from = nsvcd__lane_of(c->start, lane);
  out->travel = nsvcd__lane_of(c->travel, lane);
  out->inverse = c->inverse[lane];
  out->radius = c->radius[lane];
  out->at_start = nsvcd__vmat3_set(from);
  out->at_end = nsvcd__vmat3_set(to);
  a->moving = nsvcd__v_slab_set(&own);
  a->may_bend = nsvcd__may_bend(over);
  a->scale = nsvcd__v_set(q->scale);
  a->over = nsvcd__v_interval_set(over);
  a->clearance = nsvcd__clearance(&p->goal);
  a->radius = nsvcd__group_extent(moving, 0);
  a->chord = nsvcd__v3_set(out->travel);
  a->mean = nsvcd__v3_set(nsvcd__mat3_apply(&middle, own.normal));
  a->turned = nsvcd__v3_set(nsvcd__mat3_apply(&half_turn, own.normal));
}

// Fills a front with the 16 spheres from `first` on: patches if `level` is 0, else those of the
// level below that number.
static NSVCD__NOINLINE void nsvcd__front_fill(nsvcd__solver *w, nsvcd__way *way, size_t level,
                                              size_t first, nsvcd__front *out) {
  const nsvcd_body *fixed = w->p.fixed.body;
  const nsvcd__spheres all =
      level > 0 ? nsvcd__level_spheres(fixed, nsvcd__level_of(fixed->padded, level - 1))
                : nsvcd__body_patches(fixed);
  const nsvcd__spheres spheres = nsvcd__spheres_from(all, first);
  const nsvcd__v3 start = nsvcd__v3_set(way->from);
  const nsvcd__v3 travel = nsvcd__v3_set(way->travel);
  const nsvcd__v per_length = nsvcd__v_set(sqrtf(-way->inverse));
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(start, nsvcd__v3_centres(spheres, l));
    const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(spheres.r + l), way->radius);
    const nsvcd__v nearest =
        nsvcd__v_mul(nsvcd__v3_dot(d, travel), nsvcd__v_set(way->inverse));
    const nsvcd__v tau = nsvcd__v_clamp(nearest, 0, 1);
    const nsvcd__v3 off = nsvcd__v3_fma(tau, travel, d);
    const nsvcd__v square = nsvcd__v3_dot(off, off);
    met |= nsvcd__v_le(square, nsvcd__v_signed_square(sum)) << l;
    nsvcd__v_store(out->from + l, nsvcd__v_sub(nearest, nsvcd__v_mul(sum, per_length)));
    nsvcd__v_store(out->square + l, square);
    nsvcd__v_store(out->fraction + l, tau);
  }
  out->first = first;
  out->start = way->start;
  out->length = way->length;
  out->left = level < 2 ? nsvcd__slabs_on_way(w, way, spheres, level, first, met) : met;
}

// Takes the sphere that is met first off a front, and returns its lane; LANES: none is left, or all
// after what matters.
static size_t nsvcd__front_next(const nsvcd__proof *p, nsvcd__front *front) {
  if (!front->left) return NSVCD__LANES;
  size_t first = nsvcd__low_bit(front->left);
  for (uint32_t left = front->left & (front->left - 1); left; left &= left - 1) {
    const size_t l = nsvcd__low_bit(left);
    if (front->from[l] < front->from[first]) first = l;
  }
  const double tick = front->start + (double)front->from[first] * front->length;
  const int matters = !(tick >= p->known.end);
  front->left &= matters ? ~((uint32_t)1 << first) : 0;
  return matters ? first : NSVCD__LANES;
}

// Adds the patch pairs of the moving group and the patches of a front, and takes them.
static nsvcd__outcome nsvcd__front_take(nsvcd__solver *w, nsvcd__search *q,
                                        const nsvcd__way *way, nsvcd__front *patches) {
  nsvcd__proof *p = &w->p;
  const size_t s = way->segment;
  for (uint32_t met = patches->left; met; met &= met - 1) {
    const size_t l = nsvcd__low_bit(met);
    const size_t j = patches->first + l;
    uint64_t left = (uint64_t)1 << s;
    if (p->fixed.hull_counts[j] == 0) continue;
    if (p->moving.body->patches == 1) {
      const float radii = way->radius + nsvcd__body_r(p->fixed.body)[j];
      const float depth = 1 - sqrtf(patches->square[l]) / (radii > 1e-30f ? radii : 1e-30f);
      const nsvcd__patch_pair pair = {0, (uint16_t)j, (uint16_t)s,
                                      0, depth,       patches->fraction[l]};
      w->fresh[w->fresh_count++] = pair;
      continue;
    }
    while (left) {
      nsvcd__pose_members(q, 0, left);
      nsvcd__add_patch_pairs(w, q, 0, j, &left);
      if (!left) break;
      const nsvcd__outcome outcome = nsvcd__take_patch_pairs(w, q);
      if (outcome != NSVCD__DONE) return outcome;
    }
  }
  return w->fresh_count > 0 ? nsvcd__take_patch_pairs(w, q) : NSVCD__DONE;
}

// As nsvcd__prove_segments, of one segment.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__prove_in_order(nsvcd__solver *w, nsvcd__search *q,
                                                            size_t s) {
  nsvcd__proof *p = &w->p;
  nsvcd__front fronts[NSVCD__LEVELS + 1];
  nsvcd__way way;
  const size_t padded = p->fixed.body->padded;
  const size_t top = nsvcd__level_count(padded);
  const size_t slots = nsvcd__level_of(padded, top - 1).slots;
  nsvcd__way_set(w, q, s, &way);
  for (size_t first = 0; first < slots; first += NSVCD__GROUP) {
    size_t level = top;
    nsvcd__front_fill(w, &way, level, first, &fronts[level]);
    for (;;) {
      const size_t l =
          nsvcd__matters(p, q, s) ? nsvcd__front_next(p, &fronts[level]) : NSVCD__LANES;
      if (l == NSVCD__LANES) {
        if (level == top) break;
        level++;
        continue;
      }
      const size_t next = NSVCD__GROUP * (fronts[level].first + l);
      nsvcd__front_fill(w, &way, level - 1, next, &fronts[level - 1]);
      if (level > 1) {
        level--;
        continue;
      }
      const double end = p->known.end;
      const nsvcd__outcome outcome = nsvcd__front_take(w, q, &way, &fronts[0]);
      if (outcome != NSVCD__DONE) return outcome;
      if (!(p->known.end < end)) continue;
      nsvcd__clip_segment(w, q);
      nsvcd__way_set(w, q, s, &way);
    }
  }
  return nsvcd__resolve_patch_pairs(w, q);
}

// As nsvcd__prove_tiles.
static nsvcd__outcome nsvcd__prove_all_in_order(nsvcd__solver *w, nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  q->moving = p->moving.body;
  q->fixed = p->fixed.body;
  q->ready = 0;
  for (size_t s = 0; s < q->segments && nsvcd__matters(p, q, s); s++) {
    q->wanted = (uint64_t)1 << s;
    const nsvcd__outcome outcome = nsvcd__prove_in_order(w, q, s);
    if (outcome != NSVCD__DONE) return outcome;
    if (!p->known.has_contact) p->known.proven_until = (double)q->begin[s + 1];
  }
  return NSVCD__DONE;
}
#endif  // NSVCD_NO_PROOF
