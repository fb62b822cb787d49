// In: samples. Out: centres, and the samples nearest to each.
#pragma once
#include "samples.h"

#ifndef NSVCD_NO_ENCODER
// The squared distance of a point from a centre.
static float nsvcd__to_centre2(const nsvcd__patches *p, uint32_t centre, nsvcd__f3 at) {
  const nsvcd__f3 offset = nsvcd__f3_sub(p->centres[centre], at);
  return nsvcd__f3_dot(offset, offset);
}

// Lists the nearest other centres of each centre. A list that is not full ends in infinities.
// known: 1: there are lists from before the centres moved. What is in one of them is no farther
// than its farthest, so that few centres are taken in and put out again.
static void nsvcd__link_centres(nsvcd__patches *p, int known) {
  const size_t last = NSVCD__NEIGHBOURS - 1;
  const size_t count = p->count;
  float *all = p->greatest;
  for (uint32_t i = 0; i < count; i++) {
    const nsvcd__f3 own = p->centres[i];
    uint32_t *neighbours = p->neighbours + (size_t)i * NSVCD__NEIGHBOURS;
    float *quarters = p->quarter_squares + (size_t)i * NSVCD__NEIGHBOURS;
    for (size_t j = 0; j < count; j++) {
      const nsvcd__f3 offset = nsvcd__f3_sub(p->centres[j], own);
      all[j] = 0.25f * nsvcd__f3_dot(offset, offset);
    }
    all[i] = HUGE_VALF;
    float most = known ? 0 : HUGE_VALF;
    for (size_t k = 0; k <= last; k++) {
      if (known && all[neighbours[k]] > most) most = all[neighbours[k]];
      neighbours[k] = i;
      quarters[k] = HUGE_VALF;
    }
    for (uint32_t j = 0; j < count; j++) {
      const float quarter = all[j];
      if (quarter > most || quarter >= quarters[last]) continue;
      size_t k = last;
      for (; k > 0 && quarters[k - 1] > quarter; k--) {
        quarters[k] = quarters[k - 1];
        neighbours[k] = neighbours[k - 1];
      }
      quarters[k] = quarter;
      neighbours[k] = j;
    }
  }
}

// The centre nearest to a point; of equals the first. A centre that is twice as far from the guess
// as the point is cannot be nearer to the point (triangle inequality), so the guess's neighbours
// usually decide. Where they do not, the best of them is the next guess, or all centres are tried.
static uint32_t nsvcd__nearest_centre(const nsvcd__patches *p, uint32_t guess, nsvcd__f3 at) {
  uint32_t best = guess;
  float least = nsvcd__to_centre2(p, guess, at);
  for (int all = 0;;) {
    const uint32_t *neighbours = p->neighbours + (size_t)guess * NSVCD__NEIGHBOURS;
    const float *quarters = p->quarter_squares + (size_t)guess * NSVCD__NEIGHBOURS;
    const size_t most = all ? p->count : NSVCD__NEIGHBOURS;
    const float own = least;
    size_t k = 0;
    for (; k < most && (all || quarters[k] <= own); k++) {
      const uint32_t i = all ? (uint32_t)k : neighbours[k];
      const float square = nsvcd__to_centre2(p, i, at);
      if (square > least || (square >= least && i >= best)) continue;
      best = i;
      least = square;
    }
    if (all || k < most) return best;
    all = best == guess;
    guess = best;
  }
}

// Gives centre `to` those samples of centre `from` that are nearer to it.
static void nsvcd__give_nearer(nsvcd__patches *p, uint32_t from, uint32_t to) {
  uint32_t *left = p->lists + p->first_sample[from];
  uint32_t *taken = p->lists + p->first_sample[to];
  const nsvcd__f3 centre = p->centres[to];
  const uint32_t count = p->held[from];
  uint32_t kept = 0;
  uint32_t moved = p->held[to];
  p->greatest[from] = -1;
  for (uint32_t k = 0; k < count; k++) {
    const uint32_t s = left[k];
    const nsvcd__f3 offset = nsvcd__f3_sub(centre, p->drawn[s]);
    const float fresh = nsvcd__f3_dot(offset, offset);
    const float old = p->squares[s];
    const uint32_t nearer = fresh < old;
    const float square = nearer ? fresh : old;
    const uint32_t owner = nearer ? to : from;
    // no branch, which could not be predicted: the list that it is not added to goes on over it
    left[kept] = s;
    taken[moved] = s;
    kept += !nearer;
    moved += nearer;
    p->squares[s] = square;
    if (!(square > p->greatest[owner])) continue;
    p->greatest[owner] = square;
    p->farthest_sample[owner] = s;
  }
  p->held[from] = kept;
  p->held[to] = moved;
}

// Moves the lists of `count` centres together. Returns where the last one ends.
static uint32_t nsvcd__close_gaps(nsvcd__patches *p, uint32_t count) {
  uint32_t end = 0;
  for (uint32_t i = 0; i < count; i++) {
    const uint32_t *list = p->lists + p->first_sample[i];
    memmove(p->lists + end, list, p->held[i] * sizeof *list);
    p->first_sample[i] = end;
    end += p->held[i];
  }
  return end;
}

// Farthest point sampling (Gonzalez 1985). The first centre is the sample farthest from the mean.
// Ends early when every sample is at a centre.
static void nsvcd__farthest_points(nsvcd__patches *p) {
  const uint32_t samples = (uint32_t)p->sample_count;
  nsvcd__d3 sum = nsvcd__d3_of(0, 0, 0);
  for (size_t s = 0; s < samples; s++) sum = nsvcd__d3_add(sum, nsvcd__d3_widen(p->drawn[s]));
  p->centres[0] = nsvcd__d3_narrow(nsvcd__d3_over(sum, (double)samples));
  for (int pass = 0; pass < 2; pass++) {
    if (pass == 1) p->centres[0] = p->drawn[p->farthest_sample[0]];
    p->greatest[0] = -1;
    for (uint32_t s = 0; s < samples; s++) {
      p->lists[s] = s;
      p->squares[s] = nsvcd__to_centre2(p, 0, p->drawn[s]);
      if (!(p->squares[s] > p->greatest[0])) continue;
      p->greatest[0] = p->squares[s];
      p->farthest_sample[0] = s;
    }
  }
  p->first_sample[0] = 0;
  p->held[0] = samples;

  // of the last list
  uint32_t end = samples;
  uint32_t count = 1;
  for (; count < p->count; count++) {
    uint32_t farthest = 0;
    for (uint32_t i = 1; i < count; i++)
      if (p->greatest[i] > p->greatest[farthest]) farthest = i;
    if (!(p->greatest[farthest] > 0)) break;
    p->centres[count] = p->drawn[p->farthest_sample[farthest]];
    p->greatest[count] = -1;
    if (end > samples) end = nsvcd__close_gaps(p, count);
    p->first_sample[count] = end;
    p->held[count] = 0;
    for (uint32_t owner = 0; owner < count; owner++) {
      // An owner more than twice as far away as its farthest sample loses none (triangle
      // inequality). Most owners are that far away.
      const float square = nsvcd__to_centre2(p, owner, p->centres[count]);
      if (0.25f * square > p->greatest[owner]) continue;
      nsvcd__give_nearer(p, owner, count);
    }
    end += p->held[count];
  }
  p->count = count;
  for (uint32_t i = 0; i < count; i++) {
    const uint32_t *list = p->lists + p->first_sample[i];
    for (uint32_t k = 0; k < p->held[i]; k++) p->owners[list[k]] = (uint16_t)i;
  }
}

// Moves every centre to the mean of its samples, and drops centres that have none.
static void nsvcd__move_centres(nsvcd__patches *p) {
  memset(p->sums, 0, p->count * sizeof *p->sums);
  for (size_t s = 0; s < p->sample_count; s++) {
    nsvcd__patch_sum *sum = &p->sums[p->owners[s]];
    sum->vector = nsvcd__d3_add(sum->vector, nsvcd__d3_widen(p->drawn[s]));
    sum->weight += 1;
  }

  const size_t before = p->count;
  uint32_t kept = 0;
  for (size_t i = 0; i < before; i++) {
    const nsvcd__patch_sum *sum = &p->sums[i];
    // until samples are grouped: the new number of patch i
    p->offsets[i] = kept;
    if (!(sum->weight > 0)) continue;
    const nsvcd__d3 mean = nsvcd__d3_over(sum->vector, sum->weight);
    p->centres[kept++] = nsvcd__d3_narrow(mean);
  }
  for (size_t s = 0; s < p->sample_count; s++)
    p->owners[s] = (uint16_t)p->offsets[p->owners[s]];
  p->count = kept;
  nsvcd__link_centres(p, p->linked && kept == before);
  p->linked = 1;
}

// Extends a patch's reach to a point.
static void nsvcd__extend(nsvcd__patches *p, size_t patch, nsvcd__d3 at) {
  nsvcd__patch_sum *sum = &p->sums[patch];
  const double square = nsvcd__d3_distance2(at, nsvcd__d3_widen(p->centres[patch]));
  sum->greatest = nsvcd__max(sum->greatest, square);
}

// The square root, rounded up: a radius is never too small.
static float nsvcd__radius_above(double squared) {
  return (float)(sqrt(squared) * (1 + 4e-7));
}

static void nsvcd__measure_samples(nsvcd__patches *p) {
  memset(p->sums, 0, p->count * sizeof *p->sums);
  for (size_t s = 0; s < p->sample_count; s++)
    nsvcd__extend(p, p->owners[s], nsvcd__d3_widen(p->drawn[s]));
  for (size_t i = 0; i < p->count; i++)
    p->sample_radii[i] = nsvcd__radius_above(p->sums[i].greatest);
}

// Writes the samples patch by patch (counting sort).
static void nsvcd__group_samples(nsvcd__patches *p) {
  memset(p->offsets, 0, (p->count + 1) * sizeof *p->offsets);
  for (size_t s = 0; s < p->sample_count; s++) p->offsets[p->owners[s] + 1]++;
  for (size_t i = 0; i < p->count; i++) p->offsets[i + 1] += p->offsets[i];

  for (size_t s = 0; s < p->sample_count; s++) {
    const uint32_t owner = p->owners[s];
    // in the end each offset is the next patch's
    const size_t to = p->offsets[owner]++;
    p->samples[to] = p->drawn[s];
    p->normals[to] = p->drawn_normals[s];
  }
  memmove(p->offsets + 1, p->offsets, p->count * sizeof *p->offsets);
  p->offsets[0] = 0;
}
#endif  // NSVCD_NO_ENCODER
