// SPDX-License-Identifier: MIT
// nsvcd_verify_rays.h - of nsvcd_verify.h: how a certificate is read, and what it shows of one
// time: rays, by which something is inside of something or not, and triangles that meet.
#ifndef NSVCD_VERIFY_RAYS_H
#define NSVCD_VERIFY_RAYS_H
#include "nsvcd_verify_scene.h"

#define VERIFY__MARGIN 1e-10

typedef enum nsvcd_verify_kind {
  NSVCD_VERIFY_NOTHING,
  NSVCD_VERIFY_FREE,
  NSVCD_VERIFY_HIT,
  NSVCD_VERIFY_NEAR,
  NSVCD_VERIFY_INSIDE
} nsvcd_verify_kind;

typedef struct nsvcd_verify_report {
  const char *reason;      // why it is refused; NULL: it is not
  size_t position;         // the byte that would be read next
  nsvcd_verify_kind kind;  // what is proven; NOTHING: it is refused
  double time;             // when, for HIT, NEAR and INSIDE
  uint32_t a, b;           // HIT, NEAR: triangles. INSIDE: a corner, and whose: 0 a's, 1 b's
} nsvcd_verify_report;

typedef struct verify__instant {
  double t;
  nsvcd_verify_place a, b;
  double deviation_a[6], deviation_b[6];  // deviations from here to the next instant
} verify__instant;

typedef struct verify__reader {
  const nsvcd_verify_mover *a, *b;
  double clearance;
  const uint8_t *bytes;
  size_t bits, at;       // all, and those that are read
  double normals[8][3];  // the last ones, the last first
  verify__instant *instants;
  size_t count, capacity;
  int apart;  // 1: the roots have been parted
} verify__reader;

/*@ predicate a_reader(verify__reader *r) =
      \valid(r) && r->bits <= 8 * (SIZE_MAX / 16) && r->at <= r->bits + 256 &&
      \valid_read(r->bytes + (0 .. (r->bits + 7) / 8 - 1)) &&
      \separated(r, r->bytes + (0 .. (r->bits + 7) / 8 - 1)); */

/*@ predicate at_work(verify__reader *r) =
      a_reader(r) && a_mover(r->a) && a_mover(r->b) && r->count <= r->capacity &&
      \valid(r->instants + (0 .. r->capacity - 1)) &&
      \separated(r, r->a, r->b, r->a->mesh, r->b->mesh, r->instants + (0 .. r->capacity - 1)); */

// ---- reading

// The next bits, the highest of a byte first. Past the end they are 0, and r->at exceeds r->bits.
/*@ requires a_reader(r) && 0 <= count <= 32;
    assigns r->at;
    ensures r->at == \old(r->at) + count; */
static inline uint32_t verify__read(verify__reader *r, int count) {
  uint32_t out = 0;
  /*@ loop invariant 0 <= count <= \at(count, Pre);
      loop invariant r->at == \at(r->at, Pre) + (\at(count, Pre) - count);
      loop assigns count, out, r->at;
      loop variant count; */
  for (; count > 0; count--, r->at++) {
    const int more = r->at < r->bits;
    out = 2 * out + (more ? (uint32_t)r->bytes[r->at / 8] >> (7 - r->at % 8) & 1 : 0);
  }
  return out;
}

// The next normal: k zeros and a 1: the one k + 1 places before the last; seven zeros: a new one,
// 0 and two numbers of 8 bits, 10 and two of 16, or 11 and two of 24. They are a point of the
// octahedron |x| + |y| + |z| = half, seen from above, with its lower half folded outwards. It
// becomes the last. A new one is never 0: where z is 0, |x| + |y| is half; where x and y become 0, z
// is -half. One that is remembered is, until eight were written: it parts nothing, and no ray of it
// is clear.
/*@ requires a_reader(r) && r->at <= r->bits + 192;
    assigns r->at, *(&r->normals[0][0] + (0 .. 23));
    ensures \old(r->at) < r->at <= \old(r->at) + 57; */
static inline void verify__read_normal(verify__reader *r) {
  double n[3];
  size_t k = 1;
  /*@ loop invariant 1 <= k <= 8 && r->at == \at(r->at, Pre) + k - 1;
      loop assigns k, r->at;
      loop variant 8 - k; */
  while (k < 8 && !verify__read(r, 1)) k++;
  memcpy(n, r->normals[k % 8], sizeof n);
  if (k == 8) {
    const int bits = !verify__read(r, 1) ? 8 : !verify__read(r, 1) ? 16 : 24;
    const double half = (double)((1 << (bits - 1)) - 1);
    const double x = (double)verify__read(r, bits) - half;
    const double y = (double)verify__read(r, bits) - half;
    n[2] = half - fabs(x) - fabs(y);
    n[0] = n[2] < 0 ? copysign(half - fabs(y), x) : x;
    n[1] = n[2] < 0 ? copysign(half - fabs(x), y) : y;
    k = 7;
  }
  memmove(r->normals[1], r->normals[0], k * sizeof n);
  memcpy(r->normals[0], n, sizeof n);
}

/*@ requires \valid_read(a + (0 .. 2)) && \valid_read(b + (0 .. 2));
    assigns \nothing; */
static inline double verify__dot(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// No point of a node is farther from its body's origin: no coordinate of its box is larger than the
// corner's, and 1e-6 holds the roundings.
/*@ requires a_mover(mover) && \valid_read(node) && a_node(node, mover->mesh);
    assigns \nothing; */
static inline double verify__radius(const nsvcd_verify_mover *mover,
                                    const nsvcd_verify_node *node) {
  const float *low = mover->mesh->boxes + 6 * (size_t)node->box;
  double corner[3];
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, corner[0 .. 2];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) corner[i] = verify__max(-(double)low[i], (double)low[i + 3]);
  return 1.000001 * mover->scale * sqrt(verify__dot(corner, corner));
}

/*@ requires \valid_read(a) && \valid_read(b);
    assigns \nothing; */
static inline double verify__lengths(double radii, const nsvcd_verify_place *a,
                                     const nsvcd_verify_place *b) {
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, radii;
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) radii += fabs(a->at[i]) + fabs(b->at[i]);
  return radii;
}

// ---- rays

// A vertex of one mover in the frame of another, in units of its scale.
/*@ requires a_mover(of) && \valid_read(of_at) && \valid_read(by) && \valid_read(by_at);
    requires vertex < of->mesh->vertices && \valid(out + (0 .. 2));
    requires \separated(out + (0 .. 2), by_at, by);
    assigns out[0 .. 2]; */
static inline void verify__seen(const nsvcd_verify_mover *of, const nsvcd_verify_place *of_at,
                                const nsvcd_verify_mover *by, const nsvcd_verify_place *by_at,
                                uint32_t vertex, double *out) {
  const float *x = of->mesh->positions + 3 * (size_t)vertex;
  double world[3];
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, world[0 .. 2];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) {
    const double *row = of_at->turn + 3 * i;
    world[i] = row[0] * (double)x[0] + row[1] * (double)x[1] + row[2] * (double)x[2];
    world[i] = of->scale * world[i] + (of_at->at[i] - by_at->at[i]);
  }
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, out[0 .. 2];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) {
    const double *column = by_at->turn + i;
    out[i] = column[0] * world[0] + column[3] * world[1] + column[6] * world[2];
    out[i] /= by->scale;
  }
}

// What is known of points in the frame of one mover, in units of its scale: no coordinate is longer
// than `lengths`, and each is nearer than the margin to where it truly is.
typedef struct verify__extent {
  double lengths, margin;
} verify__extent;

// Does a ray from y along d leave (1) or enter (-1) through a triangle, or miss it (0)? 2: that is
// not clear, by the margin.
/*@ requires a_mesh(m) && triangle < m->triangles && \valid_read(e);
    requires \valid_read(y + (0 .. 2)) && \valid_read(d + (0 .. 2));
    assigns \nothing;
    ensures -1 <= \result <= 2; */
static inline int verify__crosses(const nsvcd_verify_mesh *m, uint32_t triangle, const double *y,
                                  const double *d, const verify__extent *e) {
  const double length = sqrt(verify__dot(d, d));
  const double rounding = 1e-4 * VERIFY__MARGIN * e->lengths * e->lengths;
  double p[3][3], cross[3], edge[3], normal[3] = {0, 0, 0}, ahead = -VERIFY__BEYOND;
  int left = 0;
  int right = 0;
  /*@ loop invariant 0 <= k <= 3;
      loop assigns k, ahead, p[0 .. 2][0 .. 2];
      loop variant 3 - k; */
  for (uint32_t k = 0; k < 3; k++) {
    /*@ loop invariant 0 <= i <= 3;
        loop assigns i, p[k][0 .. 2];
        loop variant 3 - i; */
    for (int i = 0; i < 3; i++) p[k][i] = (double)verify__corner(m, triangle, k)[i] - y[i];
    ahead = verify__max(ahead, verify__dot(p[k], d));
  }
  if (ahead < -e->margin * length) return 0;
  // On which side of each edge does it pass? det(d, u, v) is off by |d| |edge| if y is off by a
  // metre, and by |u x v| if d is: of an edge twice the margin, for both of its ends are off. If
  // both are off, by |edge| times both more. That is held too: points are off by half a margin at
  // most, and a side is told only where |d| is over two margins. The line above trusts d: a ray's is
  // exact, and of an edge 0 proves nothing. `rounding` is det's own, in units of |d|: it is a sum of
  // products of three lengths, good to 2e-15 of these.
  /*@ loop invariant -1 <= k <= 2 && 0 <= left <= 2 - k && 0 <= right <= 2 - k;
      loop assigns k, left, right, cross[0 .. 2], edge[0 .. 2], normal[0 .. 2];
      loop variant k; */
  for (int k = 2; k >= 0; k--) {
    const double *u = p[k];
    const double *v = p[(k + 1) % 3];
    /*@ loop invariant 0 <= i <= 3;
        loop assigns i, cross[0 .. 2], edge[0 .. 2], normal[0 .. 2];
        loop variant 3 - i; */
    for (int i = 0; i < 3; i++) {
      cross[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
      edge[i] = v[i] - u[i];
      normal[i] += cross[i];
    }
    const double off = length * (e->margin * sqrt(verify__dot(edge, edge)) + rounding) +
                       2 * e->margin * sqrt(verify__dot(cross, cross));
    const double side = verify__dot(d, cross);
    if (side > off) left++;
    if (side < -off) right++;
  }
  if (left > 0 && right > 0) return 0;
  if (left < 3 && right < 3) return 2;
  // and on which side of the triangle is y? det(p0, p1, p2) changes by |normal| if y does by a metre
  const double volume = verify__dot(p[2], cross);
  const double off = e->margin * sqrt(verify__dot(normal, normal)) + rounding * e->lengths;
  if (!(fabs(volume) > off)) return 2;
  if ((volume > 0) != (left > 0)) return 0;
  return left > 0 ? 1 : -1;
}

// Does the line of a ray miss a box by a margin? If something across both of them parts them. The
// line of a normal of 0 misses nothing: 0 is not more than 0.
/*@ requires \valid_read(box + (0 .. 5));
    requires \valid_read(y + (0 .. 2)) && \valid_read(d + (0 .. 2));
    assigns \nothing; */
static inline int verify__misses(const float *box, const double *y, const double *d,
                                 double margin) {
  const double most = margin * sqrt(verify__dot(d, d));
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i;
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double off_j = 0.5 * ((double)box[j] + (double)box[j + 3]) - y[j];
    const double off_k = 0.5 * ((double)box[k] + (double)box[k + 3]) - y[k];
    const double half_j = 0.5 * ((double)box[j + 3] - (double)box[j]);
    const double half_k = 0.5 * ((double)box[k + 3] - (double)box[k]);
    const double off = fabs(d[j] * off_k - d[k] * off_j);
    if (off > fabs(d[j]) * half_k + fabs(d[k]) * half_j + most) return 1;
  }
  return 0;
}

// Sums what a ray of the last normal crosses of a mesh, by components. 0: it is not clear.
static inline int verify__cast(const verify__reader *r, const nsvcd_verify_mesh *m, const double *y,
                               const verify__extent *e) {
  const double *d = r->normals[0];
  nsvcd_verify_node stack[VERIFY__LEVELS] = {{0, 0, (uint32_t)m->triangles}};
  size_t height = 1;
  if (!(verify__dot(y, y) < VERIFY__BEYOND)) return 0;  // a NaN would pass for a miss
  memset(m->sums, 0, m->vertices * sizeof *m->sums);
  while (height > 0) {
    const nsvcd_verify_node node = stack[--height];
    if (verify__misses(m->boxes + 6 * (size_t)node.box, y, d, e->margin)) continue;
    if (node.count > 1) {
      verify__children(&node, stack + height);
      height += 2;
      continue;
    }
    const uint32_t triangle = m->order[node.first];
    const int crossed = verify__crosses(m, triangle, y, d, e);
    if (crossed == 2) return 0;
    m->sums[m->part[m->indices[3 * (size_t)triangle]]] += crossed;
  }
  return 1;
}

// How often closed components wind about where the ray begins.
/*@ requires a_mesh(m) && \valid_read(m->open + (0 .. m->vertices - 1)) && \valid_read(m->sums + (0 .. m->vertices - 1));
    assigns \nothing; */
static inline int64_t verify__wound(const nsvcd_verify_mesh *m) {
  int64_t sum = 0;
  /*@ loop invariant 0 <= v <= m->vertices;
      loop invariant -0x80000000 * v <= sum <= 0x7fffffff * v;
      loop assigns v, sum;
      loop variant m->vertices - v; */
  for (size_t v = 0; v < m->vertices; v++) sum += m->open[v] ? 0 : m->sums[v];
  return sum;
}

/*@ requires a_mover(of) && a_mover(by) && \valid_read(of_at) && \valid_read(by_at);
    assigns \nothing; */
static inline verify__extent verify__extent_of(const nsvcd_verify_mover *of,
                                               const nsvcd_verify_place *of_at,
                                               const nsvcd_verify_mover *by,
                                               const nsvcd_verify_place *by_at) {
  const nsvcd_verify_node root = {0, 0, 1};
  const double offset[3] = {of_at->at[0] - by_at->at[0], of_at->at[1] - by_at->at[1],
                            of_at->at[2] - by_at->at[2]};
  const double apart = sqrt(verify__dot(offset, offset));
  const double radii = verify__radius(of, &root) + verify__radius(by, &root);
  const double places = verify__lengths(of->reach + by->reach, of_at, by_at);
  verify__extent out;
  out.lengths = (radii + apart) / by->scale;
  out.margin = VERIFY__MARGIN * (out.lengths + places / by->scale);
  return out;
}

// Rays from all components of one mover at t = 0, each from its lowest vertex, which stands for it
// in `part`.
static inline const char *verify__outside(verify__reader *r, const nsvcd_verify_mover *of,
                                          const nsvcd_verify_mover *by) {
  nsvcd_verify_place of_at, by_at;
  of->place(of->motion, 0, &of_at);
  by->place(by->motion, 0, &by_at);
  const verify__extent e = verify__extent_of(of, &of_at, by, &by_at);
  for (uint32_t v = 0; v < of->mesh->vertices; v++) {
    double y[3];
    if (of->mesh->part[v] != v) continue;
    if (!verify__read(r, 1)) verify__read_normal(r);
    if (r->at > r->bits) return "it ends early";
    verify__seen(of, &of_at, by, &by_at, v, y);
    if (!verify__cast(r, by->mesh, y, &e)) return "a ray passes too near to an edge";
    if (verify__wound(by->mesh) != 0) return "a ray does not show that a component is outside";
  }
  return NULL;
}

// ---- what meets, and what is inside

// What is named: two movers where they are at a time.
typedef struct verify__pair {
  const nsvcd_verify_mover *mover[2];
  nsvcd_verify_place at[2];
  uint32_t triangle[2];
} verify__pair;

/*@ predicate a_pair(verify__pair *p) =
      \valid_read(p) && a_mover(p->mover[0]) && a_mover(p->mover[1]) &&
      p->triangle[0] < p->mover[0]->mesh->triangles && p->triangle[1] < p->mover[1]->mesh->triangles; */

// A corner of the triangle of one of them, in the frame of another.
/*@ requires a_pair(p) && 0 <= of <= 1 && 0 <= by <= 1 && k < 3 && \valid(out + (0 .. 2));
    requires \separated(out + (0 .. 2), p, p->mover[0], p->mover[1]);
    assigns out[0 .. 2]; */
static inline void verify__corner_seen(const verify__pair *p, int of, int by, uint32_t k,
                                       double *out) {
  const uint32_t vertex = p->mover[of]->mesh->indices[3 * (size_t)p->triangle[of] + k];
  verify__seen(p->mover[of], &p->at[of], p->mover[by], &p->at[by], vertex, out);
}

/*@ requires a_pair(p) && 0 <= of <= 1 && 0 <= by <= 1;
    assigns \nothing; */
static inline verify__extent verify__extent_in(const verify__pair *p, int of, int by) {
  return verify__extent_of(p->mover[of], &p->at[of], p->mover[by], &p->at[by]);
}

// Whose edge, and which: it passes through the other's triangle, if that is crossed by rays from
// both of its ends to the other end, one outwards, one inwards: so each end has the triangle before
// it, and it is between them.
/*@ requires a_reader(r) && r->at <= r->bits + 128 && a_pair(p);
    requires \separated(r, p, p->mover[0], p->mover[1], p->mover[0]->mesh, p->mover[1]->mesh);
    assigns r->at; */
static inline const char *verify__pierced(verify__reader *r, const verify__pair *p) {
  const int of = (int)verify__read(r, 1);
  const uint32_t edge = verify__read(r, 2);
  const nsvcd_verify_mesh *m = p->mover[!of]->mesh;
  const verify__extent e = verify__extent_in(p, of, !of);
  double from[3], to[3], there[3], back[3];
  if (edge == 3) return "it names an edge that there is not";
  verify__corner_seen(p, of, !of, edge, from);
  verify__corner_seen(p, of, !of, (edge + 1) % 3, to);
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, there[0 .. 2], back[0 .. 2];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) {
    there[i] = to[i] - from[i];
    back[i] = -there[i];
  }
  const int first = verify__crosses(m, p->triangle[!of], from, there, &e);
  const int second = verify__crosses(m, p->triangle[!of], to, back, &e);
  const int clear = first == 1 || first == -1;
  return clear && second == -first ? NULL : "an edge does not pass through a triangle";
}

// A point of each triangle, by two numbers of 16 bits: shares of the way from its first corner to
// the second, and from there to the third. Weights are none below 0 and sum to 1, to a rounding, so
// the points are of the triangles. Both are off by half a margin at most.
/*@ requires a_reader(r) && r->at <= r->bits + 128 && a_pair(p);
    requires \separated(r, p, p->mover[0], p->mover[1], p->mover[0]->mesh, p->mover[1]->mesh);
    assigns r->at; */
static inline const char *verify__near(verify__reader *r, const verify__pair *p) {
  double apart[3] = {0, 0, 0};
  /*@ loop invariant 0 <= k <= 2 && r->at == \at(r->at, Pre) + 32 * k;
      loop assigns k, r->at, apart[0 .. 2];
      loop variant 2 - k; */
  for (int k = 0; k < 2; k++) {
    const double v = (double)verify__read(r, 16) / 65535;
    const double w = (double)verify__read(r, 16) / 65535;
    const double sign = k ? -1 : 1;
    const double weight[3] = {sign * (1 - v), sign * v * (1 - w), sign * v * w};
    /*@ loop invariant 0 <= c <= 3;
        loop assigns c, apart[0 .. 2];
        loop variant 3 - c; */
    for (uint32_t c = 0; c < 3; c++) {
      double x[3];
      verify__corner_seen(p, k, 1, c, x);
      /*@ loop invariant 0 <= i <= 3;
          loop assigns i, apart[0 .. 2];
          loop variant 3 - i; */
      for (int i = 0; i < 3; i++) apart[i] += weight[c] * x[i];
    }
  }
  const double distance = sqrt(verify__dot(apart, apart)) + verify__extent_in(p, 0, 1).margin;
  return p->mover[1]->scale * distance < r->clearance ? NULL : "two points are not as near as that";
}

// Whose corner, which, and a ray. Only closed components count.
static inline const char *verify__inside(verify__reader *r, nsvcd_verify_report *out) {
  out->b = verify__read(r, 1);
  out->a = verify__read(r, 32);
  verify__read_normal(r);
  const nsvcd_verify_mover *of = out->b ? r->b : r->a;
  const nsvcd_verify_mover *by = out->b ? r->a : r->b;
  const nsvcd_verify_mesh *m = by->mesh;
  nsvcd_verify_place of_at, by_at;
  double y[3];
  if (out->a >= of->mesh->vertices || of->mesh->part[out->a] == NSVCD_VERIFY_NONE)
    return "it names a corner that there is not";
  of->place(of->motion, out->time, &of_at);
  by->place(by->motion, out->time, &by_at);
  verify__seen(of, &of_at, by, &by_at, out->a, y);
  const verify__extent e = verify__extent_of(of, &of_at, by, &by_at);
  if (!verify__cast(r, m, y, &e)) return "a ray passes too near to an edge";
  return verify__wound(m) != 0 ? NULL : "a ray does not show that a corner is inside";
}

// HIT, NEAR and INSIDE: when, and what.
static inline const char *verify__meeting(verify__reader *r, nsvcd_verify_kind kind,
                                          nsvcd_verify_report *out) {
  verify__pair p;
  out->time = (double)verify__read(r, 32) / 4294967295.0;
  if (kind == NSVCD_VERIFY_INSIDE) return verify__inside(r, out);
  out->a = p.triangle[0] = verify__read(r, 32);
  out->b = p.triangle[1] = verify__read(r, 32);
  p.mover[0] = r->a;
  p.mover[1] = r->b;
  for (int k = 0; k < 2; k++) {
    if (p.triangle[k] >= p.mover[k]->mesh->triangles)
      return "it names a triangle that there is not";
    p.mover[k]->place(p.mover[k]->motion, out->time, &p.at[k]);
  }
  return kind == NSVCD_VERIFY_HIT ? verify__pierced(r, &p) : verify__near(r, &p);
}
#endif  // NSVCD_VERIFY_RAYS_H
