// In: a motion of the joints. Out: does it seem free? An opinion, by nsvcd_look, at places on it.
//
// 16 configurations are looked at together, spread over the motion, the first batches far apart.
// Links are placed in all of them side by side, in float, with each joint's axis along z. A pair is
// looked at where the boxes about its parts overlap, and the one that met last comes first.
#pragma once
#include "../interface/looks.h"
#include "check.h"

// radians or metres between the places of a motion
#define NSVCD__LOOK_STEP 0.05
// metres by which a pair's margin is less at each look, where the ends, proven free, seem to meet
#define NSVCD__LOOK_CUT 1e-3f

// A frame in that of a link: a matrix, row-major, and an offset.
typedef struct nsvcd__look_frame {
  float turn[9], offset[3];
} nsvcd__look_frame;

// A part, as looks have it.
typedef struct nsvcd__look_part {
  nsvcd__look_frame frame;
  // a sphere about it, in its link
  float centre[3], radius;
  // of the places at hand, or of a part that rests
  float low[3], high[3];
  // metres: the error of its balls; 0: it has none, or is a box
  float error;
  // where its places are, if it moves; are they those of the batch at hand?
  nsvcd_places *places;
  int is_placed;
} nsvcd__look_part;

typedef struct nsvcd__looker {
  const nsvcd_checker *checker;
  // whose `stop` ends looks
  const nsvcd_check_options *options;
  // (F): each joint in the link that it is on, turned so that axes are along z
  nsvcd__look_frame *joints;
  // (F, 16): configurations that are looked at
  double (*places)[NSVCD_LOOKS];
  // (F + 1)
  nsvcd_places *links;
  // (B)
  nsvcd__look_part *parts;
  // (P): metres, as nsvcd_look_options has it
  float *margins;
  // of a part that rests
  nsvcd_places resting;
  // the pair that met last; scene->pair_count: none yet
  size_t last;
  // motions that were looked at
  size_t count;
} nsvcd__looker;

// ---- where everything is

// A rotation that takes z to an axis.
static nsvcd__dmat3 nsvcd__look_axes(nsvcd__d3 axis) {
  const nsvcd__d3 helper = fabs(axis.x) < 0.6 ? nsvcd__d3_of(1, 0, 0) : nsvcd__d3_of(0, 1, 0);
  const nsvcd__d3 x = nsvcd__d3_unit(nsvcd__d3_cross(helper, axis), helper);
  const nsvcd__d3 y = nsvcd__d3_cross(axis, x);
  const nsvcd__dmat3 out = {nsvcd__d3_of(x.x, y.x, axis.x), nsvcd__d3_of(x.y, y.y, axis.y),
                            nsvcd__d3_of(x.z, y.z, axis.z)};
  return out;
}

// A frame of a link as its turned axes see it, with axes of its own. before: of the link.
static nsvcd__look_frame nsvcd__look_frame_of(const nsvcd__dmat3 *before,
                                              const nsvcd__dpose *frame,
                                              const nsvcd__dmat3 *own) {
  const nsvcd__dmat3 turn = nsvcd__dmat3_of(frame->rotation);
  const nsvcd__d3 *rows[3] = {&before->x, &before->y, &before->z};
  const nsvcd__d3 *of_turn[3] = {&turn.x, &turn.y, &turn.z};
  nsvcd__look_frame out;
  memset(&out, 0, sizeof out);
  for (size_t i = 0; i < 3; i++) {
    // row i of the transpose of `before`, times the matrix
    nsvcd__d3 row = {0, 0, 0};
    double offset = 0;
    for (size_t k = 0; k < 3; k++) {
      const double factor = nsvcd__d3_axis(*rows[k], i);
      row = nsvcd__d3_fma(factor, *of_turn[k], row);
      offset += factor * nsvcd__d3_axis(frame->position, k);
    }
    out.offset[i] = (float)offset;
    for (size_t k = 0; k < 3; k++)
      out.turn[3 * i + k] =
          (float)(row.x * nsvcd__d3_axis(own->x, k) + row.y * nsvcd__d3_axis(own->y, k) +
                  row.z * nsvcd__d3_axis(own->z, k));
  }
  return out;
}

// out = x rows[0] + y rows[1] + z rows[2] + base, of 16 numbers each. In a copy of its own, so that
// compilers need not ask whether rows overlap, and vectorize it.
static void nsvcd__look_mix(const float (*rows)[NSVCD_LOOKS], float x, float y, float z,
                            const float *base, float *out) {
  float sums[NSVCD_LOOKS];
  for (size_t l = 0; l < NSVCD_LOOKS; l++)
    sums[l] = rows[0][l] * x + rows[1][l] * y + rows[2][l] * z + base[l];
  memcpy(out, sums, sizeof sums);
}

// A frame in 16 places of a link.
static void nsvcd__look_carry(const nsvcd_places *link, const nsvcd__look_frame *frame,
                              nsvcd_places *out) {
  static const float zeros[NSVCD_LOOKS] = {0};
  const float *turn = frame->turn;
  const float *offset = frame->offset;
  for (size_t i = 0; i < 3; i++) {
    const float(*from)[NSVCD_LOOKS] = (const float(*)[NSVCD_LOOKS])(link->rotation + 3 * i);
    float *at = out->position[i];
    for (size_t k = 0; k < 3; k++) {
      float *row = out->rotation[3 * i + k];
      nsvcd__look_mix(from, turn[k], turn[3 + k], turn[6 + k], zeros, row);
    }
    nsvcd__look_mix(from, offset[0], offset[1], offset[2], link->position[i], at);
  }
}

// Sines and cosines of 16 angles, within 1e-6.
static void nsvcd__look_angles(const double *angles, float *sines, float *cosines) {
  for (size_t l = 0; l < NSVCD_LOOKS; l++) {
    const double turns = angles[l] * 0.6366197723675814;
    const int quarter = (int)(turns < 0 ? turns - 0.5 : turns + 0.5);
    const float x = (float)(angles[l] - 1.5707963267948966 * quarter);
    const float y = x * x;
    const float s = x + x * y * (-1.6666655e-1f + y * (8.3321609e-3f - y * 1.9515296e-4f));
    const float c =
        1 - 0.5f * y + y * y * (4.1666646e-2f + y * (-1.3887316e-3f + y * 2.4433157e-5f));
    const int swaps = quarter & 1;
    const float sine = swaps ? c : s;
    const float cosine = swaps ? s : c;
    sines[l] = quarter & 2 ? -sine : sine;
    cosines[l] = (quarter + 1) & 2 ? -cosine : cosine;
  }
}

// Places the links. joints: (F, 16).
static void nsvcd__look_place_links(nsvcd__looker *k, double (*joints)[NSVCD_LOOKS]) {
  const nsvcd_scene *scene = k->checker->scene;
  for (size_t j = 0; j < scene->joint_count; j++) {
    nsvcd_places *link = &k->links[j + 1];
    float sines[NSVCD_LOOKS], cosines[NSVCD_LOOKS];
    nsvcd__look_carry(&k->links[scene->joints[j].parent], &k->joints[j], link);
    if (scene->joints[j].kind == NSVCD_JOINT_PRISMATIC) {
      for (size_t i = 0; i < 3; i++)
        for (size_t l = 0; l < NSVCD_LOOKS; l++)
          link->position[i][l] += (float)joints[j][l] * link->rotation[3 * i + 2][l];
      continue;
    }
    nsvcd__look_angles(joints[j], sines, cosines);
    for (size_t i = 0; i < 3; i++) {
      float *x = link->rotation[3 * i];
      float *y = link->rotation[3 * i + 1];
      float turned[2][NSVCD_LOOKS];
      for (size_t l = 0; l < NSVCD_LOOKS; l++) {
        turned[0][l] = cosines[l] * x[l] + sines[l] * y[l];
        turned[1][l] = cosines[l] * y[l] - sines[l] * x[l];
      }
      memcpy(x, turned[0], sizeof turned[0]);
      memcpy(y, turned[1], sizeof turned[1]);
    }
  }
  for (size_t n = 0; n < scene->part_count; n++) {
    nsvcd__look_part *part = &k->parts[n];
    const nsvcd_places *link = &k->links[scene->parts[n].link];
    if (!part->places) continue;
    part->is_placed = 0;
    for (size_t i = 0; i < 3; i++) {
      const float(*from)[NSVCD_LOOKS] = (const float(*)[NSVCD_LOOKS])(link->rotation + 3 * i);
      const float *centre = part->centre;
      float x[NSVCD_LOOKS];
      nsvcd__look_mix(from, centre[0], centre[1], centre[2], link->position[i], x);
      float low = x[0];
      float high = x[0];
      for (size_t l = 1; l < NSVCD_LOOKS; l++) {
        low = x[l] < low ? x[l] : low;
        high = x[l] > high ? x[l] : high;
      }
      part->low[i] = low - part->radius;
      part->high[i] = high + part->radius;
    }
  }
}

// ---- a looker

// Takes a looker's arrays from a workspace, or only counts them.
static void nsvcd__looker_take(const nsvcd_scene *scene, char *base, uint64_t *used,
                               nsvcd__looker *k) {
  const size_t pairs = scene->pair_count;
  k->joints = NSVCD__TAKE_ROWS(nsvcd__look_frame, scene->joint_count, base, used);
  k->places = (double(*)[NSVCD_LOOKS])nsvcd__take(base, used, scene->joint_count,
                                                  NSVCD_LOOKS * sizeof(double));
  k->links = NSVCD__TAKE_ROWS(nsvcd_places, scene->joint_count + 1, base, used);
  k->parts = NSVCD__TAKE_ROWS(nsvcd__look_part, scene->part_count, base, used);
  k->margins = NSVCD__TAKE_ROWS(float, pairs, base, used);
  if (base) memset(k->parts, 0, scene->part_count * sizeof *k->parts);
  for (size_t n = 0; n < scene->part_count; n++) {
    if (!scene->parts[n].link) continue;
    nsvcd_places *places = NSVCD__TAKE_ROWS(nsvcd_places, 1, base, used);
    if (base) k->parts[n].places = places;
  }
}

static void nsvcd__identity_places(nsvcd_places *places) {
  memset(places, 0, sizeof *places);
  for (size_t l = 0; l < NSVCD_LOOKS; l++)
    for (size_t i = 0; i < 3; i++) places->rotation[4 * i][l] = 1;
}

// The axes of a link: those of the joint that carries it; of the world, its own.
static nsvcd__dmat3 nsvcd__look_axes_of(const nsvcd_checker *c, size_t link) {
  const nsvcd__dmat3 world = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return link ? nsvcd__look_axes(c->links[link - 1].axis) : world;
}

// Fills in a looker whose arrays are taken.
static void nsvcd__looker_begin(nsvcd_checker *c, const nsvcd_check_options *options,
                                nsvcd__looker *k) {
  const nsvcd_scene *scene = c->scene;
  const nsvcd__dmat3 ones = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  k->checker = c;
  k->options = options;
  k->last = scene->pair_count;
  nsvcd__identity_places(&k->links[0]);
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd__dmat3 before = nsvcd__look_axes_of(c, scene->joints[j].parent);
    const nsvcd__dmat3 own = nsvcd__look_axes_of(c, j + 1);
    k->joints[j] = nsvcd__look_frame_of(&before, &c->links[j].origin, &own);
  }
  for (size_t n = 0; n < scene->part_count; n++) {
    const nsvcd__member *m = &c->members[n];
    nsvcd__look_part *part = &k->parts[n];
    const nsvcd__dmat3 before = nsvcd__look_axes_of(c, scene->parts[n].link);
    const nsvcd__dpose centre = {{0, 0, 0, 1}, m->centre};
    const nsvcd__look_frame at = nsvcd__look_frame_of(&before, &centre, &ones);
    part->frame = nsvcd__look_frame_of(&before, &m->frame, &ones);
    memcpy(part->centre, at.offset, sizeof part->centre);
    part->radius = 1.00001f * (float)(m->radius + m->round);
    part->error = (float)m->ball_error;
    nsvcd__f3_store(nsvcd__f3_round(m->bounds.low), part->low);
    nsvcd__f3_store(nsvcd__f3_round(m->bounds.high), part->high);
  }
}

// Are there balls about all that moves? Else looks would find too little free.
static int nsvcd__can_look(const nsvcd_checker *c) {
  int can = c->scene->pair_count > 0;
  for (size_t n = 0; n < c->scene->part_count; n++)
    can &= !c->scene->parts[n].link || c->members[n].balls > 0;
  return can;
}

// ---- looks

static nsvcd_looked nsvcd__look_at_part(nsvcd__looker *k, size_t n) {
  const nsvcd_part *part = &k->checker->scene->parts[n];
  nsvcd__look_part *seen = &k->parts[n];
  nsvcd_places *places = seen->places ? seen->places : &k->resting;
  const nsvcd_looked out = {part->body, part->scale, places};
  if (!seen->places || !seen->is_placed) {
    nsvcd__look_carry(&k->links[part->link], &seen->frame, places);
    seen->is_placed = 1;
  }
  return out;
}

// Does a pair seem to meet in one of the places at hand?
static int nsvcd__pair_seems_to_meet(nsvcd__looker *k, size_t pair) {
  const nsvcd_body_pair *parts = &k->checker->scene->pairs[pair];
  const nsvcd__look_part *a = &k->parts[parts->a];
  const nsvcd__look_part *b = &k->parts[parts->b];
  const nsvcd_look_options options = {k->margins[pair], 1};
  uint32_t met = 0;
  for (size_t i = 0; i < 3; i++) {
    if (a->low[i] - options.margin > b->high[i] || b->low[i] - options.margin > a->high[i])
      return 0;
  }
  const nsvcd_looked first = nsvcd__look_at_part(k, parts->a);
  const nsvcd_looked second = nsvcd__look_at_part(k, parts->b);
  // what cannot be looked at seems to meet
  if (nsvcd_look(&first, &second, &options, &met)) return 1;
  return met != 0;
}

// Does anything seem to meet in 16 configurations? joints: (F, 16).
static int nsvcd__seems_to_meet(nsvcd__looker *k, double (*joints)[NSVCD_LOOKS]) {
  const size_t pairs = k->checker->scene->pair_count;
  nsvcd__look_place_links(k, joints);
  if (k->last < pairs && nsvcd__pair_seems_to_meet(k, k->last)) return 1;
  for (size_t n = 0; n < pairs; n++) {
    if (n == k->last || !nsvcd__pair_seems_to_meet(k, n)) continue;
    k->last = n;
    return 1;
  }
  return 0;
}

// Where the joints are in 16 places of a motion, at fractions of its time: (n + l batches) / (16
// batches).
static void nsvcd__look_joints(const nsvcd_joint_motion *m, size_t joints, size_t n,
                               size_t batches, double (*out)[NSVCD_LOOKS]) {
  const double first = nsvcd__piece_start(m, 0);
  const double whole = nsvcd__piece_start(m, m->pieces) - first;
  const double all = (double)(batches * NSVCD_LOOKS);
  double at[NSVCD_MAX_JOINTS];
  for (size_t j = 0; j < joints && m->pieces == 1 && m->degree == 1; j++) {
    const double from = m->points[j];
    const double step = (m->points[joints + j] - from) / all;
    for (size_t l = 0; l < NSVCD_LOOKS; l++)
      out[j][l] = from + step * (double)(int)(n + l * batches);
  }
  for (size_t l = 0; l < NSVCD_LOOKS && (m->pieces > 1 || m->degree > 1); l++) {
    const double time = first + whole * (double)(n + l * batches) / all;
    nsvcd__joints_at_time(m, joints, time, at, NULL);
    for (size_t j = 0; j < joints; j++) out[j][l] = at[j];
  }
}

static int nsvcd__looks_end(const nsvcd__looker *k) {
  return k->options->stop && k->options->stop(k->options->user);
}

// Does a motion seem free? It begins where it is known to be, and is within the limits.
static int nsvcd__seems_free(nsvcd__looker *k, const nsvcd_joint_motion *m) {
  const size_t joints = k->checker->scene->joint_count;
  const size_t rows = m->pieces * m->degree;
  double length = 0;
  k->count++;
  for (size_t n = 0; n < rows; n++) {
    const double *from = m->points + n * joints;
    length += sqrt(nsvcd__distance2(from, from + joints, joints));
  }
  const double wanted = length / (NSVCD__LOOK_STEP * NSVCD_LOOKS);
  const size_t batches = wanted < 1 ? 1 : (size_t)nsvcd__min(ceil(wanted), 4096);
  size_t stride = 1;
  while (2 * stride <= batches) stride *= 2;
  // batch n has the places n, n + batches, ... of all; the greater steps first
  for (; stride > 0; stride /= 2) {
    for (size_t n = stride; n <= batches; n += 2 * stride) {
      if (nsvcd__looks_end(k)) return 0;
      nsvcd__look_joints(m, joints, n, batches, k->places);
      if (nsvcd__seems_to_meet(k, k->places)) return 0;
    }
  }
  return 1;
}

// Sets the margins of all pairs. Balls about two parts are taken without their errors, so that no
// meeting is invented; about one, less by a fraction of them. clearance: beside the scene's.
static void nsvcd__set_margins(nsvcd__looker *k, float clearance, float fraction) {
  const nsvcd_scene *scene = k->checker->scene;
  for (size_t n = 0; n < scene->pair_count; n++) {
    const float a = k->parts[scene->pairs[n].a].error;
    const float b = k->parts[scene->pairs[n].b].error;
    const float kept = clearance + (scene->clearances ? scene->clearances[n] : 0);
    k->margins[n] = kept - (a > 0 && b > 0 ? 1 : fraction) * (a + b);
  }
}

// Lessens margins until nothing seems to meet in a configuration that is proven free.
static void nsvcd__look_past(nsvcd__looker *k, const double *at) {
  for (size_t j = 0; j < k->checker->scene->joint_count; j++)
    for (size_t l = 0; l < NSVCD_LOOKS; l++) k->places[j][l] = at[j];
  while (!nsvcd__looks_end(k) && nsvcd__seems_to_meet(k, k->places) &&
         k->margins[k->last] > -1)
    k->margins[k->last] -= NSVCD__LOOK_CUT;
}
