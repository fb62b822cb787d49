// The logit of one pair of patches, or its distance, as a function of the moving body's poses, in double, written
// anew from the conventions in neuralsvcd.h and not from its code: what nsvcd_sweep_gradient
// differentiates, by its contract. The pair, the segments in which its spheres meet and part, the
// head, the spheres' allowance and the unit of length are those of a query in float; contact,
// instants, invariants and head follow the poses. Include after neuralsvcd.h with its
// implementation.
#ifndef GRADIENT_REFERENCE_H
#define GRADIENT_REFERENCE_H

#include <math.h>
#include <string.h>

#define REFERENCE_POSES 40

typedef struct reference_pose {
  double position[3], rotation[4];  // as nsvcd_pose, but from the fixed body's origin
} reference_pose;

typedef struct reference_pair {
  double c1[3], c2[3], r1, r2, unit;  // centres, each in its body's axes; radii
  double z1[NSVCD__LATENT], z2[NSVCD__LATENT];
  // each in its body's axes: unit normals, or 0; tips from the centres, metres
  double n1[3], n2[3], flat1, flat2, tips1[NSVCD__EXTREMES][3], tips2[NSVCD__EXTREMES][3];
  double to_fixed[9];
  // in which the spheres meet, and part: from, to; the distance at which they do
  double segment[2][2], reach[2];
  const nsvcd__decoder *head;
  size_t output;  // of the head
  size_t count;
  const float *times;  // of the poses, or NULL
  const float *pivot;  // of the moving body's axes, metres
} reference_pair;

static double reference_dot(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static double reference_length(const double *a) {
  return sqrt(reference_dot(a, a));
}
static void reference_cross(const double *a, const double *b, double *out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}
static void reference_mul(const double *m, const double *x, double *out) {  // (3, 3) (3)
  for (int i = 0; i < 3; i++) out[i] = reference_dot(m + 3 * i, x);
}
static void reference_mul33(const double *a, const double *b, double *out) {
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++)
      out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  }
}
static void reference_quat_mul(const double *a, const double *b, double *out) {
  double v[3];
  reference_cross(a, b, v);
  const double real = a[3] * b[3] - reference_dot(a, b);
  for (int k = 0; k < 3; k++) out[k] = v[k] + a[3] * b[k] + b[3] * a[k];
  out[3] = real;
}
static void reference_matrix(const double *q, double *m) {  // q: of any length
  const double s = 2 / (reference_dot(q, q) + q[3] * q[3]);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++)
      m[3 * i + j] = (i == j ? 1 - s * reference_dot(q, q) : 0) + s * q[i] * q[j];
  }
  m[1] -= s * q[3] * q[2];
  m[2] += s * q[3] * q[1];
  m[3] += s * q[3] * q[2];
  m[5] -= s * q[3] * q[0];
  m[6] -= s * q[3] * q[1];
  m[7] += s * q[3] * q[0];
}

// exp of half the rotation vector, then q.
static void reference_turn(const double *by, const double *q, double *out) {
  const double angle = reference_length(by);
  const double ratio = angle > 0 ? sin(angle / 2) / angle : 0.5;
  const double step[4] = {ratio * by[0], ratio * by[1], ratio * by[2], cos(angle / 2)};
  double turned[4];
  reference_quat_mul(step, q, turned);
  memcpy(out, turned, sizeof turned);
}

// The moving body at time t: rotation (3, 3), quaternion, position; the fixed body's axes.
static void reference_at(const reference_pair *pair, const reference_pose *poses, double t,
                         double *q, double *m, double *p) {
  const size_t arcs = pair->count - 1;
  const float *times = pair->times;
  size_t k = arcs == 0                             ? 0
             : t * (double)arcs < (double)arcs - 1 ? (size_t)(t * (double)arcs)
                                                   : arcs - 1;
  double u = t * (double)arcs - (double)k;
  if (times) {
    for (k = 0; k + 1 < arcs && t >= (double)times[k + 1];) k++;
    u = (t - (double)times[k]) / ((double)times[k + 1] - (double)times[k]);
  }
  const reference_pose *a = &poses[k];
  const reference_pose *b = arcs ? a + 1 : a;
  double step[4];
  double inverse[4] = {-a->rotation[0], -a->rotation[1], -a->rotation[2], a->rotation[3]};
  double along[3];
  double world[9];
  reference_quat_mul(b->rotation, inverse, step);
  const double sine = reference_length(step);
  const double sign = step[3] < 0 ? -1 : 1;
  const double angle = 2 * atan2(sine, sign * step[3]);
  for (int i = 0; i < 3; i++) along[i] = sine > 0 ? u * angle * sign * step[i] / sine : 0;
  reference_turn(along, a->rotation, q);
  reference_matrix(q, world);
  reference_mul33(pair->to_fixed, world, m);
  const double own[3] = {(double)pair->pivot[0], (double)pair->pivot[1], (double)pair->pivot[2]};
  double matrix[9], arms[3][3];
  reference_mul(world, own, arms[2]);
  reference_matrix(a->rotation, matrix);
  reference_mul(matrix, own, arms[0]);
  reference_matrix(b->rotation, matrix);
  reference_mul(matrix, own, arms[1]);
  for (int i = 0; i < 3; i++) {
    const double from = a->position[i] + arms[0][i];
    along[i] = from + (arcs ? u * (b->position[i] + arms[1][i] - from) : 0) - arms[2][i];
  }
  reference_mul(pair->to_fixed, along, p);
}

// Where the moving patch's centre is at time t.
static void reference_place(const reference_pair *pair, const reference_pose *poses, double t,
                            double *place) {
  double q[4], m[9], p[3];
  reference_at(pair, poses, t, q, m, p);
  reference_mul(m, pair->c1, place);
  for (int k = 0; k < 3; k++) place[k] += p[k];
}

// When the spheres meet (end 0) or part (end 1): centres on a chord over a segment, within it.
// graze: the cosine between the chord and the line of the centres then, or 1 where the time is an
// end of the segment.
static double reference_contact(const reference_pair *pair, const reference_pose *poses, int end,
                                double *graze) {
  const double from = pair->segment[end][0];
  const double to = pair->segment[end][1];
  const double reach = pair->reach[end];
  double a[3], v[3], y[3];
  reference_place(pair, poses, from, a);
  reference_place(pair, poses, to, v);
  for (int k = 0; k < 3; k++) {
    v[k] -= a[k];
    a[k] -= pair->c2[k];
  }
  const double vv = reference_dot(v, v);
  const double av = reference_dot(a, v);
  const double aa = reference_dot(a, a) - reach * reach;
  const double root = sqrt(fmax(av * av - vv * aa, 0));
  double tau = vv > 0 ? (end ? -av + root : -av - root) / vv : end;
  *graze = 1;
  if (tau > 0 && tau < 1) {
    for (int k = 0; k < 3; k++) y[k] = a[k] + tau * v[k];
    *graze = fabs(reference_dot(y, v)) / (reference_length(y) * sqrt(vv));
  }
  tau = fmin(fmax(tau, 0), 1);
  return from + tau * (to - from);
}

// A latent's vectors seen in a frame (rows: its axes), times k: degree 1 as a vector, degree 2 as
// the symmetric matrix without trace whose quadratic form it is.
static void reference_latent(const double *z, const double *frame, double k, double *out) {
  const double third = sqrt(3);
  for (size_t c = 0; c < NSVCD_W_CHANNELS; c++) {
    double a[8], x[3], m[9], left[9], turned[9], transposed[9];
    for (size_t i = 0; i < 8; i++) a[i] = z[NSVCD_W_CHANNELS * i + c];
    reference_mul(frame, a, x);
    const double *q = a + 3;
    m[1] = m[3] = q[0] / third;
    m[5] = m[7] = q[1] / third;
    m[2] = m[6] = q[3] / third;
    m[8] = 2 * q[2] / 3;
    m[0] = q[4] / third - m[8] / 2;
    m[4] = -q[4] / third - m[8] / 2;
    for (int i = 0; i < 9; i++) transposed[i] = frame[i % 3 * 3 + i / 3];
    reference_mul33(frame, m, left);
    reference_mul33(left, transposed, turned);
    const double b[8] = {x[0],
                         x[1],
                         x[2],
                         third * turned[1],
                         third * turned[5],
                         1.5 * turned[8],
                         third * turned[2],
                         third / 2 * (turned[0] - turned[4])};
    for (size_t i = 0; i < 8; i++) out[NSVCD_W_CHANNELS * i + c] = k * b[i];
  }
}

static double reference_weight(size_t weights, size_t output, size_t outputs, size_t i, size_t o) {
#ifndef NSVCD_NO_FLOAT
  return (void)output, (double)nsvcd_w_decoder[weights + outputs * i + o];
#else
  return nsvcd_w_decoder_int8[weights + 4 * (outputs * (i / 4) + o) + i % 4] *
         (double)nsvcd_w_decoder_scale[output + o];
#endif
}

// An output of a head: 0 is the logit, 1 the distance in tenths of r1 + r2.
static double reference_head(const nsvcd__decoder *head, size_t head_output, const double *x) {
  double in[256] = {0};
  double out[256];
  size_t weights = head->weights;
  size_t output = head->outputs;
  memcpy(in, x, NSVCD__INPUTS * sizeof *in);
  for (size_t l = 0; l < head->layers; l++) {
    const size_t inputs = head->sizes[l];
    const size_t outputs = head->sizes[l + 1];
    for (size_t o = 0; o < outputs; o++) out[o] = (double)nsvcd_w_decoder_bias[output + o];
    for (size_t i = 0; i < inputs; i++) {
      if (!(in[i] < 0 || in[i] > 0)) continue;
      for (size_t o = 0; o < outputs; o++)
        out[o] += in[i] * reference_weight(weights, output, outputs, i, o);
    }
    for (size_t o = 0; o < outputs; o++) in[o] = l + 1 < head->layers ? fmax(out[o], 0) : out[o];
    weights += inputs * outputs;
    output += outputs;
  }
  return in[head_output];
}

// a / |a| where that is longer than `least`, else `instead`.
static void reference_unit_or(const double *a, double least, const double *instead, double *out) {
  const double length = reference_length(a);
  for (int k = 0; k < 3; k++) out[k] = length > least ? a[k] / length : instead[k];
}

// A patch's tip from its centre, after a turn by w, to the second order.
static void reference_turned_tip(const double *tip, const double *w, double *out) {
  double first[3], second[3];
  reference_cross(w, tip, first);
  reference_cross(w, first, second);
  for (int k = 0; k < 3; k++) out[k] = tip[k] + first[k] + second[k] / 2;
}

// The gap between two patches along u at tau: the least of the moving one's tips, less the greatest
// of the fixed one's. Seen half way: the line between the centres goes by v, one patch turns by w /
// 2, the other by -w / 2.
static double reference_gap(const reference_pair *pair, const double *between, const double *v,
                            const double *w, const double *m, double tau, const double *u) {
  double low = 1e30;
  double high = -1e30;
  double forth[3], back[3], apart[3];
  for (int k = 0; k < 3; k++) {
    forth[k] = tau * w[k] / 2;
    back[k] = -forth[k];
    apart[k] = between[k] + tau * v[k];
  }
  for (int n = 0; n < NSVCD__EXTREMES; n++) {
    double tip[3], turned[3];
    reference_mul(m, pair->tips1[n], tip);
    reference_turned_tip(tip, forth, turned);
    low = fmin(low, reference_dot(u, turned));
    reference_turned_tip(pair->tips2[n], back, turned);
    high = fmax(high, reference_dot(u, turned));
  }
  return reference_dot(u, apart) + low - high;
}

static double reference_squash(double x) {
  return x / (1 + fabs(x));
}

// What the decoder is told of gaps and normals, facts (FACTS), the first of which are of the
// centres. time: -1 where it runs backwards; e1: from the larger patch to the smaller.
static void reference_gap_facts(const reference_pair *pair, const double *p1, const double *v,
                                const double *w, const double *m, double time, const double *e1,
                                double *facts) {
  const double x_axis[3] = {1, 0, 0};
  const int larger_moves = pair->r1 >= pair->r2;
  double between[3], normal[3], against[3], line[3], fixed[3], moving[3], sum[3], both[3];
  for (int k = 0; k < 3; k++) between[k] = p1[k] - pair->c2[k];
  reference_mul(m, pair->n1, normal);
  for (int k = 0; k < 3; k++) against[k] = -normal[k];
  reference_unit_or(between, 1e-20, x_axis, line);
  reference_unit_or(pair->n2, 0.5, line, fixed);
  reference_unit_or(against, 0.5, line, moving);
  for (int k = 0; k < 3; k++) sum[k] = fixed[k] + moving[k];
  reference_unit_or(sum, 1e-3, line, both);
  const double *directions[4] = {larger_moves ? moving : fixed, larger_moves ? fixed : moving, line,
                                 both};
  for (int k = 0; k < 3; k++) {
    double widest = -1e30;
    for (int n = 0; n < 4; n++) {
      const double gap =
          reference_gap(pair, between, v, w, m, time * (k - 1), directions[n]) / pair->unit;
      facts[12 + 3 * n + k] = reference_squash(8 * gap);
      widest = fmax(widest, gap);
    }
    facts[24 + k] = reference_squash(40 * widest);
  }
  const double *larger = larger_moves ? normal : pair->n2;
  const double *smaller = larger_moves ? pair->n2 : normal;
  facts[27] = reference_dot(larger, smaller);
  facts[28] = reference_dot(larger, e1);
  facts[29] = reference_dot(smaller, e1);
  facts[30] = larger_moves ? pair->flat1 : pair->flat2;
  facts[31] = larger_moves ? pair->flat2 : pair->flat1;
}

// The decoder's inputs. v, w: half displacement and half rotation vector; p1: the moving centre; m:
// its body's axes.
static void reference_inputs(const reference_pair *pair, const double *p1, const double *v1,
                             const double *w1, const double *m, double *x) {
  const double unit = pair->unit;
  const double k1 = pair->r1 / unit;
  const double k2 = pair->r2 / unit;
  const double order = pair->r1 >= pair->r2 ? 1 : -1;
  double d[3];
  double v[3];
  double w[3];
  double lean[3];
  double frame[9];
  double frame1[9];
  double *e1 = frame;
  double *e2 = frame + 3;
  double *e3 = frame + 6;
  double lean_across[3], v_across[3], ref[3], closest[3];
  reference_mul(m, pair->n1, lean);
  for (int k = 0; k < 3; k++) {
    lean[k] = order * (k1 * lean[k] - k2 * pair->n2[k]);
    d[k] = order * (pair->c2[k] - p1[k]) / unit;
    v[k] = v1[k] / unit;
    w[k] = w1[k];
  }
  const double line[3] = {lean[0] + 1e-6, lean[1], lean[2]};
  const double length = reference_length(d);
  for (int k = 0; k < 3; k++) {
    e1[k] = length > 1e-5                   ? d[k] / length
            : reference_length(line) > 1e-9 ? line[k] / reference_length(line)
                                            : k == 0;
  }
  for (int k = 0; k < 3; k++) {
    lean_across[k] = lean[k] - reference_dot(lean, e1) * e1[k];
    v_across[k] = v[k] - reference_dot(v, e1) * e1[k];
  }
  const double time = reference_dot(lean_across, v_across) < 0 ? -1 : 1;
  for (int k = 0; k < 3; k++) {
    v[k] *= time;
    w[k] *= time;
    ref[k] = (double)NSVCD__LEAN * lean_across[k] + time * v_across[k];
  }
  if (reference_length(ref) <= 1e-7) {
    int axis = 0;
    for (int k = 1; k < 3; k++) axis = fabs(e1[k]) < fabs(e1[axis]) ? k : axis;
    for (int k = 0; k < 3; k++) ref[k] = (k == axis) - e1[axis] * e1[k];
  }
  for (int k = 0; k < 3; k++) e2[k] = ref[k] / reference_length(ref);
  reference_cross(e1, e2, e3);
  const double side = reference_dot(lean, e3) < -(double)NSVCD__SIDE ? -1 : 1;
  for (int k = 0; k < 3; k++) e3[k] *= side;
  reference_mul33(frame, m, frame1);
  const size_t first = order > 0 ? 0 : 1;
  const size_t second = 1 - first;
  double *scalars = x + 2 * NSVCD__VECTORS;
  double *facts = scalars + 2 * NSVCD_W_SCALARS;
  reference_latent(pair->z1, frame1, k1, x + NSVCD__VECTORS * first);
  reference_latent(pair->z2, frame, k2, x + NSVCD__VECTORS * second);
  memcpy(scalars + NSVCD_W_SCALARS * first, pair->z1 + NSVCD__VECTORS, NSVCD_W_SCALARS * sizeof *x);
  memcpy(scalars + NSVCD_W_SCALARS * second, pair->z2 + NSVCD__VECTORS,
         NSVCD_W_SCALARS * sizeof *x);
  const double tau = fmin(fmax(reference_dot(d, v) / (reference_dot(v, v) + 1e-6), -1), 1);
  for (int k = 0; k < 3; k++) closest[k] = d[k] - tau * v[k];
  facts[0] = length;
  facts[1] = fmax(k1, k2);
  facts[2] = reference_length(closest);
  facts[3] = tau;
  for (int k = 0; k < 3; k++) {
    facts[4 + k] = reference_dot(frame + 3 * k, v);
    facts[7 + k] = side * reference_dot(frame + 3 * k, w);
  }
  facts[10] = reference_length(v);
  facts[11] = reference_length(w);
  reference_gap_facts(pair, p1, v1, w1, m, order * time, e1, facts);
}

// What the head says: the logit before its threshold, or metres. times: NULL, or (2) when the spheres meet and part. graze: NULL,
// or the lesser of the two cosines of reference_contact.
static double reference_said(const reference_pair *pair, const reference_pose *poses, double *times,
                             double *graze) {
  double q[3][4], m[3][9], p[3][3], place[3][3], t[3], cosine[2], turn[4], w[3], v[3], arm[3],
      x[NSVCD__INPUTS];
  t[0] = reference_contact(pair, poses, 0, &cosine[0]);
  t[1] = reference_contact(pair, poses, 1, &cosine[1]);
  t[2] = 0.5 * (t[0] + t[1]);
  if (times) {
    times[0] = t[0];
    times[1] = t[1];
  }
  if (graze) *graze = fmin(cosine[0], cosine[1]);
  for (int i = 0; i < 3; i++) {
    reference_at(pair, poses, t[i], q[i], m[i], p[i]);
    reference_mul(m[i], pair->c1, place[i]);
    for (int k = 0; k < 3; k++) place[i][k] += p[i][k];
  }
  const double back[4] = {-q[0][0], -q[0][1], -q[0][2], q[0][3]};
  reference_quat_mul(q[1], back, turn);
  const double sine = reference_length(turn);
  const double sign = turn[3] < 0 ? -1 : 1;
  const double angle = atan2(sine, sign * turn[3]);
  double fixed_turn[3];
  for (int k = 0; k < 3; k++) fixed_turn[k] = sine > 0 ? sign * angle * turn[k] / sine : 0;
  reference_mul(pair->to_fixed, fixed_turn, w);  // reference_at's quaternions are in world axes
  for (int k = 0; k < 3; k++) arm[k] = 0.5 * (pair->c2[k] - place[2][k]);
  reference_cross(w, arm, v);
  for (int k = 0; k < 3; k++) v[k] += 0.5 * (place[1][k] - place[0][k]);
  reference_inputs(pair, place[2], v, w, m[2], x);
  const double said = reference_head(pair->head, pair->output, x);
  return pair->output == NSVCD__OUT_LOGIT ? said : 0.1 * pair->unit * said;
}

// Column k of pose n: 0 .. 2 moves it by `step` metres along an axis, 3 .. 5 turns it by `step`
// radians.
static void reference_displace(reference_pose *pose, size_t k, double step) {
  double by[3] = {0, 0, 0};
  if (k < 3) {
    pose->position[k] += step;
  } else {
    by[k - 3] = step;
    reference_turn(by, pose->rotation, pose->rotation);
  }
}

// Central differences: (count, 6). metres, radians: the steps.
static void reference_gradient(const reference_pair *pair, const reference_pose *poses,
                               double metres, double radians, double *gradient) {
  reference_pose moved[REFERENCE_POSES];
  for (size_t i = 0; i < 6 * pair->count; i++) {
    const double step = i % 6 < 3 ? metres : radians;
    double value[2];
    for (int side = 0; side < 2; side++) {
      memcpy(moved, poses, pair->count * sizeof *poses);
      reference_displace(&moved[i / 6], i % 6, side ? step : -step);
      value[side] = reference_said(pair, moved, NULL, NULL);
    }
    gradient[i] = (value[1] - value[0]) / (2 * step);
  }
}

// What a query in float decided, for the reference, and its poses. mover: its times and its pivot.
// work: as that query left it.
static void reference_open(const nsvcd_mover *mover, const nsvcd_body *moving,
                           const nsvcd_pose *poses, size_t count, const nsvcd_body *fixed,
                           const nsvcd_pose *fixed_pose, const nsvcd__search *work,
                           const nsvcd__candidate *candidate, const nsvcd__decoder *head,
                           reference_pair *pair, reference_pose *exact) {
  const size_t i = candidate->moving;
  const size_t j = candidate->fixed;
  double q[4], m[9];
  pair->head = head;
  pair->output = 0;
  pair->count = count;
  pair->times = mover->times;
  pair->pivot = mover->pivot;
  for (size_t n = 0; n < count; n++) {
    for (int k = 0; k < 3; k++) {
      exact[n].position[k] = (double)poses[n].position[k] - (double)fixed_pose->position[k];
    }
    for (int k = 0; k < 4; k++) exact[n].rotation[k] = (double)poses[n].rotation[k];
  }
  for (size_t k = 0; k < 3; k++) {
    pair->c1[k] = (double)nsvcd__body_floats(moving, k * moving->padded)[i];
    pair->c2[k] = (double)nsvcd__body_floats(fixed, k * fixed->padded)[j];
  }
  pair->r1 = (double)nsvcd__body_r(moving)[i];
  pair->r2 = (double)nsvcd__body_r(fixed)[j];
  pair->unit = pair->r1 + pair->r2;
  for (size_t k = 0; k < NSVCD__LATENT; k++) {
    pair->z1[k] = nsvcd__body_latents(moving)[NSVCD__LATENT * i + k] / 127.0;
    pair->z2[k] = nsvcd__body_latents(fixed)[NSVCD__LATENT * j + k] / 127.0;
  }
  for (int n = 0; n < 2; n++) {
    const nsvcd_body *body = n == 0 ? moving : fixed;
    const size_t patch = n == 0 ? i : j;
    const double radius = n == 0 ? pair->r1 : pair->r2;
    double(*tips)[3] = n == 0 ? pair->tips1 : pair->tips2;
    double *normal = n == 0 ? pair->n1 : pair->n2;
    const int8_t *stored = nsvcd__group_extremes(body, patch / NSVCD__GROUP) + patch % NSVCD__GROUP;
    for (int k = 0; k < 3; k++) {
      normal[k] = (double)nsvcd__body_areas(body)[patch + (size_t)k * body->padded];
      for (int t = 0; t < NSVCD__EXTREMES; t++)
        tips[t][k] = radius / 127 * stored[NSVCD__GROUP * (3 * t + k)];
    }
    const double area = reference_length(normal);
    for (int k = 0; k < 3; k++) normal[k] = area > 1e-6 * radius * radius ? normal[k] / area : 0;
    *(n == 0 ? &pair->flat1 : &pair->flat2) = fmin(area / (acos(-1) * radius * radius), 2);
  }
  for (size_t k = 0; k < 4; k++) q[k] = (double)fixed_pose->rotation[k];
  reference_matrix(q, m);
  for (size_t k = 0; k < 9; k++) pair->to_fixed[k] = m[k % 3 * 3 + k / 3];
  // The allowance for the motion within a segment is that of the farthest point of the patch's
  // group.
  const size_t g = i / NSVCD__GROUP;
  double group[3];
  const nsvcd__sphere sphere = nsvcd__sphere_of(nsvcd__groups_of(moving), g);
  group[0] = (double)sphere.centre.x;
  group[1] = (double)sphere.centre.y;
  group[2] = (double)sphere.centre.z;
  const double far = reference_length(group) + (double)sphere.radius;
  size_t s[2] = {0, 0};
  while (s[0] + 1 < work->segments && candidate->t_enter >= work->time[s[0] + 1]) s[0]++;
  while (s[1] + 1 < work->segments && candidate->t_exit > work->time[s[1] + 1]) s[1]++;
  for (int end = 0; end < 2; end++) {
    const nsvcd__segments *block = &work->blocks[s[end] / NSVCD__LANES];
    const size_t l = s[end] % NSVCD__LANES;
    pair->segment[end][0] = (double)work->time[s[end]];
    pair->segment[end][1] = (double)work->time[s[end] + 1];
    pair->reach[end] = pair->unit + (double)block->margin[l] + (double)block->bend[l] * far;
  }
}

#endif
