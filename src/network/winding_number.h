// In: two bodies and a pose. Out: is one inside the other?
//
// A body wholly inside another never crosses its surface, so surfaces cannot tell. The winding
// number of a closed surface can (Jacobson et al. 2013), and far from the surface each patch is as
// good as a dipole of its area vector (Barill et al. 2018):
//   w(x) = sum_i A_i . (p_i - x) / (4 pi |p_i - x|^3)     1 inside, 0 outside
// Differences from Barill et al.: a dipole is at the centre of its ball or sphere, not at the
// centroid of the area, and nothing is of second order.
//
// Near the surface w is wrong: for a flat disc seen from its covering radius it is 0.25 instead of
// 0.146, from half of that 1.0 instead of 0.28. So NSVCD__PROBES patch centres of the inner body
// are candidates, and w is taken at the one that is farthest from the outer patches, in units of
// their radii; as bodies may be of several parts, also at others that are far from it, up to
// NSVCD__INSIDE_SAMPLES in all. None may be nearer than NSVCD__FAR_ENOUGH, or NSVCD__FAR_INSIDE on
// the inner side of a flat patch. If all are on the inner side of the nearest patch, as those of a
// chip in a table top are, they are inside.
//
// Measured at a million points about spheres of 32 to 512 patches, the worst error of w is 0.55
// from 0.75 radii on, 0.52 from 1, and 0.06 from 1.5; from 1 on, fewer than 1 in 1,000 exceed 0.3.
// In bodies of more than a tile's patches the area vectors of groups, and of spheres above them,
// are summed, and the sum stands for the members of a sphere that is farther than NSVCD__DIPOLE of
// its radii: w is then within 0.05 of the sum over all patches (tests/test_level.c).
//
// Cost: at most NSVCD__PROBES * N distances for each of the two bodies, if centres of one are in
// the other's sphere and a ray out of it is blocked; of large bodies only those to groups nearby.
#pragma once
#include "../segments/segments.h"

#ifndef NSVCD_NO_NETWORK
#define NSVCD__PROBES NSVCD__LANES  // patch centres of the inner body
// Distances in radii of a patch. w may be taken at a probe if no patch is nearer than this,
#define NSVCD__FAR_ENOUGH 1.0f
// or than this, on the inner side of the nearest one.
#define NSVCD__FAR_INSIDE 0.6f
// Patches beyond this do not matter.
#define NSVCD__AMPLE 2.0f
// The patches of a sphere count as one dipole beyond this, in radii of the sphere.
#define NSVCD__DIPOLE 3.0f
// A patch is flat if its area vector is at least this share of its ball's largest disc.
#define NSVCD__FLAT 0.4f
#define NSVCD__INSIDE_SAMPLES 4  // winding numbers, at most

// A filter of a traversal: spheres whose members may be nearer to one of the probes than
// NSVCD__AMPLE of their radii. what: the sphere about the probes. A member (p, r) of a sphere
// (c, R) has |p - c| + r <= R, so that |p - x| / r is at least |c - x| / R.
static uint32_t nsvcd__may_be_close(const void *what, nsvcd__spheres all) {
  const nsvcd__sphere *about = (const nsvcd__sphere *)what;
  const nsvcd__v radius = nsvcd__v_set(about->radius);
  uint32_t close = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_set(about->centre);
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(all, l), centre);
    const nsvcd__v r = nsvcd__v_load(all.r + l);
    const nsvcd__v ample = nsvcd__v_fma(r, nsvcd__v_set(NSVCD__AMPLE), radius);
    close |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(ample)) << l;
  }
  return close;
}

// Points, and how they are situated about a body.
typedef struct nsvcd__probes {
  float at[3][NSVCD__PROBES];
  // the least |p_i - x| / r_i over its patches, squared; at most AMPLE squared
  float square[NSVCD__PROBES];
  // the squared distance of the nearest patch, taken as a disc of its area, and the height over it:
  // negative on the inner side, if the patch is flat
  float nearest[NSVCD__PROBES], height[NSVCD__PROBES];
} nsvcd__probes;

// Fills in all but `at`, from that.
static void nsvcd__probes_measure(const nsvcd_body *body, nsvcd__probes *out) {
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  const nsvcd__v zero = nsvcd__v_set(0);
  nsvcd__f3 low = nsvcd__f3_of(HUGE_VALF, HUGE_VALF, HUGE_VALF);
  nsvcd__f3 high = nsvcd__f3_scale(low, -1);
  nsvcd__traversal traversal;
  size_t g;
  for (size_t k = 0; k < NSVCD__PROBES; k++) {
    low = nsvcd__f3_min(low, nsvcd__lane_of(out->at, k));
    high = nsvcd__f3_max(high, nsvcd__lane_of(out->at, k));
    out->square[k] = NSVCD__AMPLE * NSVCD__AMPLE;
    out->nearest[k] = HUGE_VALF;
    out->height[k] = 0;
  }
  nsvcd__sphere over;
  over.centre = nsvcd__f3_add(nsvcd__f3_scale(low, 0.5f), nsvcd__f3_scale(high, 0.5f));
  over.radius = nsvcd__f3_norm(nsvcd__f3_sub(high, over.centre));
  nsvcd__traversal_begin(&traversal, body, nsvcd__may_be_close, &over);
  while (nsvcd__traversal_next(&traversal, &g)) {
    const size_t next = NSVCD__GROUP * (g + 1);
    const size_t end = next < body->patches ? next : body->patches;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 at = nsvcd__v3_load(out->at, l);
      nsvcd__v least = nsvcd__v_load(out->square + l);
      nsvcd__v nearest = nsvcd__v_load(out->nearest + l);
      nsvcd__v height = nsvcd__v_load(out->height + l);
      for (size_t i = NSVCD__GROUP * g; i < end; i++) {
        const nsvcd__sphere patch = nsvcd__sphere_of(patches, i);
        const nsvcd__f3 area = nsvcd__f3_get(nsvcd__body_areas(body) + i, body->padded);
        const float size = nsvcd__f3_norm(area);
        const nsvcd__f3 normal = nsvcd__f3_scale(area, size > 0 ? 1 / size : 0);
        const nsvcd__v3 d = nsvcd__v3_sub(at, nsvcd__v3_set(patch.centre));
        const nsvcd__v square = nsvcd__v3_dot(d, d);
        const float own = patch.radius * patch.radius;
        const float inverse = 1 / (own > 1e-37f ? own : 1e-37f);
        least = nsvcd__v_min(least, nsvcd__v_scale(square, inverse));
        const nsvcd__v above = nsvcd__v3_dot(d, nsvcd__v3_set(normal));
        const nsvcd__v above2 = nsvcd__v_mul(above, above);
        const nsvcd__v aside2 = nsvcd__v_max(nsvcd__v_sub(square, above2), zero);
        const nsvcd__v radius = nsvcd__v_set(sqrtf(size * 0.3183f));
        const nsvcd__v aside = nsvcd__v_sqrt(aside2);
        const nsvcd__v off = nsvcd__v_max(nsvcd__v_sub(aside, radius), zero);
        const nsvcd__v to_disc = nsvcd__v_fma(off, off, above2);
        const int flat = size > NSVCD__FLAT * 3.1416f * own;
        height = nsvcd__v_pick(nearest, to_disc, height, flat ? above : nsvcd__v_abs(above));
        nearest = nsvcd__v_min(nearest, to_disc);
      }
      nsvcd__v_store(out->square + l, least);
      nsvcd__v_store(out->nearest + l, nearest);
      nsvcd__v_store(out->height + l, height);
    }
  }
}

// Adds to the lanes the terms of the winding number at `point` of `count` spheres, a multiple of
// 16, from `first` on. n: 0 for patches; else for level n - 1, 64 spheres at most. A sphere that is
// too close to the point leaves its term to its members.
static void nsvcd__add_dipoles(const nsvcd_body *body, size_t n, size_t first, size_t count,
                               nsvcd__f3 point, float *lanes) {
  const nsvcd__v3 at = nsvcd__v3_set(point);
  nsvcd__spheres spheres = nsvcd__body_patches(body);
  const float *areas = nsvcd__body_areas(body);
  size_t stride = body->padded;
  uint64_t close = 0;
  if (n > 0) {
    const nsvcd__level level = nsvcd__level_of(body->padded, n - 1);
    spheres = nsvcd__level_spheres(body, level);
    areas = nsvcd__level_areas(body, level);
    stride = level.slots;
  }
  spheres = nsvcd__spheres_from(spheres, first);
  NSVCD__EACH_SLICE(l) {
    nsvcd__v sum = nsvcd__v_load(lanes + l);
    for (size_t i = l; i < count; i += NSVCD__LANES) {
      const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(spheres, i), at);
      const nsvcd__v3 area = nsvcd__v3_get(areas + first + i, stride);
      const nsvcd__v length = nsvcd__v_max(nsvcd__v3_norm(d), nsvcd__v_set(1e-30f));
      const nsvcd__v inverse = nsvcd__v_div(nsvcd__v_set(1), length);
      // one factor at a time, for the cube may overflow
      const nsvcd__v cosine = nsvcd__v_mul(nsvcd__v3_dot(area, d), inverse);
      nsvcd__v term = nsvcd__v_mul(nsvcd__v_mul(cosine, inverse), inverse);
      if (n > 0) {
        const nsvcd__v radius = nsvcd__v_load(spheres.r + i);
        const nsvcd__v least = nsvcd__v_scale(radius, NSVCD__DIPOLE);
        close |= (uint64_t)nsvcd__v_le(length, least) << i;
        term = nsvcd__v_pick(length, least, nsvcd__v_set(0), term);
      }
      sum = nsvcd__v_add(sum, term);
    }
    nsvcd__v_store(lanes + l, sum);
  }
  for (; close; close &= close - 1) {
    const size_t member = NSVCD__GROUP * (first + nsvcd__low_bit(close));
    nsvcd__add_dipoles(body, n - 1, member, NSVCD__GROUP, point, lanes);
  }
}

static float nsvcd__winding_number(const nsvcd_body *body, nsvcd__f3 point) {
  float lanes[NSVCD__LANES] = {0};
  float total = 0;
  const size_t top = nsvcd__level_count(body->padded) - 1;
  const size_t slots = nsvcd__level_of(body->padded, top).slots;
  nsvcd__add_dipoles(body, top ? top + 1 : 0, 0, top ? slots : body->padded, point, lanes);
  // in this order, however wide a slice is
  for (size_t l = 0; l < NSVCD__LANES; l++) total += lanes[l];
  return total / 12.5663706f;
}

// Of the probes that are far enough from the surface, the one that is farthest from those marked;
// PROBES if there is none.
static size_t nsvcd__next_probe(nsvcd__probes *probes, uint32_t marked) {
  size_t next = NSVCD__PROBES;
  float most = -1;
  for (size_t k = 0; k < NSVCD__PROBES; k++) {
    float least = probes->square[k];
    const float needed = probes->height[k] < 0 ? NSVCD__FAR_INSIDE : NSVCD__FAR_ENOUGH;
    if (least < needed * needed || marked >> k & 1) continue;
    for (uint32_t left = marked; left; left &= left - 1) {
      const nsvcd__f3 other = nsvcd__lane_of(probes->at, nsvcd__low_bit(left));
      const nsvcd__f3 d = nsvcd__f3_sub(nsvcd__lane_of(probes->at, k), other);
      const float square = nsvcd__f3_dot(d, d);
      least = square < least || left == marked ? square : least;
    }
    if (least > most) next = k;
    most = least > most ? least : most;
  }
  return next;
}

// Does the ray from a point away from a body's centre meet the ball of a patch? If not, the point
// is outside: from inside the ray would cross the surface.
static int nsvcd__exit_is_blocked(const nsvcd_body *body, nsvcd__f3 point) {
  const nsvcd__f3 away = nsvcd__f3_sub(point, nsvcd__f3_load(body->centre));
  const float length = nsvcd__f3_norm(away);
  const nsvcd__f3 along = nsvcd__f3_scale(away, length > 0 ? 1 / length : 0);
  const nsvcd__beam out = {point, along, NSVCD__ROUNDING * body->extent};
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  nsvcd__traversal traversal;
  size_t g;
  nsvcd__traversal_begin(&traversal, body, nsvcd__is_on_beam, &out);
  while (nsvcd__traversal_next(&traversal, &g)) {
    if (nsvcd__is_on_beam(&out, nsvcd__spheres_from(patches, NSVCD__GROUP * g))) return 1;
  }
  return 0;
}

// Is `inner`, scaled and posed in the frame of `outer`, or a part of it, inside of that?
static int nsvcd__is_contained_in(const nsvcd_body *inner, const nsvcd_body *outer,
                                  float scale, const nsvcd__transform *pose) {
  const nsvcd__spheres patches = nsvcd__body_patches(inner);
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__f3_load(outer->centre));
  nsvcd__probes probes;
  uint32_t inside = 0;
  uint32_t marked = 0;
  uint32_t below = 0;
  if (outer->open) return 0;
  for (size_t k = 0; k < NSVCD__PROBES; k++) {
    // Neighbours are stored together, so that equal steps cover the body.
    const nsvcd__f3 own = nsvcd__centre_of(patches, k * inner->patches / NSVCD__PROBES);
    const nsvcd__f3 turned = nsvcd__mat3_apply(&pose->rotation, own);
    const nsvcd__f3 at = nsvcd__f3_add(nsvcd__f3_scale(turned, scale), pose->position);
    nsvcd__lane_set(at, probes.at, k);
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 off = nsvcd__v3_sub(nsvcd__v3_load(probes.at, l), centre);
    inside |= nsvcd__v_le(nsvcd__v3_norm(off), nsvcd__v_set(outer->radius)) << l;
  }
  for (uint32_t left = inside; left; left &= left - 1) {
    const size_t k = nsvcd__low_bit(left);
    if (!nsvcd__exit_is_blocked(outer, nsvcd__lane_of(probes.at, k))) inside &= ~(1u << k);
  }
  if (!inside) return 0;
  nsvcd__probes_measure(outer, &probes);
  for (size_t k = 0; k < NSVCD__PROBES; k++) {
    if (!(inside >> k & 1)) probes.square[k] = 0;
    below |= (uint32_t)(probes.height[k] < 0) << k;
  }
  // all on the inner side, however near
  if (inside == 0xffff && below == 0xffff) return 1;
  for (size_t n = 0; n < NSVCD__INSIDE_SAMPLES; n++) {
    const size_t k = nsvcd__next_probe(&probes, marked);
    if (k == NSVCD__PROBES) break;
    marked |= 1u << k;
    // -1 if the mesh is inside out
    if (fabsf(nsvcd__winding_number(outer, nsvcd__lane_of(probes.at, k))) > 0.5f) return 1;
  }
  return 0;
}

// Is one body, or a part of it, inside of the other, with the moving one scaled and posed in the
// fixed frame?
static int nsvcd__is_contained(const nsvcd_body *moving, const nsvcd_body *fixed, float scale,
                               const nsvcd__transform *pose) {
  nsvcd__transform back;
  back.rotation = nsvcd__mat3_transpose(pose->rotation);
  const nsvcd__f3 from = nsvcd__mat3_apply(&back.rotation, pose->position);
  back.position = nsvcd__f3_of(-from.x / scale, -from.y / scale, -from.z / scale);
  return nsvcd__is_contained_in(moving, fixed, scale, pose) ||
         nsvcd__is_contained_in(fixed, moving, 1 / scale, &back);
}
#endif  // NSVCD_NO_NETWORK
