// sampler.h - a motion at discrete times, as those methods of the benchmark are asked that know no other.
//
// In:  poses, a method (method.h). Out: whether it hits at any of so many evenly spaced times.
//
// Include arrays.h and the library's implementation first: between poses it is the library that slerps.
#ifndef NSVCD_BENCH_SAMPLER_H
#define NSVCD_BENCH_SAMPLER_H

#include <math.h>
#include <string.h>

#include "method.h"

#define SAMPLER_MOST 256

// The motion at `count` evenly spaced times, in the fixed body's frame, in the order of visiting:
// both ends, the middle, the quarters and so on, so that a collision is found early. Writes
// placements [first, last) of that order.
typedef struct sampler {
  const nsvcd_pose *poses;
  size_t pose_count, count;
  float to_fixed[9], origin[3];
  const uint16_t *order;  // (count)
} sampler;

static void order_of_visiting(size_t count, uint16_t *order) {
  size_t n = 0;
  size_t step = 1;
  unsigned char seen[SAMPLER_MOST] = {0};
  order[n++] = 0;
  seen[0] = 1;
  if (count > 1) {
    order[n++] = (uint16_t)(count - 1);
    seen[count - 1] = 1;
  }
  while (step < count) step *= 2;
  for (; step > 0; step /= 2)
    for (size_t i = step; i < count; i += 2 * step)
      if (!seen[i]) seen[i] = 1, order[n++] = (uint16_t)i;
}

static void start_sampler(sampler *s, const nsvcd_pose *poses, size_t pose_count,
                          const nsvcd_pose *fixed, size_t count, const uint16_t *order) {
  float m[9];
  s->poses = poses;
  s->pose_count = pose_count;
  s->count = count;
  s->order = order;
  matrix_of_quat(fixed->rotation, m);
  transpose33(m, s->to_fixed);
  memcpy(s->origin, fixed->position, sizeof s->origin);
}

static void sample(const sampler *s, size_t first, size_t last, transform *out) {
  float segments = (float)(s->pose_count - 1);
  float m[9];
  float p[3];
  float q[4];
  for (size_t i = first; i < last; i++) {
    float at = s->count > 1 ? segments * (float)s->order[i] / (float)(s->count - 1) : 0;
    size_t k = (size_t)at < s->pose_count - 1 ? (size_t)at : s->pose_count - 1;
    size_t next = k + 1 < s->pose_count ? k + 1 : k;
    float u = at - (float)k;
    float dot = 0;
    float v;
    float length = 0;
    const nsvcd_pose *a = &s->poses[k];
    const nsvcd_pose *b = &s->poses[next];
    for (int j = 0; j < 4; j++) dot += a->rotation[j] * b->rotation[j];
    v = dot < 0 ? -u : u;
    for (int j = 0; j < 4; j++) {
      q[j] = (1 - u) * a->rotation[j] + v * b->rotation[j];
      length += q[j] * q[j];
    }
    // Between samples less than 5 degrees apart the straight line strays from the slerp by less
    // than 1e-5 radians.
    if (fabsf(dot) < 0.999f) {
      const nsvcd__quat from = nsvcd__quat_load(a->rotation);
      const nsvcd__quat to = nsvcd__quat_load(b->rotation);
      nsvcd__quat_store(nsvcd__quat_slerp(from, to, u), q);
      length = 1;
    }
    for (int j = 0; j < 4; j++) q[j] /= sqrtf(length);
    for (int j = 0; j < 3; j++) p[j] = (1 - u) * a->position[j] + u * b->position[j] - s->origin[j];
    matrix_of_quat(q, m);
    mul33(s->to_fixed, m, out[i].rotation);
    mul33_vec(s->to_fixed, p, out[i].position);
  }
}

// Placements are made in growing portions: a collision found early spares the rest.
static int sweep_discrete(const method *m, const void *moving, const void *fixed, const sampler *s,
                          float activation) {
  transform at[SAMPLER_MOST];
  for (size_t done = 0, portion = 4; done < s->count; portion *= 2) {
    size_t end = done + portion < s->count ? done + portion : s->count;
    sample(s, done, end, at);
    if (m->hits(moving, fixed, at + done, end - done, activation)) return 1;
    done = end;
  }
  return 0;
}

#endif  // NSVCD_BENCH_SAMPLER_H
