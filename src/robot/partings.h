// In: two parts, and a box of values of the joints between them. Out: does a plane part them in all
// of it?
//
// THE BOUND. The plane is fixed in some link between the two: joints up to there move the one part,
// those beyond it the other. From the centre of the box joints may change one after another, the
// outer ones first, so that each still has the axis that it has at the centre. A point p that outer
// joints have displaced by m or less is then turned by w about an axis through f, of direction x.
// Its way is across x. So along the plane's normal n, of which c is across x, it is no more than
//   sin |w| |n . (x, p' - f)| + (1 - cos w) c r  <=  h (|n . (x, p - f)| + c m) + h^2 c r / 2
// where (,) is the vector product, p' the displaced point, r its distance from the axis, and h the
// most that |w| is; nor is it more than c times the chord 2 r sin(h / 2), h up to pi. The chord is
// added to m for joints further in. One that slides moves the point by h |n . x|. For a given
// configuration n . p is linear in p, so that of all points of a box about a part a corner comes
// farthest.
// Source: this library.
#pragma once
#include "spans.h"

// of all lengths: errors of frames in double
#define NSVCD__PARTING_ROUNDING 1e-9

// A plane, fixed behind so many joints, counted from the first part.
typedef struct nsvcd__parting {
  nsvcd__d3 normal;
  size_t fixed;
  // metres, at least: how far apart the two are along it in all of the box, and at its centre
  double apart, centre;
} nsvcd__parting;

// By how much one joint of the way can bring a point nearer along a direction, at most. moved: by
// how much joints further out can displace it, to which this one is added.
static double nsvcd__loss_along(const nsvcd__span *s, const nsvcd__links *at, size_t k,
                                nsvcd__d3 p, nsvcd__d3 along, double *moved) {
  const size_t j = s->way[k];
  const nsvcd__d3 axis = at->axes[j];
  const double h = s->reach[k];
  const double before = *moved;
  if (nsvcd__slides(s->checker, j)) {
    *moved += h;
    return h * fabs(nsvcd__d3_dot(along, axis));
  }
  const nsvcd__d3 off = nsvcd__d3_cross(axis, nsvcd__d3_sub(p, at->frames[j + 1].position));
  const double r = nsvcd__d3_norm(off) + before;
  const double chord = 2 * r * s->sines[k];
  const double across = nsvcd__d3_norm(nsvcd__d3_cross(along, axis));
  const double way = h * (fabs(nsvcd__d3_dot(along, off)) + across * (before + 0.5 * h * r));
  *moved += chord;
  return nsvcd__min(way, across * chord);
}

static nsvcd__d3 nsvcd__corner_of(const nsvcd__rider *rider, size_t corner) {
  nsvcd__d3 p = rider->middle;
  for (size_t k = 0; k < 3; k++)
    p = nsvcd__d3_fma(corner >> k & 1 ? 1 : -1, rider->sides[k], p);
  return p;
}

// The least that points of a part are along a direction, in all of the box: least[n] if the plane
// is fixed behind n joints, counted from the part.
static void nsvcd__least_along(const nsvcd__span *s, const nsvcd__links *at,
                               const nsvcd__rider *rider, size_t side, nsvcd__d3 along,
                               double *least) {
  for (size_t corner = 0; corner < 8; corner++) {
    const nsvcd__d3 p = nsvcd__corner_of(rider, corner);
    double moved = 0;
    double value = nsvcd__d3_dot(along, p);
    for (size_t n = 0; n <= s->way_count; n++) {
      least[n] = corner ? nsvcd__min(least[n], value) : value;
      if (n == s->way_count) break;
      const size_t k = side ? s->way_count - 1 - n : n;
      value -= nsvcd__loss_along(s, at, k, p, along, &moved);
    }
  }
}

// Of all planes with this normal, of length 1 or less, the one that parts the two by most.
static nsvcd__parting nsvcd__parting_along(const nsvcd__span *s, const nsvcd__links *at,
                                           const nsvcd__rider *riders, nsvcd__d3 normal) {
  double least[2][NSVCD_MAX_JOINTS + 1];
  nsvcd__parting out = {normal, 0, -HUGE_VAL, 0};
  for (size_t side = 0; side < 2; side++)
    nsvcd__least_along(s, at, &riders[side], side, nsvcd__d3_scale(normal, side ? -1 : 1),
                       least[side]);
  for (size_t n = 0; n <= s->way_count; n++) {
    const double apart = least[0][n] + least[1][s->way_count - n];
    if (!(apart > out.apart)) continue;
    out.apart = apart;
    out.fixed = n;
  }
  const double sizes = 1 + fabs(least[0][0]) + fabs(least[1][0]);
  out.apart -= NSVCD__PARTING_ROUNDING * sizes;
  out.centre = least[0][0] + least[1][0];
  return out;
}

// A plane that parts the two by more than the clearance in all of the box; or the best of those
// that are tried. Their normals are the direction from middle to middle, those of the sides of both
// boxes, and those of the joints' axes, along which these move nothing.
static nsvcd__parting nsvcd__best_parting(const nsvcd__span *s, const nsvcd__links *at,
                                          const nsvcd__rider *riders, double clearance) {
  const nsvcd__d3 between = nsvcd__d3_sub(riders[0].middle, riders[1].middle);
  nsvcd__parting best = {between, 0, -HUGE_VAL, -HUGE_VAL};
  for (size_t n = 0; n < 7 + s->way_count && !(best.apart > clearance); n++) {
    nsvcd__d3 normal = between;
    if (n > 0 && n < 7) normal = riders[(n - 1) / 3].sides[(n - 1) % 3];
    if (n >= 7) normal = at->axes[s->way[n - 7]];
    const double length = nsvcd__d3_norm(normal) * (1 + 1e-12);
    if (!(length > 0)) continue;
    const double sign = nsvcd__d3_dot(normal, between) < 0 ? -1 : 1;
    const nsvcd__parting found =
        nsvcd__parting_along(s, at, riders, nsvcd__d3_scale(normal, sign / length));
    if (found.apart > best.apart) best = found;
  }
  return best;
}

// Metres, of each joint of the path: by how much it can bring the two nearer along a parting.
static void nsvcd__losses_of(const nsvcd__span *s, const nsvcd__links *at,
                             const nsvcd__rider *riders, const nsvcd__parting *parting,
                             double *losses) {
  for (size_t k = 0; k < s->joints; k++) losses[k] = 0;
  for (size_t side = 0; side < 2; side++) {
    const size_t count = side ? s->way_count - parting->fixed : parting->fixed;
    for (size_t corner = 0; corner < 8; corner++) {
      const nsvcd__d3 p = nsvcd__corner_of(&riders[side], corner);
      double moved = 0;
      for (size_t n = 0; n < count; n++) {
        const size_t k = side ? s->way_count - 1 - n : n;
        double *loss = &losses[s->drivers[k]];
        *loss = nsvcd__max(*loss, nsvcd__loss_along(s, at, k, p, parting->normal, &moved));
      }
    }
  }
}
