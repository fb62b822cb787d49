// exact.h - how near triangles come, without rounding: whole numbers of any length, and the distance
// of the origin from the hull of some points. For tests of what is decided at the edge.
//
// While A moves straight along, its least distance from B is that of the origin from the hull of all
// differences of their corners, at both ends of the motion. Coordinates are doubles, which are
// whole multiples of a power of two, and so every number that decides is whole.
#ifndef NSVCD_TESTS_EXACT_H
#define NSVCD_TESTS_EXACT_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXACT_LIMBS 96
#define EXACT_TICKS 4294967296.0  // of a motion

typedef struct whole {
  int sign;   // -1, 0, 1
  int count;  // of limbs, the last of them not 0
  uint32_t limbs[EXACT_LIMBS];
} whole;

static whole whole_trimmed(whole x, int count, int sign) {
  while (count > 0 && x.limbs[count - 1] == 0) count--;
  x.count = count;
  x.sign = count ? sign : 0;
  return x;
}
static void whole_clear(whole *x, int count) {
  if (count > EXACT_LIMBS) {
    printf("exact.h: a number of %d limbs\n", count);
    exit(1);
  }
  memset(x->limbs, 0, (size_t)count * sizeof *x->limbs);
}

// x / 2^unit, which is to be whole.
static whole whole_of(double x, int unit) {
  whole out;
  int exponent = 0;
  uint64_t bits = (uint64_t)ldexp(frexp(fabs(x), &exponent), 53);
  exponent -= 53 + unit;
  for (; bits && exponent < 0; exponent++) bits >>= 1;
  const int first = bits ? exponent / 32 : 0;
  whole_clear(&out, first + 3);
  for (int k = 0; k < 2 && bits; k++) {
    const uint64_t part = (bits >> 32 * k & 0xffffffffu) << exponent % 32;
    out.limbs[first + k] |= (uint32_t)part;
    out.limbs[first + k + 1] |= (uint32_t)(part >> 32);
  }
  return whole_trimmed(out, first + 3, x < 0 ? -1 : 1);
}

// Of the sizes alone.
static int whole_compare_sizes(const whole *a, const whole *b) {
  if (a->count != b->count) return a->count < b->count ? -1 : 1;
  for (int i = a->count - 1; i >= 0; i--)
    if (a->limbs[i] != b->limbs[i]) return a->limbs[i] < b->limbs[i] ? -1 : 1;
  return 0;
}

// a + times b, times being 1 or -1.
static whole whole_sum(const whole *a, const whole *b, int times) {
  const int same = a->sign * b->sign * times >= 0;
  const int sign = a->sign ? a->sign : b->sign * times;
  const int swapped = whole_compare_sizes(a, b) < 0;
  const whole *large = swapped ? b : a;
  const whole *small = swapped ? a : b;
  const int count = large->count + 1;
  whole out;
  int64_t carry = 0;
  whole_clear(&out, count);
  for (int i = 0; i < count; i++) {
    const int64_t x = i < large->count ? large->limbs[i] : 0;
    const int64_t y = i < small->count ? small->limbs[i] : 0;
    carry += same ? x + y : x - y;
    out.limbs[i] = (uint32_t)(carry & 0xffffffff);
    carry = carry < 0 ? -1 : carry >> 32;
  }
  return whole_trimmed(out, count, !same && swapped ? -sign : sign);
}
static whole whole_add(whole a, whole b) {
  return whole_sum(&a, &b, 1);
}
static whole whole_sub(whole a, whole b) {
  return whole_sum(&a, &b, -1);
}
static whole whole_mul(whole a, whole b) {
  whole out;
  whole_clear(&out, a.count + b.count);
  for (int i = 0; i < a.count; i++) {
    uint64_t carry = 0;
    for (int k = 0; k < b.count; k++) {
      carry += (uint64_t)a.limbs[i] * b.limbs[k] + out.limbs[i + k];
      out.limbs[i + k] = (uint32_t)carry;
      carry >>= 32;
    }
    out.limbs[i + b.count] = (uint32_t)carry;
  }
  return whole_trimmed(out, a.count + b.count, a.sign * b.sign);
}
static int whole_compare(whole a, whole b) {
  return whole_sub(a, b).sign;
}
// x = out * 2^exponent, to 53 bits.
static double whole_split(const whole *x, int *exponent) {
  double out = 0;
  const int first = x->count > 3 ? x->count - 3 : 0;
  for (int i = x->count - 1; i >= first; i--) out = out * EXACT_TICKS + x->limbs[i];
  *exponent = 32 * first;
  return x->sign * out;
}

// -------------------------------------------------------------------------------------------------
// points

typedef struct whole3 {
  whole x, y, z;
} whole3;

static whole3 whole3_sub(whole3 a, whole3 b) {
  const whole3 out = {whole_sub(a.x, b.x), whole_sub(a.y, b.y), whole_sub(a.z, b.z)};
  return out;
}
static whole3 whole3_add(whole3 a, whole3 b) {
  const whole3 out = {whole_add(a.x, b.x), whole_add(a.y, b.y), whole_add(a.z, b.z)};
  return out;
}
static whole3 whole3_mul(whole3 a, whole b) {
  const whole3 out = {whole_mul(a.x, b), whole_mul(a.y, b), whole_mul(a.z, b)};
  return out;
}
static whole whole3_dot(whole3 a, whole3 b) {
  return whole_add(whole_add(whole_mul(a.x, b.x), whole_mul(a.y, b.y)), whole_mul(a.z, b.z));
}
static whole whole_cross(whole a, whole b, whole c, whole d) {
  return whole_sub(whole_mul(a, d), whole_mul(b, c));
}
static whole3 whole3_cross(whole3 a, whole3 b) {
  const whole3 out = {whole_cross(a.y, a.z, b.y, b.z), whole_cross(a.z, a.x, b.z, b.x),
                      whole_cross(a.x, a.y, b.x, b.y)};
  return out;
}
static whole3 whole3_of(const double *x, int unit) {
  const whole3 out = {whole_of(x[0], unit), whole_of(x[1], unit), whole_of(x[2], unit)};
  return out;
}

// The nearest point to the origin of a line or a plane through some points, if it is between them.
typedef struct exact_foot {
  whole square, of;  // of its distance: square / of
  whole3 along;      // to it, of any length
} exact_foot;

// count: 1 to 4. 0: it is not between them, or they span less than they could.
static int exact_foot_of(const whole3 *p, int count, exact_foot *out) {
  const whole one = whole_of(1, 0);
  if (count == 1) {
    out->along = p[0];
    out->square = whole3_dot(p[0], p[0]);
    out->of = one;
    return 1;
  }
  const whole3 e = whole3_sub(p[1], p[0]);
  const whole ee = whole3_dot(e, e);
  const whole ep = whole3_dot(e, p[0]);
  if (count == 2) {
    const whole3 across = whole3_cross(e, p[0]);
    if (ep.sign > 0 || whole_add(ee, ep).sign < 0 || !ee.sign) return 0;
    out->along = whole3_sub(whole3_mul(p[0], ee), whole3_mul(e, ep));
    out->square = whole3_dot(across, across);
    out->of = ee;
    return 1;
  }
  const whole3 n = whole3_cross(e, whole3_sub(p[2], p[0]));
  const whole volume = whole3_dot(n, p[0]);
  if (count == 3) {  // on the inner side of each edge?
    for (int k = 0; k < 3; k++)
      if (whole3_dot(n, whole3_cross(p[k], p[(k + 1) % 3])).sign < 0) return 0;
    out->of = whole3_dot(n, n);
    out->square = whole_mul(volume, volume);
    out->along = n;
    if (volume.sign < 0) out->along = whole3_sub(whole3_sub(n, n), n);
    return out->of.sign != 0;
  }
  const int side = whole_sub(whole3_dot(n, p[3]), volume).sign;
  if (!side || volume.sign * side > 0) return 0;
  for (int k = 0; k < 3; k++)
    if (whole3_dot(p[3], whole3_cross(p[k], p[(k + 1) % 3])).sign * side < 0) return 0;
  out->square = whole_sub(one, one);
  out->of = one;
  out->along = p[0];
  return 1;
}

// Distance of the origin from the hull of some points: Gilbert, Johnson and Keerthi's method, which
// ends, since it does not round.
static exact_foot exact_hull(const whole3 *points, int count) {
  whole3 held[4];
  int size = 1;
  exact_foot best;
  held[0] = points[0];
  (void)exact_foot_of(held, 1, &best);
  while (best.square.sign) {
    whole least = whole3_dot(best.along, held[0]);
    int farthest = -1;
    for (int i = 0; i < count; i++) {
      const whole at = whole3_dot(best.along, points[i]);
      if (whole_compare(at, least) >= 0) continue;
      least = at;
      farthest = i;
    }
    if (farthest < 0) break;
    whole3 chosen[4], kept[4];
    int keeps = 0;
    for (int set = 0; set < 1 << size; set++) {  // with the new one, and some of the others
      exact_foot foot;
      int n = 1;
      chosen[0] = points[farthest];
      for (int i = 0; i < size; i++)
        if (set >> i & 1) chosen[n++] = held[i];
      if (!exact_foot_of(chosen, n, &foot)) continue;
      if (whole_compare(whole_mul(foot.square, best.of), whole_mul(best.square, foot.of)) >= 0)
        continue;
      best = foot;
      keeps = n;
      memcpy(kept, chosen, sizeof kept);
    }
    size = keeps;
    memcpy(held, kept, sizeof held);
  }
  return best;
}

// -------------------------------------------------------------------------------------------------
// bodies

typedef struct exact_body {
  double corners[6][3];  // scaled and turned, about the body's origin
  int triangles;         // 1 or 2
  double poses[2][3];    // of its origin, at the start and the end
} exact_body;

static int exact_unit(const double *x, int count) {
  int least = 1024;
  for (int i = 0; i < count; i++) {
    int exponent = 0;
    if (!(fabs(x[i]) > 0)) continue;
    uint64_t bits = (uint64_t)ldexp(frexp(fabs(x[i]), &exponent), 53);
    for (exponent -= 53; !(bits & 1); exponent++) bits >>= 1;
    least = exponent < least ? exponent : least;
  }
  return least;
}

// At a tick: 2^32 times where it is.
static whole3 exact_place(const exact_body *b, double tick, int unit) {
  const whole3 start = whole3_mul(whole3_of(b->poses[0], unit), whole_of(EXACT_TICKS - tick, 0));
  return whole3_add(start, whole3_mul(whole3_of(b->poses[1], unit), whole_of(tick, 0)));
}

// How near they come from one tick to another.
typedef struct exact_distance {
  exact_foot foot;
  int unit;
  double metres;  // to 1e-15 of it
} exact_distance;

static exact_distance exact_between(const exact_body *a, const exact_body *b, double from,
                                    double to) {
  const whole ticks = whole_of(EXACT_TICKS, 0);
  const double *all[4] = {a->corners[0], b->corners[0], a->poses[0], b->poses[0]};
  const int counts[4] = {9 * a->triangles, 9 * b->triangles, 6, 6};
  exact_distance out;
  memset(&out, 0, sizeof out);
  for (int k = 0; k < 4; k++) {
    const int unit = exact_unit(all[k], counts[k]);
    out.unit = unit < out.unit ? unit : out.unit;
  }
  whole3 away[2];
  for (int k = 0; k < 2; k++)
    away[k] = whole3_sub(exact_place(b, k ? to : from, out.unit),
                         exact_place(a, k ? to : from, out.unit));
  for (int n = 0; n < a->triangles * b->triangles; n++) {
    whole3 points[18];
    for (int i = 0; i < 18; i++) {
      const double *x = a->corners[n / b->triangles * 3 + i % 3];
      const double *y = b->corners[n % b->triangles * 3 + i / 3 % 3];
      const whole3 d = whole3_sub(whole3_of(y, out.unit), whole3_of(x, out.unit));
      points[i] = whole3_add(whole3_mul(d, ticks), away[i / 9]);
    }
    const exact_foot foot = exact_hull(points, from < to ? 18 : 9);
    if (n == 0 ||
        whole_compare(whole_mul(foot.square, out.foot.of), whole_mul(out.foot.square, foot.of)) < 0)
      out.foot = foot;
  }
  int up = 0;
  int down = 0;
  const double square = whole_split(&out.foot.square, &up) / whole_split(&out.foot.of, &down);
  out.unit -= 32;
  out.metres = sqrt(ldexp(square, up - down + 2 * out.unit));
  return out;
}

// Is it more than the sum of these lengths? -1: less, 0: it is that.
static int exact_compare(const exact_distance *d, const double *lengths, int count) {
  int unit = exact_unit(lengths, count);
  unit = unit < d->unit ? unit : d->unit;
  whole sum = whole_of(0, 0);
  for (int i = 0; i < count; i++) sum = whole_add(sum, whole_of(lengths[i], unit));
  const whole one = whole_of(ldexp(1, d->unit - unit), 0);
  const whole square = whole_mul(d->foot.square, whole_mul(one, one));
  return whole_compare(square, whole_mul(whole_mul(sum, sum), d->foot.of));
}

#endif
