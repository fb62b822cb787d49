// In: a part, and a step of the joints between two samples. Out: by how much it leaves, at most,
// the line and the slerp between them.
//
// THE BOUND. A step goes from joints q0 to q1 = q0 + d in a time h; x in [0,1] is the fraction of
// it that has gone by. Let u = x - g x (1 - x) / 2 for a number |g| <= 2 of our choice: u goes from
// 0 to 1 too, and never back. Each joint is q0 + u d + e, with e = 0 at both ends and e'' = h^2 q''
// - g d, derivatives by x. So |e| <= max |e''| / 8; where q' jumps by v, e' jumps by h v, and |e|
// may be more by h v / 4. From where q0 + u d has it, a point y of the part is off by at most
//   sum over joints j of |e_j| r_j           r_j: no point is farther from the axis of j
// On the straight line q0 + u d the point leaves its chord by max |y''| / 8 at most, derivatives by
// u. While both turn, d^2 y / dq_j dq_k is no more than r of the outer one of j and k. For an outer
// one that slides r is 1; where the inner one slides, the derivative is 0. So
//   |y''| <= sum_j |d_j| r_j (2 sum over inner k that turn of |d_k| + |d_j|)
// and a joint that slides has no square. The sweep has the same poses at both ends, and between
// them a line of the origin and a slerp by an angle w: it leaves that chord by w^2 R / 8, R the
// point's distance from the origin. All together, for any u, and so at all times:
//   deviation <= (sum_j max |e''_j| r_j + |y''| + w^2 R) / 8
// r_j is that of the sample q0, and what the joints beyond j can add while they move.
// Source: this library.
#pragma once
#include "steps.h"

// The angle of the turn from a to b, radians: the shorter one.
static double nsvcd__angle_between(nsvcd__dquat a, nsvcd__dquat b) {
  const double side = nsvcd__dquat_dot(a, b) < 0 ? -1 : 1;
  return 2 * nsvcd__dquat_arc(a, nsvcd__dquat_scale(b, side));
}

// r of the banner, (F): how far points of a part can be from the axes of the joints of its chain,
// during a step that begins in a configuration.
static void nsvcd__moment_arms_of(const nsvcd_checker *c, size_t part, const nsvcd__step *step,
                                  const nsvcd__links *from, double *arms) {
  const nsvcd__member *m = &c->members[part];
  size_t link = c->scene->parts[part].link;
  const nsvcd__d3 centre = nsvcd__dpose_apply(&from->frames[link], m->centre);
  // by joints beyond this one
  double moved = 0;
  for (; link > 0; link = nsvcd__link_before(c, link)) {
    const size_t j = link - 1;
    arms[j] = 1;
    if (!nsvcd__slides(c, j)) {
      const nsvcd__d3 off = nsvcd__d3_sub(centre, from->frames[j + 1].position);
      const nsvcd__d3 across = nsvcd__d3_cross(from->axes[j], off);
      arms[j] = nsvcd__d3_norm(across) + m->radius + moved;
    }
    moved += step->farthest[j] * arms[j];
  }
}

// The bound of the banner, for a part that moves.
static double nsvcd__part_deviation(const nsvcd_checker *c, size_t part,
                                    const nsvcd__step *step, const nsvcd__links *from,
                                    const nsvcd__links *to) {
  const size_t link = c->scene->parts[part].link;
  const double w =
      nsvcd__angle_between(from->frames[link].rotation, to->frames[link].rotation);
  double arms[NSVCD_MAX_JOINTS];
  double bend = 0;
  double second = 0;
  // from the part to the world; the sum over inner joints, as one over outer ones
  double outer = 0;
  nsvcd__moment_arms_of(c, part, step, from, arms);
  for (size_t at = link; at > 0; at = nsvcd__link_before(c, at)) {
    const size_t j = at - 1;
    const double moved = step->travel[j] * arms[j];
    bend += step->bend[j] * arms[j];
    if (!nsvcd__slides(c, j)) second += step->travel[j] * (2 * outer + moved);
    outer += moved;
  }
  return (bend + second + w * w * c->members[part].extent) / 8;
}
