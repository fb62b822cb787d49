// In: times of a motion. Out: its samples, where all parts are placed, and how far each part
// deviates in the steps between them; boxes about parts in a step.
#pragma once
#include "checker.h"

// errors of frames in double, as a fraction of the lengths that they are computed from: of 32
// joints, and in proportion if there are more
#define NSVCD__FRAME_ROUNDING 1e-13
// from one call of a check's `stop` to the next
#define NSVCD__STOP_SAMPLES 8

// Places the parts that move, in a configuration, as sample k.
static void nsvcd__place_sample(nsvcd_checker *c, const nsvcd__links *at, size_t k) {
  const nsvcd_scene *scene = c->scene;
  const double rounding =
      NSVCD__FRAME_ROUNDING * nsvcd__max(1, (double)scene->joint_count / 32);
  double most = 0;
  for (size_t link = 1; link <= scene->joint_count; link++)
    most = nsvcd__max(most, nsvcd__d3_norm(at->frames[link].position));
  for (size_t n = 0; n < c->mover_count; n++) {
    nsvcd__member *m = &c->members[c->movers[n]];
    if (m->is_skipped) continue;
    const nsvcd__dpose frame = nsvcd__frame_of_part(c, at, c->movers[n]);
    const nsvcd__bounds bounds = nsvcd__bounds_of(m, &frame);
    c->frames[m->row + k] = frame;
    c->bounds[m->row + k] = bounds;
    m->bounds = k ? nsvcd__bounds_over(&m->bounds, &bounds) : bounds;
    // a joint adds some 5e-16 of its moment arm
    const double arm = most + nsvcd__d3_norm(frame.position) + m->extent;
    m->rounding = nsvcd__max(k ? m->rounding : 0, rounding * arm);
  }
}

// Places the parts that move at c->times, one more than steps, and computes how far they deviate.
// If the caller says stop, not all of that is done.
static void nsvcd__sample(nsvcd_checker *c, const nsvcd_joint_motion *motion, size_t steps) {
  const size_t joints = c->scene->joint_count;
  nsvcd__step step;
  nsvcd__links *from = c->at;
  nsvcd__links *to = c->next;
  for (size_t n = 0; n < c->mover_count; n++) c->members[c->movers[n]].deviation = 0;
  nsvcd_motion_at(motion, joints, c->times[0], step.from);
  nsvcd__place_links(c, step.from, from);
  nsvcd__place_sample(c, from, 0);
  for (size_t k = 0; k < steps; k++) {
    if (k % NSVCD__STOP_SAMPLES + 1 == NSVCD__STOP_SAMPLES && c->stop && c->stop(c->user))
      return;
    nsvcd__step_of(motion, joints, c->times[k], c->times[k + 1], &step);
    nsvcd__place_links(c, step.to, to);
    nsvcd__place_sample(c, to, k + 1);
    for (size_t n = 0; n < c->mover_count; n++) {
      const size_t part = c->movers[n];
      nsvcd__member *m = &c->members[part];
      if (m->is_skipped) continue;
      const double most = nsvcd__part_deviation(c, part, &step, from, to) * (1 + 1e-9);
      c->deviations[m->row + k] = most;
      m->deviation = nsvcd__max(m->deviation, most);
    }
    nsvcd__links *other = from;
    from = to;
    to = other;
  }
}

// Cuts steps so that no part deviates by more than is allowed where it is near another, as far as
// can be foreseen: the deviation goes with the square of a step. Returns how many steps there are
// then; where they are more than NSVCD__MOST_STEPS, the times stay as they were.
static size_t nsvcd__refine_steps(nsvcd_checker *c, size_t steps, double allowed) {
  size_t total = 0;
  for (size_t k = 0; k < steps; k++) {
    const double cuts = ceil(sqrt(c->coarse[k] / allowed));
    if (!(cuts <= NSVCD__MOST_STEPS)) return NSVCD__MOST_STEPS + 1;
    total += cuts > 1 ? (size_t)cuts : 1;
  }
  if (total > NSVCD__MOST_STEPS) return total;
  size_t at = total;
  c->times[total] = c->times[steps];
  for (size_t k = steps; k-- > 0;) {
    const double cuts = nsvcd__max(ceil(sqrt(c->coarse[k] / allowed)), 1);
    const double from = c->times[k];
    const double duration = c->times[at] - from;
    for (size_t i = (size_t)cuts; i-- > 0;)
      c->times[--at] = from + duration * (double)i / cuts;
  }
  return total;
}

// A box about a part at both ends of a step; in between it goes no farther than it deviates.
static nsvcd__bounds nsvcd__bounds_in(const nsvcd_checker *c, size_t part, size_t step) {
  const nsvcd__member *m = &c->members[part];
  const nsvcd__bounds *at = c->bounds + m->row + step;
  return c->scene->parts[part].link ? nsvcd__bounds_over(at, at + 1) : m->bounds;
}

static double nsvcd__deviation_in(const nsvcd_checker *c, size_t part, size_t step) {
  return c->scene->parts[part].link ? c->deviations[c->members[part].row + step] : 0;
}

// The steps outside of which the boxes of a pair stay apart; none for a single configuration. And
// by how much the two can be off their sweeps in them, together, in the frames of the samples.
typedef struct nsvcd__step_range {
  size_t first, steps;
  double error;
} nsvcd__step_range;

// Where does a pair come as near as `kept`, by its boxes? Returns 0 if nowhere.
static int nsvcd__steps_near(const nsvcd_checker *c, const nsvcd_body_pair *pair, size_t steps,
                             double kept, nsvcd__step_range *range) {
  const nsvcd__member *a = &c->members[pair->a];
  const nsvcd__member *b = &c->members[pair->b];
  const double rounding = 2 * (a->rounding + b->rounding);
  const double room = (kept + rounding) * (1 + 1e-9);
  const double most = (a->deviation + b->deviation) * (1 + 1e-9);
  size_t last = 0;
  if (nsvcd__bounds_apart(&a->bounds, &b->bounds, room + most)) return 0;
  range->first = steps;
  for (size_t k = 0; k < steps; k++) {
    const nsvcd__bounds at_a = nsvcd__bounds_in(c, pair->a, k);
    const nsvcd__bounds at_b = nsvcd__bounds_in(c, pair->b, k);
    const double off = nsvcd__deviation_in(c, pair->a, k) + nsvcd__deviation_in(c, pair->b, k);
    if (nsvcd__bounds_apart(&at_a, &at_b, room + off * (1 + 1e-9))) continue;
    if (range->first == steps) range->first = k;
    last = k + 1;
  }
  range->error = 0;
  for (size_t k = range->first; k < last; k++) {
    const double off = nsvcd__deviation_in(c, pair->a, k) + nsvcd__deviation_in(c, pair->b, k);
    range->error = nsvcd__max(range->error, off);
  }
  range->error += rounding;
  range->steps = last - (steps ? range->first : 0);
  return steps == 0 || last > 0;
}

// The frames of a part from a sample on; of one that rests there is only one.
static const nsvcd__dpose *nsvcd__frames_at(const nsvcd_checker *c, size_t part,
                                            size_t sample) {
  const nsvcd__member *m = &c->members[part];
  return c->scene->parts[part].link ? c->frames + m->row + sample : &m->frame;
}
