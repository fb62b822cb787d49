// In: a part, and a step of the joints between two samples. Out: by how much it leaves, at most,
// the line and the slerp between them.
//
// THE BOUND. A step goes from joints q0 to q1 = q0 + d in a time h; x is the share of it that has
// gone by, and u = x - g x (1 - x) / 2 for a number |g| <= 2 of our choice: it goes from 0 to 1 as
// well, and never back. Each joint is q0 + u d + e, with e = 0 at both ends and e'' = h^2 q'' -
// g d, derivatives by x: |e| <= max |e''| / 8; where q' jumps by v, e' does by h v, and |e| may be
// more by h v / 4. What a point y of the part is, at most, off where
// q0 + u d has it:
//   sum over joints j of |e_j| r_j           r_j: no point is farther from the axis of j
// On the straight way q0 + u d the point is off its chord by max |y''| / 8, derivatives by u. With
// d^2 y / dq_j dq_k no more than r of the outer one of j and k, as long as both turn (an outer one
// that slides has 1 in place of r; an inner one that slides, 0),
//   |y''| <= sum_j |d_j| r_j (2 sum over inner k that turn of |d_k| + |d_j|)
// and what slides has no square. The sweep goes through the same places at both ends, by a line of
// the origin and a slerp by an angle w, and is off that chord by w^2 R / 8, R the point's distance
// from the origin. All together, for any u, and so at all times:
//   deviate <= (sum_j max |e''_j| r_j + |y''| + w^2 R) / 8
// r_j is that of the sample q0, and what joints beyond j can add while they move.
// Source: this library.
#pragma once
#include "steps.h"

// The angle of the turn from a to b, radians: the shorter one.
static double nsvcd__angle_between(nsvcd__dquat a, nsvcd__dquat b) {
  const double side = nsvcd__dquat_dot(a, b) < 0 ? -1 : 1;
  const nsvcd__dquat chord = nsvcd__dquat_fma(-side, b, a);
  return 4 * asin(nsvcd__min(0.5 * sqrt(nsvcd__dquat_dot(chord, chord)), 1));
}

// The bound of the banner, from moment arms r (F) on the path of joints. turn: w.
static double nsvcd__deviation_by(const nsvcd_checker *c, const nsvcd__step *step,
                                  uint32_t path, const double *moment_arms, double turn,
                                  double extent) {
  double bend = 0;
  double second = 0;
  double inner = 0;
  for (; path; path &= path - 1) {
    const size_t j = nsvcd__low_bit(path);
    const double own = nsvcd__slides(c, j) ? 0 : step->travel[j];
    bend += step->bend[j] * moment_arms[j];
    second += step->travel[j] * moment_arms[j] * (2 * inner + own);
    inner += own;
  }
  return (bend + second + turn * turn * extent) / 8;
}

// r of the banner: how far points of a part can be from the axes of the joints on its path, during
// a step that begins in a configuration; 1 of what slides.
static void nsvcd__moment_arms_of(const nsvcd_checker *c, size_t part, const nsvcd__step *step,
                                  const nsvcd__configuration *from, double *moment_arms) {
  const nsvcd__member *m = &c->members[part];
  const size_t link = c->scene->parts[part].link;
  const uint32_t path = c->links[link - 1].path;
  const nsvcd__frame *frame = &from->frames[link];
  const nsvcd__d3 centre =
      nsvcd__d3_add(nsvcd__dquat_rotate(frame->turn, m->centre), frame->position);
  double moved = 0;  // by joints beyond this one
  for (size_t j = link; j-- > 0;) {
    if (!(path >> j & 1)) continue;
    moment_arms[j] = 1;
    if (!nsvcd__slides(c, j)) {
      const nsvcd__d3 off = nsvcd__d3_sub(centre, from->frames[j + 1].position);
      moment_arms[j] =
          nsvcd__d3_length(nsvcd__d3_cross(from->axes[j], off)) + m->radius + moved;
    }
    moved += step->farthest[j] * moment_arms[j];
  }
}

// What a part deviates at most in a step from one configuration to another.
static double nsvcd__part_deviation(const nsvcd_checker *c, size_t part,
                                    const nsvcd__step *step, const nsvcd__configuration *from,
                                    const nsvcd__configuration *to) {
  const size_t link = c->scene->parts[part].link;
  double moment_arms[NSVCD_MAX_JOINTS];
  const double turn = nsvcd__angle_between(from->frames[link].turn, to->frames[link].turn);
  nsvcd__moment_arms_of(c, part, step, from, moment_arms);
  return nsvcd__deviation_by(c, step, c->links[link - 1].path, moment_arms, turn,
                             c->members[part].extent);
}
