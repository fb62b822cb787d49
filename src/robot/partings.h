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

// The least that points of a part are along a direction, in all of the box: least[n] if the plane is
// fixed behind n joints, counted from the part.
static void nsvcd__least_along(const nsvcd__span *s, const nsvcd__links *at,
                               const nsvcd__rider *rider, size_t side, nsvcd__d3 along,
                               double *least) {
  for (size_t corner = 0; corner < 8; corner++) {
    nsvcd__d3 p = rider->middle;
    double moved = 0;
    for (size_t k = 0; k < 3; k++)
      p = nsvcd__d3_fma(corner >> k & 1 ? 1 : -1, rider->sides[k], p);
    double value = nsvcd__d3_dot(along, p);
    for (size_t n = 0; n <= s->way_count; n++) {
      least[n] = corner ? nsvcd__min(least[n], value) : value;
      if (n == s->way_count) break;
      const size_t k = side ? s->way_count - 1 - n : n;
      const size_t j = s->way[k];
      const nsvcd__d3 axis = at->axes[j];
      const double h = s->reach[k];
      if (nsvcd__slides(s->checker, j)) {
        value -= h * fabs(nsvcd__d3_dot(along, axis));
        moved += h;
        continue;
      }
      const nsvcd__d3 off =
          nsvcd__d3_cross(axis, nsvcd__d3_sub(p, at->frames[j + 1].position));
      const double r = nsvcd__d3_norm(off) + moved;
      const double chord = 2 * r * s->sines[k];
      const double side_on = nsvcd__d3_norm(nsvcd__d3_cross(along, axis));
      const double way =
          h * (fabs(nsvcd__d3_dot(along, off)) + side_on * (moved + 0.5 * h * r));
      value -= nsvcd__min(way, side_on * chord);
      moved += chord;
    }
  }
}

// Is a plane of this normal, of length 1 or less, farther from both parts together than the
// clearance in all of the box?
static int nsvcd__parts_along(const nsvcd__span *s, const nsvcd__links *at,
                              const nsvcd__rider *riders, nsvcd__d3 normal, double clearance) {
  double least[2][NSVCD_MAX_JOINTS + 1];
  const nsvcd__d3 back = nsvcd__d3_scale(normal, -1);
  for (size_t side = 0; side < 2; side++)
    nsvcd__least_along(s, at, &riders[side], side, side ? back : normal, least[side]);
  const double sizes = 1 + fabs(least[0][0]) + fabs(least[1][0]);
  for (size_t n = 0; n <= s->way_count; n++) {
    const double apart = least[0][n] + least[1][s->way_count - n];
    if (apart > clearance * (1 + 1e-9) + NSVCD__PARTING_ROUNDING * sizes) return 1;
  }
  return 0;
}

// Does a plane part the two in all of the box? Tried are the direction from middle to middle, those
// of the sides of both boxes, and those of the joints' axes, along which these move nothing.
static int nsvcd__are_parted(const nsvcd__span *s, const nsvcd__links *at,
                             const nsvcd__rider *riders, double clearance) {
  const nsvcd__d3 between = nsvcd__d3_sub(riders[0].middle, riders[1].middle);
  for (size_t n = 0; n < 7 + s->way_count; n++) {
    nsvcd__d3 normal = between;
    if (n > 0 && n < 7) normal = riders[(n - 1) / 3].sides[(n - 1) % 3];
    if (n >= 7) normal = at->axes[s->way[n - 7]];
    const double length = nsvcd__d3_norm(normal) * (1 + 1e-12);
    if (!(length > 0)) continue;
    const double sign = nsvcd__d3_dot(normal, between) < 0 ? -1 : 1;
    normal = nsvcd__d3_scale(normal, sign / length);
    if (nsvcd__parts_along(s, at, riders, normal, clearance)) return 1;
  }
  return 0;
}
