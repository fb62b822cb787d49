// In: a motion, and contact that a scene allows near some configurations. Out: when a pair is
// allowed to touch.
//
// Each joint's values over a time are bounded by their control points, and from these how far the
// parts are from where they are in the configuration.
#pragma once
#include "steps.h"

// by how much less than an allowance's distance is sought when a motion leaves it, for rounding
#define NSVCD__ALLOWANCE_ROUNDING 1e-9
#define NSVCD__ALLOWANCE_HALVINGS 40

// The last link that carries two others.
static size_t nsvcd__common_link(const nsvcd_scene *scene, size_t a, size_t b) {
  while (a != b) {
    size_t *later = a > b ? &a : &b;
    *later = scene->joints[*later - 1].parent;
  }
  return a;
}

// Are both parts of an allowance's pair within its distance, and `more` metres, of where they are
// in its configuration, for all joint values from `low` to `high`?
static int nsvcd__allows(const nsvcd_checker *c, const nsvcd_allowance *allowance,
                         const double *low, const double *high, double more) {
  const double full_turn = 6.283185307179586;
  const nsvcd_body_pair *pair = &c->scene->pairs[allowance->pair];
  const size_t parts[2] = {pair->a, pair->b};
  const size_t base = nsvcd__common_link(c->scene, c->scene->parts[pair->a].link,
                                         c->scene->parts[pair->b].link);
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__member *m = &c->members[parts[n]];
    double reach = nsvcd__d3_norm(m->frame.position) + m->extent + m->round;
    double moved = 0;
    for (size_t link = c->scene->parts[parts[n]].link; link != base;
         link = nsvcd__link_before(c, link)) {
      const size_t j = link - 1;
      const int is_endless = c->scene->joints[j].kind == NSVCD_JOINT_CONTINUOUS;
      const double off = 0.5 * (low[j] + high[j]) - allowance->joints[j];
      const double turns = is_endless ? floor(off / full_turn + 0.5) : 0;
      const double at = allowance->joints[j] + full_turn * turns;
      const double most = nsvcd__max(fabs(at), nsvcd__max(fabs(low[j]), fabs(high[j])));
      const double way = nsvcd__max(fabs(low[j] - at), fabs(high[j] - at));
      moved += nsvcd__slides(c, j) ? way : way * reach;
      reach += nsvcd__d3_norm(c->links[j].origin.position);
      if (nsvcd__slides(c, j)) reach += most;
    }
    if (!(moved <= allowance->distance + more)) return 0;
  }
  return 1;
}

// Bounds of the joints' values from time t0 to t1.
static void nsvcd__joint_ranges(const nsvcd_joint_motion *m, size_t joints, double t0,
                                double t1, double *low, double *high) {
  const size_t first = nsvcd__piece_at(m, t0);
  for (size_t j = 0; j < joints; j++) {
    low[j] = HUGE_VAL;
    high[j] = -HUGE_VAL;
    for (size_t piece = first;; piece++) {
      double p[NSVCD_MAX_DEGREE + 1];
      nsvcd__joint_points(m, piece, joints, j, p);
      if (m->degree > 0)
        nsvcd__cut_curve(p, m->degree, nsvcd__fraction_at(m, piece, t0),
                         nsvcd__fraction_at(m, piece, t1));
      for (size_t i = 0; i <= m->degree; i++) {
        low[j] = nsvcd__min(low[j], p[i]);
        high[j] = nsvcd__max(high[j], p[i]);
      }
      if (piece + 1 >= m->pieces || !(nsvcd__piece_start(m, piece + 1) < t1)) break;
    }
  }
}

// Is contact allowed all the while from time t0 to t1?
static int nsvcd__allows_from_to(const nsvcd_checker *c, const nsvcd_allowance *allowance,
                                 const nsvcd_joint_motion *m, double t0, double t1,
                                 double more) {
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  nsvcd__joint_ranges(m, c->scene->joint_count, t0, t1, low, high);
  return nsvcd__allows(c, allowance, low, high, more);
}

static int nsvcd__pair_is_allowed(const nsvcd_checker *c, size_t pair,
                                  const nsvcd_joint_motion *m, double t0, double t1) {
  for (size_t n = 0; n < c->scene->allowance_count; n++) {
    const nsvcd_allowance *allowance = &c->scene->allowances[n];
    if (allowance->pair == pair && nsvcd__allows_from_to(c, allowance, m, t0, t1, 0)) return 1;
  }
  return 0;
}

// Until when contact is allowed from one end of a motion on. Returns that end where it is not.
static double nsvcd__allowed_up_to(const nsvcd_checker *c, const nsvcd_allowance *allowance,
                                   const nsvcd_joint_motion *m, double end, double other) {
  const double less = -NSVCD__ALLOWANCE_ROUNDING * allowance->distance;
  double allowed = end;
  double not_allowed = other;
  if (!nsvcd__allows_from_to(c, allowance, m, end, end, less)) return end;
  for (size_t n = 0; n < NSVCD__ALLOWANCE_HALVINGS; n++) {
    const double t = n ? 0.5 * (allowed + not_allowed) : other;
    const int is_allowed =
        nsvcd__allows_from_to(c, allowance, m, nsvcd__min(end, t), nsvcd__max(end, t), less);
    *(is_allowed ? &allowed : &not_allowed) = t;
    if (is_allowed && n == 0) break;
  }
  return allowed;
}

// Notes when a motion leaves what is allowed at its start, and enters what is allowed at its end.
static void nsvcd__note_cuts(nsvcd_checker *c, const nsvcd_joint_motion *m) {
  const double t0 = nsvcd__piece_start(m, 0);
  const double t1 = nsvcd__piece_start(m, m->pieces);
  for (size_t n = 0; n < c->scene->allowance_count; n++) {
    c->cuts[2 * n] = nsvcd__allowed_up_to(c, &c->scene->allowances[n], m, t0, t1);
    c->cuts[2 * n + 1] = nsvcd__allowed_up_to(c, &c->scene->allowances[n], m, t1, t0);
  }
}

// The first of these times after one, or `end`.
static double nsvcd__next_cut(const nsvcd_checker *c, double time, double end) {
  double next = end;
  for (size_t n = 0; n < 2 * c->scene->allowance_count; n++) {
    if (c->cuts[n] > time && c->cuts[n] < next) next = c->cuts[n];
  }
  return next;
}
