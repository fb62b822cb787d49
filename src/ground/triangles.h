// In: two triangles, in double. Out: where they meet, or are nearest.
#pragma once
#include "points.h"

// The normal of a triangle (3 corners); its length is twice the area. Of a segment (a, b, b), as
// round bodies have it, it is 0 where products are fused with sums, too: there a vector across
// itself is what a product was rounded by.
static nsvcd__d3 nsvcd__face_normal(const nsvcd__d3 *t) {
  const nsvcd__d3 u = nsvcd__d3_sub(t[1], t[0]);
  const nsvcd__d3 v = nsvcd__d3_sub(t[2], t[0]);
  const int are_one =
      !(u.x < v.x || u.x > v.x || u.y < v.y || u.y > v.y || u.z < v.z || u.z > v.z);
  return are_one ? nsvcd__d3_of(0, 0, 0) : nsvcd__d3_cross(u, v);
}

typedef struct nsvcd__nearest {
  double square;  // of the distance
  nsvcd__d3 on_a, on_b;
} nsvcd__nearest;

static double nsvcd__clamp_fraction(double x) {
  return x > 0 ? (x < 1 ? x : 1) : 0;
}

static void nsvcd__keep_nearer(nsvcd__nearest *best, nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__nearest found = {nsvcd__d3_distance2(a, b), a, b};
  if (found.square < best->square) *best = found;
}

// The nearest points of the edges a0 a1 and b0 b1 (Ericson 2005, 5.1.9).
static void nsvcd__edges_nearest(nsvcd__d3 a0, nsvcd__d3 a1, nsvcd__d3 b0, nsvcd__d3 b1,
                                 nsvcd__nearest *best) {
  const nsvcd__d3 u = nsvcd__d3_sub(a1, a0);
  const nsvcd__d3 v = nsvcd__d3_sub(b1, b0);
  const nsvcd__d3 w = nsvcd__d3_sub(a0, b0);
  const double uu = nsvcd__d3_dot(u, u);
  const double vv = nsvcd__d3_dot(v, v);
  const double uv = nsvcd__d3_dot(u, v);
  const double uw = nsvcd__d3_dot(u, w);
  const double vw = nsvcd__d3_dot(v, w);
  const double determinant = uu * vv - uv * uv;
  double s = 0;
  if (determinant > 1e-14 * uu * vv)
    s = nsvcd__clamp_fraction((uv * vw - uw * vv) / determinant);
  const double t = vv > 0 ? nsvcd__clamp_fraction((uv * s + vw) / vv) : 0;
  s = uu > 0 ? nsvcd__clamp_fraction((uv * t - uw) / uu) : 0;
  nsvcd__keep_nearer(best, nsvcd__d3_mix(a0, a1, s), nsvcd__d3_mix(b0, b1, t));
}

// The foot of x on the plane of a triangle, if it is inside the triangle.
static int nsvcd__foot_within(nsvcd__d3 x, const nsvcd__d3 *t, nsvcd__d3 *foot) {
  const nsvcd__d3 n = nsvcd__face_normal(t);
  const double square = nsvcd__d3_dot(n, n);
  if (!(square > 0)) return 0;
  const double height = nsvcd__d3_dot(n, nsvcd__d3_sub(x, t[0])) / square;
  *foot = nsvcd__d3_sub(x, nsvcd__d3_scale(n, height));
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 edge = nsvcd__d3_sub(t[(k + 1) % 3], t[k]);
    if (nsvcd__d3_dot(n, nsvcd__d3_cross(edge, nsvcd__d3_sub(*foot, t[k]))) < -1e-12 * square)
      return 0;
  }
  return 1;
}

// Does an edge of one triangle pass through the other, and where? Heights of corners over the
// other's plane are times the length of its normal, which is not normalized.
static int nsvcd__triangles_meet(const nsvcd__d3 *a, const nsvcd__d3 *b, nsvcd__d3 *point) {
  const nsvcd__d3 *of[2] = {a, b};
  double heights[2][3];
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__d3 *other = of[1 - n];
    const nsvcd__d3 normal = nsvcd__face_normal(other);
    size_t above = 0;
    size_t below = 0;
    for (size_t k = 0; k < 3; k++) {
      heights[n][k] = nsvcd__d3_dot(normal, nsvcd__d3_sub(of[n][k], other[0]));
      above += heights[n][k] > 0;
      below += heights[n][k] < 0;
    }
    if (above == 3 || below == 3) return 0;
  }
  for (size_t n = 0; n < 6; n++) {
    const nsvcd__d3 *edges = of[n / 3];
    const size_t k = n % 3;
    const double h0 = heights[n / 3][k];
    const double h1 = heights[n / 3][(k + 1) % 3];
    if ((h0 > 0 && h1 > 0) || (h0 < 0 && h1 < 0) || !(fabs(h0 - h1) > 0)) continue;
    const nsvcd__d3 through = nsvcd__d3_mix(edges[k], edges[(k + 1) % 3], h0 / (h0 - h1));
    if (nsvcd__foot_within(through, of[1 - n / 3], point)) return 1;
  }
  return 0;
}

// How many different corners a triangle has: 1 or 2 for a point or a segment of a round body, as
// nsvcd_encode_sphere and nsvcd_encode_capsule store it.
static size_t nsvcd__corners_of(const nsvcd__d3 *t) {
  if (nsvcd__d3_distance2(t[1], t[2]) > 0) return 3;
  return nsvcd__d3_distance2(t[0], t[1]) > 0 ? 2 : 1;
}

// The nearest points of two triangles; the distance is 0 where they meet.
static inline nsvcd__nearest nsvcd__nearest_of(const nsvcd__d3 *a, const nsvcd__d3 *b) {
  const size_t corners_a = nsvcd__corners_of(a);
  const size_t corners_b = nsvcd__corners_of(b);
  const size_t edges_a = corners_a < 3 ? 1 : 3;
  const size_t edges_b = corners_b < 3 ? 1 : 3;
  nsvcd__nearest best = {HUGE_VAL, {0, 0, 0}, {0, 0, 0}};
  nsvcd__d3 point;
  if (corners_a > 1 && corners_b > 1 && nsvcd__triangles_meet(a, b, &point)) {
    const nsvcd__nearest met = {0, point, point};
    return met;
  }
  for (size_t k = 0; k < edges_a; k++) {
    for (size_t n = 0; n < edges_b; n++)
      nsvcd__edges_nearest(a[k], a[(k + 1) % 3], b[n], b[(n + 1) % 3], &best);
  }
  for (size_t k = 0; k < corners_a && corners_b == 3; k++)
    if (nsvcd__foot_within(a[k], b, &point)) nsvcd__keep_nearer(&best, a[k], point);
  for (size_t k = 0; k < corners_b && corners_a == 3; k++)
    if (nsvcd__foot_within(b[k], a, &point)) nsvcd__keep_nearer(&best, point, b[k]);
  return best;
}
