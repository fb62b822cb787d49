// placed.h - where the parts of a robot are, by matrices, in double: forward kinematics of its own, for
// what is to be compared with the library's. Include neuralsvcd.h, oracle.h and poses.h before it.
#ifndef NSVCD_TESTS_PLACED_H
#define NSVCD_TESTS_PLACED_H

// Where a part is, by matrices, in double; rotations as 9 numbers.
typedef struct placed {
  double m[9], p[3];
} placed;

static inline void placed_by(placed *at, const double *m, const double *p) {
  double turned[9], moved[3];
  oracle_rotate(at->m, p, moved);
  for (int k = 0; k < 3; k++) at->p[k] += moved[k];
  for (int k = 0; k < 9; k++) {
    turned[k] = 0;
    for (int i = 0; i < 3; i++) turned[k] += at->m[k / 3 * 3 + i] * m[3 * i + k % 3];
  }
  memcpy(at->m, turned, sizeof turned);
}
static inline void placed_by_pose(placed *at, const nsvcd_pose *pose) {
  double m[9], p[3], q[4];
  for (int k = 0; k < 4; k++) q[k] = (double)pose->rotation[k];
  for (int k = 0; k < 3; k++) p[k] = (double)pose->position[k];
  oracle_quat_normalize(q);
  oracle_matrix(q, m);
  placed_by(at, m, p);
}
// Rodrigues.
static inline void placed_by_joint(placed *at, const nsvcd_joint *joint, double value) {
  double axis[3], m[9], p[3] = {0, 0, 0};
  const double *a = axis;
  for (int k = 0; k < 3; k++) axis[k] = (double)joint->axis[k];
  const double length = oracle_length(axis);
  for (int k = 0; k < 3; k++) axis[k] /= length;
  const int slides = joint->kind == NSVCD_JOINT_PRISMATIC;
  const double c = slides ? 1 : cos(value);
  const double s = slides ? 0 : sin(value);
  const double across[9] = {0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0};
  for (int k = 0; k < 9; k++)
    m[k] = (k % 4 ? 0 : c) + s * across[k] + (1 - c) * a[k / 3] * a[k % 3];
  for (int k = 0; k < 3 && slides; k++) p[k] = value * axis[k];
  placed_by(at, m, p);
}
static inline placed placed_link(const nsvcd_scene *scene, size_t link, const double *joints) {
  placed at = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  if (link == 0) return at;
  at = placed_link(scene, scene->joints[link - 1].parent, joints);
  placed_by_pose(&at, &scene->joints[link - 1].origin);
  placed_by_joint(&at, &scene->joints[link - 1], joints[link - 1]);
  return at;
}
static inline placed placed_part(const nsvcd_scene *scene, size_t part, const double *joints) {
  placed at = placed_link(scene, scene->parts[part].link, joints);
  placed_by_pose(&at, &scene->parts[part].pose);
  return at;
}
static inline void placed_point(const placed *at, double scale, const double *x, double *out) {
  oracle_rotate(at->m, x, out);
  for (int k = 0; k < 3; k++) out[k] = scale * out[k] + at->p[k];
}

// Bernstein polynomials.
static inline void joints_of_piece(const double *points, size_t degree, size_t joints, double s,
                                   double *out) {
  for (size_t j = 0; j < joints; j++) {
    out[j] = 0;
    double choose = 1;
    for (size_t i = 0; i <= degree; i++) {
      const double weight = choose * pow(s, (double)i) * pow(1 - s, (double)(degree - i));
      out[j] += weight * points[i * joints + j];
      choose = choose * (double)(degree - i) / (double)(i + 1);
    }
  }
}

// As a pose: Shepperd's method, by the largest.
static inline oracle_pose oracle_of(const placed *at) {
  oracle_pose out;
  double *q = out.rotation;
  const double *m = at->m;
  memcpy(out.position, at->p, sizeof out.position);
  const double trace = m[0] + m[4] + m[8];
  const double sizes[4] = {m[0], m[4], m[8], trace};
  int best = 0;
  for (int k = 1; k < 4; k++) best = sizes[k] > sizes[best] ? k : best;
  if (best == 3) {
    q[0] = m[7] - m[5];
    q[1] = m[2] - m[6];
    q[2] = m[3] - m[1];
    q[3] = 1 + trace;
  } else {
    const int i = best;
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    q[i] = 1 + m[4 * i] - m[4 * j] - m[4 * k];
    q[j] = m[3 * i + j] + m[3 * j + i];
    q[k] = m[3 * i + k] + m[3 * k + i];
    q[3] = m[3 * k + j] - m[3 * j + k];
  }
  oracle_quat_normalize(q);
  return out;
}

#endif
