// In: a question, and segments that have been chosen: of a motion, or of an interval of it. Out: do
// they meet; where asked, when first, and how near they come.
#pragma once
#include "../motion/choice.h"
#include "loop.h"

#ifndef NSVCD_NO_PROOF
// What is said of a component that is within the other body, whatever contacts were found since.
static nsvcd__finding nsvcd__found_inside(nsvcd__proof *p) {
  memset(&p->known.found, 0, sizeof p->known.found);
  p->known.found.point = p->enclosed;
  p->known.found.moving_triangle = NSVCD_NO_TRIANGLE;
  p->known.found.fixed_triangle = NSVCD_NO_TRIANGLE;
  return NSVCD__FOUND_INSIDE;
}

// Ticks: nothing meets before this, or NEVER.
static double nsvcd__clear_until(const nsvcd__proof *p) {
  if (p->unclear) return 0;
  return nsvcd__min(nsvcd__min(p->ask.end, p->known.unresolved),
                    p->known.lost ? p->known.resolved : NSVCD__NEVER);
}

// Makes a proof forget all that it knew of a motion, or of an interval.
static void nsvcd__proof_restart(nsvcd__proof *p) {
  memset(&p->known, 0, sizeof p->known);
  p->known.resolved = (double)p->ask.motion->from;
  p->ask.end = p->clipped_end = p->known.unresolved = NSVCD__NEVER;
  p->ask.unresolved_ends = 0;
  p->clipped = 0;
  p->arc.ticks = 0;
  p->count = p->fresh_count = p->misses = p->contact_count = 0;
  p->too_deep = 0;
  nsvcd__forget(&p->memo);
}

// Searches a motion whose segments have been chosen, and resolves what is found.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__prove_motion(nsvcd__proof *p,
                                                          nsvcd__search *search) {
  nsvcd__cut_segments(p->ask.motion, p->given.lengths, nsvcd__clearance(p), search);
  p->ask.first = p->ask.fraction * (double)p->ask.motion->ticks;
  const nsvcd__outcome outcome = nsvcd__prove_tiles(p, search);
  p->known.lost = outcome == NSVCD__EXHAUSTED;
  return outcome;
}

// The same, of any motion, whatever was known of one.
static nsvcd__outcome nsvcd__prove_anew(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__proof_restart(p);
  nsvcd__choose_segments(p->ask.motion, search);
  return nsvcd__prove_motion(p, search);
}

// The pose at the start of a motion, or at its end, as a motion of its own.
static nsvcd__motion nsvcd__end_of(const nsvcd__motion *motion, int at_end) {
  nsvcd__motion still = *motion;
  nsvcd__track moving = motion->moving;
  nsvcd__track fixed = motion->fixed;
  moving.poses += at_end ? moving.count - 1 : 0;
  fixed.poses += at_end ? fixed.count - 1 : 0;
  moving.count = fixed.count = 1;
  moving.times = fixed.times = NULL;
  still.begin = at_end ? 1 : 0;
  still.duration = 0;
  nsvcd__motion_set_tracks(&still, moving, fixed);
  return still;
}

// A look at the start alone, or at the end, which takes so many units at most: do triangles meet
// there? Then that is the contact that is known. If not, all that was known is lost.
static NSVCD__NOINLINE int nsvcd__meets_at(nsvcd__proof *p, nsvcd__search *search, int at_end,
                                           size_t units) {
  const nsvcd__asked asked = p->ask;
  nsvcd__motion still = nsvcd__end_of(asked.motion, at_end);
  p->ask.motion = &still;
  p->ask.fraction = 0;
  p->ask.limit = nsvcd__limit_after(p, units);
  p->ask.is_brief = 1;
  const int meets = nsvcd__prove_anew(p, search) == NSVCD__ANSWERED;
  p->known.found.tick = at_end ? (double)asked.motion->ticks : 0;
  p->ask = asked;
  p->ask.end = 0;
  return meets;
}

// Searches segments that have been chosen, first with a small budget: most queries end there. Many
// of the rest touch only at the start or at the end, so these two poses are tried before all is
// searched again. The search for a first contact begins at the start anyway, and of the intervals
// of a long motion the ends have been tried before.
static nsvcd__outcome nsvcd__prove_and_look(nsvcd__proof *p, nsvcd__search *search,
                                            size_t limit) {
  const int is_brief = !p->ask.motion->arcs && !(p->ask.fraction > 0);
  p->ask.is_brief = is_brief && p->work + NSVCD__LONG < limit;
  p->ask.limit = p->ask.is_brief ? p->work + NSVCD__LONG : limit;
  const nsvcd__outcome outcome = nsvcd__prove_motion(p, search);
  if (outcome != NSVCD__EXHAUSTED || !p->ask.is_brief) return outcome;
  // a part of what an unresolved pair leaves has been used
  if (p->known.unresolved < NSVCD__NEVER)
    p->ask.after_unresolved -= p->ask.after_unresolved / 2;
  for (int at_end = 0; at_end < 2; at_end++) {
    if (nsvcd__meets_at(p, search, at_end, NSVCD__END_BUDGET)) return NSVCD__ANSWERED;
  }
  p->ask.is_brief = 0;
  p->ask.limit = limit;
  return nsvcd__prove_anew(p, search);
}

// A part of the motion, from one place to another, in segments, and no later than `end`: where is
// the first contact there, or the first unresolved pair? All else that was known is lost. Ticks
// become finer: returns how many one is.
static double nsvcd__prove_part(nsvcd__proof *p, nsvcd__search *search, double from, double to,
                                double end) {
  nsvcd__proof_restart(p);
  nsvcd__choose_segments(p->ask.motion, search);
  const double finer = nsvcd__motion_refine(p->ask.motion);
  nsvcd__narrow_segments(search, from, to, finer);
  p->ask.end = nsvcd__min(p->ask.end, finer * end);
  p->ask.unresolved_ends = 1;
  (void)nsvcd__prove_motion(p, search);
  return finer;
}

// Adds what is known of a part of the motion, whose ticks are so much finer, to what was known of
// all before it. Returns until when, in ticks, it still matters.
static double nsvcd__add_part(const nsvcd__proof *p, const nsvcd__search *search, double finer,
                              double end, nsvcd__known *known) {
  const nsvcd__known *part = &p->known;
  const double last = (double)search->begin[search->segments];
  if (part->has_contact) {
    known->has_contact = 1;
    known->found = part->found;
    known->found.tick /= finer;
    end = p->ask.end / finer;
  }
  if (part->lost) return end;
  if (part->unresolved < NSVCD__NEVER) {
    known->unresolved_pair = part->unresolved_pair;
    known->unresolved_pair.tick /= finer;
    known->unresolved = part->unresolved / finer;
  }
  known->resolved = nsvcd__min(last, p->ask.end) / finer;
  return end;
}

// There was not work enough for the first contact: once more from what is resolved on, by time, a
// part of the motion after another. Where one takes too many units, a shorter one is tried.
static NSVCD__NOINLINE void nsvcd__prove_by_time(nsvcd__proof *p, nsvcd__search *search,
                                                 size_t limit) {
  nsvcd__known known = p->known;
  const double ticks = (double)p->ask.motion->ticks;
  const double all = (double)search->segments;
  double end = p->ask.end;
  double from = 0;
  double length = NSVCD__FIRST_PART;
  double grows = 4;
  size_t units = limit;
  while (from < all && (double)search->begin[(size_t)from + 1] <= known.resolved) from++;
  p->ask.is_brief = 1;
  while (p->work < limit &&
         known.resolved < nsvcd__min(ticks, nsvcd__min(end, known.unresolved))) {
    const size_t before = p->work;
    const double whole = floor(from + length);
    const double to = whole > from ? nsvcd__min(whole, all) : from + length;
    p->ask.limit = limit - before > units ? before + units : limit;
    const double finer = nsvcd__prove_part(p, search, from, to, end);
    end = nsvcd__add_part(p, search, finer, end, &known);
    if (p->known.lost) {
      length /= 8;
      grows = 2;
    } else {
      from = to;
      length *= grows;
      units = 8 * (p->work - before) + NSVCD__PART_BUDGET;
    }
  }
  known.lost = known.resolved < nsvcd__min(ticks, nsvcd__min(end, known.unresolved));
  p->ask.is_brief = 0;
  nsvcd__proof_restart(p);
  nsvcd__choose_segments(p->ask.motion, search);
  p->known = known;
  p->ask.end = end;
}

// When do they meet first? What is proven of that stays, also where there is no more work left.
static nsvcd__outcome nsvcd__prove_first(nsvcd__proof *p, nsvcd__search *search) {
  const nsvcd__outcome outcome = nsvcd__prove_and_look(p, search, nsvcd__limit_of_first(p));
  const double from = (double)p->ask.motion->from;
  // an interval is short: what is before it is known
  if (p->known.lost && !p->ask.motion->arcs) nsvcd__prove_by_time(p, search, p->ask.most);
  nsvcd__known known = p->known;
  const double end = p->ask.end;
  if (from > 0 && known.has_contact) {
    p->starts_free = 1;
  } else if (known.has_contact && nsvcd__clear_until(p) <= 0 && known.found.tick > 0) {
    // so early that they may meet at the start already
    if (nsvcd__meets_at(p, search, 0, p->given.work)) return NSVCD__ANSWERED;
    p->starts_free = !p->known.lost && !(p->known.unresolved < NSVCD__NEVER);
  }
  p->known = known;
  p->ask.end = end;
  return outcome;
}

// ---- the least distance

// Of the patches with a surface, the one whose centre is nearest to a place of the body's frame; of
// a large body one near it, found by going down the levels of spheres, always to the nearest.
static size_t nsvcd__patch_towards(const nsvcd__geometry *f, nsvcd__f3 position) {
  const nsvcd_body *body = f->body;
  size_t from = 0;
  size_t count = body->patches;
  size_t patch = 0;
  float least = HUGE_VALF;
  size_t k = nsvcd__is_large(body) ? nsvcd__level_count(body->padded) : 0;
  if (k > 0) count = nsvcd__level_of(body->padded, k - 1).count;
  while (k-- > 0) {
    const nsvcd__level level = nsvcd__level_of(body->padded, k);
    const nsvcd__spheres all =
        nsvcd__spheres_of(nsvcd__body_floats(body, level.first), level.slots);
    size_t nearest = from;
    float best = HUGE_VALF;
    for (size_t n = from; n < from + count && n < level.count; n++) {
      const nsvcd__f3 off = nsvcd__f3_sub(nsvcd__centre_of(all, n), position);
      const float distance = nsvcd__f3_length(off) - all.r[n];
      if (distance >= best) continue;
      best = distance;
      nearest = n;
    }
    from = NSVCD__GROUP * nearest;
    count = NSVCD__GROUP;
  }
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  for (size_t first = from; first < from + count; first += NSVCD__LANES) {
    float squares[NSVCD__LANES];
    uint32_t nearer = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 off =
          nsvcd__v3_sub(nsvcd__v3_centres(patches, first + l), nsvcd__v3_set(position));
      const nsvcd__v square = nsvcd__v3_dot(off, off);
      nearer |= nsvcd__v_lt(square, nsvcd__v_set(least)) << l;
      nsvcd__v_store(squares + l, square);
    }
    for (; nearer; nearer &= nearer - 1) {
      const size_t n = first + nsvcd__low_bit(nearer);
      if (n >= body->patches || f->hull_counts[n] == 0) continue;
      if (squares[n - first] >= least) continue;
      least = squares[n - first];
      patch = n;
    }
  }
  return patch;
}

// When the sphere of the moving body whose chords are search->group comes nearest to one of the
// fixed body, in ticks, if that is nearer than `gap`, metres, which becomes how near. Returns 1 if
// it is.
static int nsvcd__nearest_tick(const nsvcd__search *search, nsvcd__sphere fixed, float *gap,
                               double *tick) {
  int found = 0;
  for (size_t b = 0; NSVCD__LANES * b < search->segments; b++) {
    const nsvcd__chords *c = &search->group[b];
    float gaps[NSVCD__LANES], fraction[NSVCD__LANES];
    uint32_t nearer = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 travel = nsvcd__chords_travel(c, l);
      const nsvcd__v3 d =
          nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(fixed.centre));
      const nsvcd__v tau = nsvcd__v_clamp(
          nsvcd__v_mul(nsvcd__v3_dot(d, travel), nsvcd__v_load(c->inverse + l)), 0, 1);
      const nsvcd__v3 off = nsvcd__v3_fma(tau, travel, d);
      const nsvcd__v between =
          nsvcd__v_sub(nsvcd__v3_length(off), nsvcd__v_load(c->radius + l));
      nearer |= nsvcd__v_lt(between, nsvcd__v_set(*gap + fixed.radius)) << l;
      nsvcd__v_store(gaps + l, between);
      nsvcd__v_store(fraction + l, tau);
    }
    for (; nearer; nearer &= nearer - 1) {
      const size_t l = nsvcd__low_bit(nearer);
      const size_t s = NSVCD__LANES * b + l;
      if (s >= search->segments || !(gaps[l] - fixed.radius < *gap)) continue;
      *gap = gaps[l] - fixed.radius;
      *tick = (double)search->begin[s];
      *tick += (double)fraction[l] * ((double)search->begin[s + 1] - *tick);
      found = 1;
    }
  }
  return found;
}

// When two groups come nearest, in ticks, and which resting one that is; of large bodies, when the
// bodies do.
static double nsvcd__groups_nearest(const nsvcd__proof *p, nsvcd__search *search,
                                    nsvcd__sphere *resting) {
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  float gap = HUGE_VALF;
  double tick = 0;
  *resting = nsvcd__body_sphere(fixed);
  if (nsvcd__is_tiled(moving, fixed)) {
    nsvcd__chords_in_all(search, nsvcd__body_sphere(moving));
    (void)nsvcd__nearest_tick(search, *resting, &gap, &tick);
    return tick;
  }
  for (size_t g = 0; g < nsvcd__body_groups(moving); g++) {
    nsvcd__chords_in_all(search, nsvcd__sphere_of(nsvcd__groups_of(moving), g));
    for (size_t h = 0; h < nsvcd__body_groups(fixed); h++) {
      const nsvcd__sphere group = nsvcd__sphere_of(nsvcd__groups_of(fixed), h);
      if (nsvcd__nearest_tick(search, group, &gap, &tick)) *resting = group;
    }
  }
  return tick;
}

// The least distance between the hulls' vertices of patch i of the moving body and patch j of the
// fixed one.
static double nsvcd__vertices_apart(const nsvcd__proof *p, const nsvcd__transform *pose,
                                    size_t i, size_t j) {
  float lanes[3][NSVCD__LANES];
  float least = HUGE_VALF;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 moving = nsvcd__hull_of(&p->moving, i, l);
    nsvcd__v3_store(lanes, l, nsvcd__v3_transform(pose, moving));
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 fixed = nsvcd__hull_of(&p->fixed, j, l);
    for (size_t n = 0; n < NSVCD__LANES; n++) {
      const nsvcd__v3 d = nsvcd__v3_sub(fixed, nsvcd__v3_set(nsvcd__lane_of(lanes, n)));
      least = nsvcd__least_of(least, nsvcd__v3_dot(d, d));
    }
  }
  return sqrt((double)least);
}

// How near the bodies come for certain, and a little more: the least distance between the vertices
// of two patches, when and where these are nearest to each other. They are found in turns: which
// are the nearest at a time, and when they are nearest. Where `measure` begins. If that is within
// the clearance, triangles of these patches are a contact, which is looked for there.
static NSVCD__NOINLINE double nsvcd__guess_clearance(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__sphere moving = nsvcd__body_sphere(p->moving.body);
  nsvcd__sphere fixed;
  // they may not have been: bodies that never come near are told apart without
  nsvcd__cut_segments(p->ask.motion, p->given.lengths, 0, search);
  double tick = nsvcd__groups_nearest(p, search, &fixed);
  double least = HUGE_VAL;
  double fraction = 0;
  uint32_t from = 0;
  size_t nearest[2] = {0, 0};
  for (size_t turn = 0; turn < NSVCD__TURNS; turn++) {
    double u;
    if (turn > 0) {
      float gap = HUGE_VALF;
      nsvcd__chords_in_all(search, moving);
      (void)nsvcd__nearest_tick(search, fixed, &gap, &tick);
    }
    const uint32_t first = nsvcd__arc_of(p->ask.motion, tick, &u);
    const nsvcd__dtransform at = nsvcd__dtransform_at(nsvcd__arc_at(p, first), u);
    const nsvcd__transform pose = nsvcd__transform_of(&at);
    const nsvcd__dtransform back = nsvcd__inverse_dtransform(&at, p->arc.scale);
    size_t i = 0;
    size_t j = 0;
    for (size_t round = 0; round < 2; round++) {
      const nsvcd__d3 seen = nsvcd__d3_transform(&back, nsvcd__d3_widen(fixed.centre));
      i = nsvcd__patch_towards(&p->moving, nsvcd__f3_round(seen));
      moving = nsvcd__sphere_of(nsvcd__body_patches(p->moving.body), i);
      j = nsvcd__patch_towards(&p->fixed, nsvcd__f3_transform(&pose, moving.centre));
      fixed = nsvcd__sphere_of(nsvcd__body_patches(p->fixed.body), j);
    }
    const float lengths = p->given.lengths + nsvcd__f3_length(pose.position);
    const double rounding =
        (double)(4 * NSVCD__ROUNDING * lengths + 2 * nsvcd__errors_of(p, i, j));
    const double apart = 1.0001 * nsvcd__vertices_apart(p, &pose, i, j) + rounding;
    if (!(apart < least)) continue;
    least = apart;
    fraction = u;
    from = first;
    nearest[0] = i;
    nearest[1] = j;
  }
  if (!(least <= p->given.clearance)) return least;
  p->ask.clearance = least;
  p->ask.limit = p->work + NSVCD__END_BUDGET;
  (void)nsvcd__find_witness(p, nearest[0], nearest[1], from, fraction);
  return p->known.has_contact ? p->known.found.distance : least;
}

// One pass: a search whose question shrinks, for a bracket as narrow as p->ask.measure. What was
// known stays known, and what is found is added. Returns whether there was work enough; if so, they
// come no nearer than p->low.
static int nsvcd__measure_once(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__known known = p->known;
  const int is_named = known.has_contact || known.unresolved < NSVCD__NEVER;
  p->ask.clearance = is_named ? nsvcd__max(p->low, p->high - p->ask.measure) : p->high;
  nsvcd__proof_restart(p);
  const nsvcd__outcome pass = nsvcd__prove_motion(p, search);
  if (p->known.has_contact) {
    known.has_contact = 1;
    known.found = p->known.found;
  }
  p->known = known;
  if (pass != NSVCD__EXHAUSTED) p->low = p->ask.clearance;
  return pass != NSVCD__EXHAUSTED;
}

// Makes the bracket as narrow as `finest`. Where half of the work is not enough for that, the rest
// goes to brackets that get narrower and narrower: the last one that there was work enough for
// stays.
static void nsvcd__narrow(nsvcd__proof *p, nsvcd__search *search, double finest) {
  p->ask.measure = finest;
  p->ask.limit = nsvcd__limit_after(p, p->given.work / 2);
  if (nsvcd__measure_once(p, search)) return;
  p->ask.limit = p->ask.most;
  p->ask.measure = p->high - p->low;
  while (!p->wide && p->ask.measure > finest) {
    p->ask.measure = nsvcd__max(finest, p->ask.measure / NSVCD__FINER);
    p->wide = !nsvcd__measure_once(p, search);
  }
}
#endif  // NSVCD_NO_PROOF
