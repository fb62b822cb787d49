// SPDX-License-Identifier: MIT
// nsvcd_verify_robot.h - of nsvcd_verify.h: the motion of what a robot's joints carry, for
// certificates of nsvcd_certify_pair. What is proven is the joints' own motion, at all times.
//
// Joint i carries link i + 1; link 0 is the world. A corner x of a part is at
//   T_1 T_2 ... T_m (s R x + p),   T_j y = O_j (turn about the axis by q_j) y
//                                       or O_j (y + axis q_j) of one that slides
// over the joints from the base to its link; R, p is the part's pose. The joint values q are Bezier
// curves in time, piece by piece. Both parts may be seen from a link that carries both, the base:
// what is between them stays the same. nsvcd_verify refuses parts of two bases or two motions.
//
// DEVIATION. Let x in [0,1] be the share of a stretch of a piece that has gone by, V_j and A_j
// bounds of |q_j'| and |q_j''| by x, and L_j one of the distance of a point y of the part from
// joint j; of a joint that slides, 1. Of two joints the outer one is nearer to the part. The
// derivative of y by q_j is no more than L_j; that by q_j and q_k no more than L of the outer one
// if the inner one turns, 0 if it slides; that by q_j twice no more than L_j, if it turns. So
//   |y''| <= sum over j of A_j L_j + V_j (2 sum over outer k of V_k L_k + V_j L_j),
// the second term only for joints that turn, and a chord is left by an eighth of it. L_j is the sum
// of what stands between joint j and y: offsets of joints, slides, |p| and |s x|. formal/Chains.v
// proves it, without the roundings.
//
// ROUNDINGS. Ends of pieces and shares of a piece are rounded: that changes the clock of both parts
// alike, since they share one motion. V, A and the bound of a slide come from the points of a curve
// cut twice (de Casteljau). M is the most that the points of its piece are. A step of a cut is off
// by 2.8e-16 M and a cut takes 5 at most; the share at which the second one begins, rounded, moves
// points by 1.1e-15 M: in all 4e-15 M. So a slide is off by as much, V, 5 times the difference of
// two, by 4e-14 M, and A, 20 times a sum of four, by 3.4e-13 M. 5e-13 M is added to each.
#ifndef NSVCD_VERIFY_ROBOT_H
#define NSVCD_VERIFY_ROBOT_H
#include "nsvcd_verify.h"

#define NSVCD_VERIFY_JOINTS 128
#define NSVCD_VERIFY_DEGREE 5

typedef struct nsvcd_verify_joint {
  uint32_t slides;  // 0: it turns
  uint32_t parent;  // the link that it is on, no more than its own number
  float origin[7];  // x y z qx qy qz qw, in that link
  float axis[3];    // any length but 0, in its frame
} nsvcd_verify_joint;

typedef struct nsvcd_verify_motion {
  const nsvcd_verify_joint *joints;
  size_t joint_count, pieces, degree;
  const double *points;  // (pieces degree + 1, joints): Bezier, each piece begins where one ends
  const double *times;   // (pieces + 1) rising
} nsvcd_verify_motion;

// What is on a link.
typedef struct nsvcd_verify_part {
  const nsvcd_verify_motion *motion;
  uint32_t link, base;  // base: the link from which it is seen, on the way to the world
  float pose[7];        // in its link
} nsvcd_verify_part;

static inline double verify__piece_end(const nsvcd_verify_motion *m, size_t piece) {
  return verify__stored((m->times[piece] - m->times[0]) / (m->times[m->pieces] - m->times[0]));
}

static inline size_t verify__piece(const nsvcd_verify_motion *m, double t) {
  size_t low = 0;
  size_t high = m->pieces;
  while (high > low + 1) {
    const size_t middle = (low + high) / 2;
    if (verify__piece_end(m, middle) > t)
      high = middle;
    else
      low = middle;
  }
  return low;
}

// The points of a joint's curve from one time to another, both in a piece (de Casteljau). Returns by
// how much they, their differences and second differences, times the degree, are off at most.
static inline double verify__curve(const nsvcd_verify_motion *m, size_t joint, size_t piece,
                                   double t0, double t1, double *p) {
  const double start = verify__piece_end(m, piece);
  const double whole = verify__piece_end(m, piece + 1) - start;
  const double to = verify__min((t1 - start) / whole, 1);
  const double from = to > 0 ? verify__max((t0 - start) / whole, 0) / to : 0;
  double most = 0;
  for (size_t i = 0; i <= m->degree; i++) {
    p[i] = m->points[(piece * m->degree + i) * m->joint_count + joint];
    most = verify__max(most, fabs(p[i]));
  }
  for (size_t level = 1; level <= m->degree; level++)
    for (size_t i = m->degree; i >= level; i--) p[i] = (1 - to) * p[i - 1] + to * p[i];
  for (size_t level = 1; level <= m->degree; level++)
    for (size_t i = 0; i + level <= m->degree; i++) p[i] = (1 - from) * p[i] + from * p[i + 1];
  return 5e-13 * most;
}

// place becomes what a frame does to it: m place + at.
static inline void verify__lift_into(const double *m, const float *at, nsvcd_verify_place *place) {
  const nsvcd_verify_place old = *place;
  for (int i = 0; i < 3; i++) {
    place->at[i] = verify__dot(m + 3 * i, old.at) + (at ? (double)at[i] : 0);
    for (int k = 0; k < 3; k++)
      place->turn[3 * i + k] =
          m[3 * i] * old.turn[k] + m[3 * i + 1] * old.turn[3 + k] + m[3 * i + 2] * old.turn[6 + k];
  }
}

static inline void verify__part_place(const void *motion, double t, nsvcd_verify_place *out) {
  const nsvcd_verify_part *part = (const nsvcd_verify_part *)motion;
  const nsvcd_verify_motion *m = part->motion;
  const size_t piece = verify__piece(m, t);
  double matrix[9];
  double q[4];
  for (int i = 0; i < 4; i++) q[i] = (double)part->pose[3 + i];
  verify__matrix(q, out->turn);
  for (int i = 0; i < 3; i++) out->at[i] = (double)part->pose[i];
  for (uint32_t link = part->link; link != part->base; link = m->joints[link - 1].parent) {
    const nsvcd_verify_joint *joint = &m->joints[link - 1];
    double p[NSVCD_VERIFY_DEGREE + 1];
    double axis[3];
    for (int i = 0; i < 3; i++) axis[i] = (double)joint->axis[i];
    const double length = sqrt(verify__dot(axis, axis));
    (void)verify__curve(m, link - 1, piece, t, t, p);
    for (int i = 0; i < 3; i++) {
      q[i] = axis[i] / length * sin(0.5 * p[0]);
      if (joint->slides) out->at[i] += axis[i] / length * p[0];
    }
    q[3] = cos(0.5 * p[0]);
    verify__matrix(q, matrix);
    if (!joint->slides) verify__lift_into(matrix, NULL, out);
    for (int i = 0; i < 4; i++) q[i] = (double)joint->origin[3 + i];
    verify__matrix(q, matrix);
    verify__lift_into(matrix, joint->origin, out);
  }
}

static inline double verify__part_next(const void *motion, double t) {
  const nsvcd_verify_motion *m = ((const nsvcd_verify_part *)motion)->motion;
  return m->pieces > 0 ? verify__piece_end(m, verify__piece(m, t) + 1) : 1;
}

static inline double verify__offset(const float *at) {
  return sqrt((double)at[0] * (double)at[0] + (double)at[1] * (double)at[1] +
              (double)at[2] * (double)at[2]);
}

// deviation[0] and outer[0] are metres, deviation[1] and outer[1] what r is multiplied by. The piece is the
// one half way, as of a path. Where t0 and t1 are neighbours and it is the one after t1, speed and
// bend become nearly 0. They are: in 1.2e-16 no joint goes farther than 1.2e-11, at 1e5 a stretch of
// 1, and A, with 1e-9 for a piece, is below 1e-16: a deviation of 1e-14 of all lengths.
static inline void verify__part_deviation(const void *motion, double t0, double t1,
                                          double *deviation) {
  const nsvcd_verify_part *part = (const nsvcd_verify_part *)motion;
  const nsvcd_verify_motion *m = part->motion;
  const size_t piece = verify__piece(m, 0.5 * (t0 + t1));
  const double n = (double)m->degree;
  double reach = verify__offset(part->pose);
  double outer[2] = {0, 0};
  deviation[0] = deviation[1] = 0;
  for (uint32_t link = part->link; link != part->base; link = m->joints[link - 1].parent) {
    const nsvcd_verify_joint *joint = &m->joints[link - 1];
    const double arm[2] = {joint->slides ? 1 : reach, joint->slides ? 0.0 : 1.0};
    double p[NSVCD_VERIFY_DEGREE + 1];
    double most = 0, speed = 0, bend = 0;
    const double off = verify__curve(m, link - 1, piece, t0, t1, p);
    for (size_t i = 0; i <= m->degree; i++) most = verify__max(most, fabs(p[i]));
    for (size_t i = 0; i + 1 <= m->degree; i++)
      speed = verify__max(speed, n * fabs(p[i + 1] - p[i]));
    for (size_t i = 0; i + 2 <= m->degree; i++)
      bend = verify__max(bend, n * (n - 1) * fabs(p[i + 2] - 2 * p[i + 1] + p[i]));
    most += off;
    speed += off;
    bend += off;
    for (int k = 0; k < 2; k++) {
      deviation[k] += 0.1250001 * bend * arm[k];
      if (!joint->slides) deviation[k] += 0.1250001 * speed * (2 * outer[k] + speed * arm[k]);
      outer[k] += speed * arm[k];
    }
    reach += verify__offset(joint->origin) + (joint->slides ? most : 0);
  }
}

// The deepest link that carries two others.
static inline uint32_t nsvcd_verify_common(const nsvcd_verify_motion *m, uint32_t a, uint32_t b) {
  while (a != b) {
    if (a > b)
      a = m->joints[a - 1].parent;
    else
      b = m->joints[b - 1].parent;
  }
  return a;
}

// No point of a mesh that is in a triangle is farther from its origin.
static inline double nsvcd_verify_radius(const nsvcd_verify_mesh *mesh) {
  double most = 0;
  for (size_t i = 0; i < 3 * mesh->triangles; i++) {
    const float *x = verify__corner(mesh, i / 3, i % 3);
    most = verify__max(most, verify__offset(x));
  }
  return most;
}

// Is no point of a part, none of which is farther than a radius from its origin, farther than
// `metres` from where it is where piece `there` begins, as the base sees it, in all pieces from
// `from` to before `to`? there: from or to. All values lie within the points of their curves. Along
// the straight way from those there, which lies within them too, a point moves by no more than the
// sum of each joint's way times L_j, as above. That is off by a few roundings for each joint: less
// than 1e-12 of it.
static inline int nsvcd_verify_stays(const nsvcd_verify_part *part, double radius, size_t from,
                                     size_t to, size_t there, double metres) {
  const nsvcd_verify_motion *m = part->motion;
  double reach = verify__offset(part->pose) + radius;
  double moved = 0;
  for (uint32_t link = part->link; link != part->base; link = m->joints[link - 1].parent) {
    const nsvcd_verify_joint *joint = &m->joints[link - 1];
    const double *values = m->points + link - 1;
    double most = 0, way = 0;
    for (size_t i = from * m->degree; i <= to * m->degree; i++) {
      const double value = values[i * m->joint_count];
      most = verify__max(most, fabs(value));
      way = verify__max(way, fabs(value - values[there * m->degree * m->joint_count]));
    }
    moved += joint->slides ? way : way * reach;
    reach += verify__offset(joint->origin) + (joint->slides ? most : 0);
  }
  return moved * (1 + 1e-12) <= metres;
}

// No point of a part of a mesh is farther than that from the axis of the joint that carries a link, as
// its base sees both at half the time.
static inline double verify__from_axis(const nsvcd_verify_part *part, const nsvcd_verify_mesh *mesh,
                                       uint32_t link) {
  const float *own = part->motion->joints[link - 1].axis;
  const nsvcd_verify_part carried = {part->motion, link, part->base, {0, 0, 0, 0, 0, 0, 1}};
  nsvcd_verify_place joint, at;
  double axis[3], most = 0, square = 0;
  verify__part_place(&carried, 0.5, &joint);
  verify__part_place(part, 0.5, &at);
  for (int i = 0; i < 3; i++) {
    const double *row = joint.turn + 3 * i;
    axis[i] = row[0] * (double)own[0] + row[1] * (double)own[1] + row[2] * (double)own[2];
    square += axis[i] * axis[i];
  }
  for (size_t n = 0; n < 3 * mesh->triangles; n++) {
    const float *x = verify__corner(mesh, n / 3, n % 3);
    double off[3], cross[3];
    for (int i = 0; i < 3; i++) {
      const double *row = at.turn + 3 * i;
      off[i] = at.at[i] - joint.at[i] + row[0] * (double)x[0] + row[1] * (double)x[1] +
               row[2] * (double)x[2];
    }
    for (int i = 0; i < 3; i++) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      cross[i] = axis[j] * off[k] - axis[k] * off[j];
    }
    most = verify__max(most, verify__dot(cross, cross));
  }
  return sqrt(most / square);
}

// How far two parts may come nearer to each other, from where they are at half the time, if each
// joint between them, but the one that carries link `but`, goes as far to either side as `half` says,
// and that one, too. If one joint turns by w and others stay, their distance changes by w r at most: r
// is the distance of the farthest point of either part from its axis, of either, since to turn one is
// to turn the other back; where it slides, r is 1. Joints may change one after another. r is that at
// half the time, and what the joints between that part and the axis add: the chord 2 r sin(h / 2) of
// each that turns by h, and h of one that slides.
static inline double nsvcd_verify_travel(const nsvcd_verify_part *parts,
                                         const nsvcd_verify_mesh *const *meshes, const double *half,
                                         uint32_t but) {
  const nsvcd_verify_joint *joints = parts[0].motion->joints;
  uint32_t path[2 * NSVCD_VERIFY_JOINTS];
  double arms[2 * NSVCD_VERIFY_JOINTS];
  size_t count = 0;
  double sum = 0;
  for (uint32_t a = parts[0].link; a != parts[0].base; a = joints[a - 1].parent) path[count++] = a;
  const size_t turning = count;
  for (uint32_t b = parts[1].link; b != parts[1].base; b = joints[b - 1].parent) path[count++] = b;
  for (size_t i = turning, j = count; i + 1 < j; i++) {
    const uint32_t outer = path[i];
    path[i] = path[--j];
    path[j] = outer;
  }
  for (int side = 0; side < 2; side++) {
    double moved = 0;
    for (size_t n = 0; n < count; n++) {
      const size_t k = side ? count - 1 - n : n;
      const double h = half[path[k] - 1];
      const int slides = joints[path[k] - 1].slides != 0;
      double arm = 1;
      if (!slides) arm = verify__from_axis(&parts[side], meshes[side], path[k]) + moved;
      moved += slides ? h : 2 * arm * sin(0.5 * verify__min(h, 3.141592653589793));
      arms[k] = side ? verify__min(arms[k], arm) : arm;
    }
  }
  for (size_t k = 0; k < count; k++) sum += path[k] == but ? 0 : half[path[k] - 1] * arms[k];
  return sum * (1 + 1e-10);
}

// The product of a direction with an axis of a part at a time.
static inline double verify__along(const nsvcd_verify_part *part, const double *axis,
                                   const double *direction, double t) {
  nsvcd_verify_place at;
  double sum = 0;
  verify__part_place(part, t, &at);
  for (int i = 0; i < 3; i++) sum += direction[i] * verify__dot(at.turn + 3 * i, axis);
  return sum;
}

// Does an axis of a part, seen from the world, stay within an angle of a direction, both of length
// 1? Where it does, its product with the direction is no less than the angle's cosine. If both ends
// of a stretch are so, the chord between them is, and the axis leaves that as a point at a distance
// of 1 does that only turns: by deviation[1]. The stretches are as long as that allows. Returns 1 if all
// are so by VERIFY__MARGIN, and 0 also where that takes stretches shorter than 1e-12.
static inline int nsvcd_verify_keeps(const nsvcd_verify_part *part, const double *axis,
                                     const double *direction, double angle) {
  const double least = cos(angle) + VERIFY__MARGIN;
  double last = verify__along(part, axis, direction, 0);
  double stretch = 1;
  for (double t = 0; t < 1;) {
    const double end = verify__min(t + stretch, verify__part_next(part, t));
    const double next = verify__along(part, axis, direction, end);
    double deviation[2];
    verify__part_deviation(part, t, end, deviation);
    const int keeps = verify__min(last, next) - deviation[1] >= least;
    stretch = (end - t) * (keeps ? 2 : 0.5);
    if (!keeps && !(stretch > 1e-12)) return 0;
    if (keeps) t = end;
    if (keeps) last = next;
  }
  return 1;
}

static inline int verify__is_pose(const float *pose) {
  double square = 0;
  for (int i = 0; i < 7; i++) {
    if (!verify__within(pose[i], 1e6f)) return 0;
    if (i > 2) square += (double)pose[i] * (double)pose[i];
  }
  return fabs(square - 1) < 2.1e-4;
}

// Checks joints and their motion. Returns why not, or NULL.
static inline const char *nsvcd_verify_motion_check(const nsvcd_verify_motion *m) {
  if (m->joint_count < 1 || m->joint_count > NSVCD_VERIFY_JOINTS) return "no joints, or too many";
  if (m->pieces < 1 || m->pieces > 65536 || m->degree < 1 || m->degree > NSVCD_VERIFY_DEGREE)
    return "a motion has no pieces, or too many, or of another degree";
  for (size_t i = 0; i < m->joint_count; i++) {
    const nsvcd_verify_joint *joint = &m->joints[i];
    if (joint->parent > i) return "a joint is on a link that comes after it";
    if (!verify__is_pose(joint->origin)) return "a joint is at no pose";
    for (int k = 0; k < 3; k++)
      if (!verify__within(joint->axis[k], 1e12f)) return "an axis is out of range";
    if (!(verify__offset(joint->axis) > 1e-12)) return "an axis has no length";
  }
  for (size_t i = 0; i <= m->pieces; i++) {
    if (!verify__within_double(m->times[i], 1e9)) return "a time is out of range";
    if (i > 0 && !(m->times[i] > m->times[i - 1])) return "times do not rise";
  }
  for (size_t i = 1; i <= m->pieces; i++) {
    if (!(verify__piece_end(m, i) - verify__piece_end(m, i - 1) >= 1e-9))
      return "a piece is too short";
  }
  // sines lose digits of large angles, and a share of a short piece those of what goes fast
  for (size_t i = 0; i <= m->pieces * m->degree; i++) {
    const size_t piece = i > 0 ? (i - 1) / m->degree : 0;
    const double whole = verify__piece_end(m, piece + 1) - verify__piece_end(m, piece);
    for (size_t k = 0; k < m->joint_count; k++) {
      const double *value = &m->points[i * m->joint_count + k];
      if (!verify__within_double(*value, m->joints[k].slides ? 1e6 : 250))
        return "a joint is out of range";
      const double step = i > 0 ? (double)m->degree * fabs(*value - *(value - m->joint_count)) : 0;
      if (!(step <= 1e5 * whole)) return "a joint is too fast";
    }
  }
  return NULL;
}

// The lower half of a double first, whatever the machine's order.
static inline uint32_t verify__hash_double(uint32_t hash, double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  const uint32_t halves[2] = {(uint32_t)bits, (uint32_t)(bits >> 32)};
  return verify__hash(hash, halves, 2);
}

// Makes a mover of a mesh, a scale and a part of a motion that has been checked, all of which stay.
// Returns why not, or NULL.
static inline const char *nsvcd_verify_part_init(const nsvcd_verify_mesh *mesh, float scale,
                                                 const nsvcd_verify_part *part,
                                                 nsvcd_verify_mover *mover) {
  const nsvcd_verify_motion *m = part->motion;
  if (!(verify__within(scale, 1e6f) && scale >= 1e-6f)) return "a scale is out of range";
  if (!verify__is_pose(part->pose)) return "a part is at no pose";
  if (part->link > m->joint_count || part->base > part->link) return "a part is on no link";
  mover->mesh = mesh;
  mover->scale = (double)scale;
  mover->place = verify__part_place;
  mover->next = verify__part_next;
  mover->deviation = verify__part_deviation;
  mover->motion = part;
  mover->clock = m;
  mover->base = part->base;
  mover->reach = verify__offset(part->pose);
  uint32_t d = verify__hash(part->base, part->pose, 7);
  d = verify__hash(d, &scale, 1);
  for (uint32_t link = part->link; link != part->base; link = m->joints[link - 1].parent) {
    if (link == 0) return "a part is seen from a link that does not carry it";
    const nsvcd_verify_joint *joint = &m->joints[link - 1];
    d = verify__hash(d + joint->slides, joint->origin, 7);
    d = verify__hash(d + link, joint->axis, 3);
    double most = 0;
    for (size_t i = 0; i <= m->pieces * m->degree; i++) {
      const double *value = &m->points[i * m->joint_count + link - 1];
      d = verify__hash_double(d, *value);
      most = verify__max(most, fabs(*value));
    }
    mover->reach += verify__offset(joint->origin) + (joint->slides ? most : 0);
  }
  d += (uint32_t)m->degree;
  for (size_t i = 0; i <= m->pieces; i++) d = verify__hash_double(d, m->times[i]);
  mover->digest = d;
  return NULL;
}
#endif  // NSVCD_VERIFY_ROBOT_H
