// oracle.h - exact answers to the questions that the library answers by a network. Slow, double
// precision: for tests, and for examples that let themselves be judged.
//
// In: triangle meshes, a fixed pose, a motion as examples/FORMATS.md has it: poses at equal times,
// the position linear in between, the rotation by slerp on the shorter arc.
//
// Out: the least separation of two surfaces over the motion, with its time and witness points;
// whether they touch, and the first time at which they do; whether one body lies inside the other.
//
// Exact means: every number is either computed in double from the triangles themselves, or bounded
// rigorously (a bound on how fast any point of the body moves); nothing is sampled and hoped for.
// Rounding (about 1e-13 m on objects of 1 m) is far below the tolerance that the caller gives.
//
// Units are metres, quaternions x y z w, matrices row-major. All functions are static; failures to
// allocate return 0.
#ifndef NSVCD_SCENERY_ORACLE_H
#define NSVCD_SCENERY_ORACLE_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#if defined(__GNUC__)
#define ORACLE_DEF static __attribute__((unused))
#else
#define ORACLE_DEF static
#endif

// ------------------------------------------------------------------------------- vectors and poses

ORACLE_DEF double oracle_dot(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
ORACLE_DEF void oracle_sub(const double *a, const double *b, double *out) {
  for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}
ORACLE_DEF void oracle_cross(const double *a, const double *b, double *out) {
  double x = a[1] * b[2] - a[2] * b[1];
  double y = a[2] * b[0] - a[0] * b[2];
  double z = a[0] * b[1] - a[1] * b[0];
  out[0] = x;
  out[1] = y;
  out[2] = z;
}
ORACLE_DEF double oracle_length(const double *a) {
  return sqrt(oracle_dot(a, a));
}

typedef struct oracle_pose {
  double position[3];
  double rotation[4];  // unit quaternion x y z w
} oracle_pose;

// Rotation matrix of a unit quaternion.
ORACLE_DEF void oracle_matrix(const double *q, double *m) {
  double x = q[0];
  double y = q[1];
  double z = q[2];
  double w = q[3];
  m[0] = 1 - 2 * (y * y + z * z);
  m[1] = 2 * (x * y - z * w);
  m[2] = 2 * (x * z + y * w);
  m[3] = 2 * (x * y + z * w);
  m[4] = 1 - 2 * (x * x + z * z);
  m[5] = 2 * (y * z - x * w);
  m[6] = 2 * (x * z - y * w);
  m[7] = 2 * (y * z + x * w);
  m[8] = 1 - 2 * (x * x + y * y);
}
ORACLE_DEF void oracle_rotate(const double *m, const double *v, double *out) {
  for (int i = 0; i < 3; i++) out[i] = oracle_dot(m + 3 * i, v);
}
ORACLE_DEF void oracle_rotate_back(const double *m, const double *v, double *out) {
  for (int i = 0; i < 3; i++) out[i] = m[i] * v[0] + m[3 + i] * v[1] + m[6 + i] * v[2];
}
ORACLE_DEF void oracle_quat_mul(const double *a, const double *b, double *out) {
  double x = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1];
  double y = a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0];
  double z = a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3];
  double w = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
  out[0] = x;
  out[1] = y;
  out[2] = z;
  out[3] = w;
}
ORACLE_DEF void oracle_quat_normalize(double *q) {
  double n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; i++) q[i] /= n;
}
// Rotation from q0 to q1 on the shorter arc, as a world axis (unit) and an angle in [0, pi].
ORACLE_DEF double oracle_quat_arc(const double *q0, const double *q1, double *axis) {
  double inverse[4] = {-q0[0], -q0[1], -q0[2], q0[3]};
  double d[4];
  oracle_quat_mul(q1, inverse, d);
  if (d[3] < 0)
    for (int i = 0; i < 4; i++) d[i] = -d[i];
  double s = oracle_length(d);
  for (int i = 0; i < 3; i++) axis[i] = s > 0 ? d[i] / s : (i == 0);
  return 2 * atan2(s, d[3]);
}
ORACLE_DEF void oracle_axis_angle(const double *axis, double angle, double *q) {
  double s = sin(angle / 2);
  for (int i = 0; i < 3; i++) q[i] = axis[i] * s;
  q[3] = cos(angle / 2);
}
// The pose at fraction f in [0,1] between two poses: position linear, rotation slerp on the shorter
// arc.
ORACLE_DEF oracle_pose oracle_pose_between(const oracle_pose *a, const oracle_pose *b, double f) {
  oracle_pose out;
  double axis[3], turn[4];
  double angle = oracle_quat_arc(a->rotation, b->rotation, axis);
  oracle_axis_angle(axis, angle * f, turn);
  oracle_quat_mul(turn, a->rotation, out.rotation);
  oracle_quat_normalize(out.rotation);
  for (int i = 0; i < 3; i++)
    out.position[i] = a->position[i] + f * (b->position[i] - a->position[i]);
  return out;
}
ORACLE_DEF oracle_pose oracle_pose_at(const oracle_pose *poses, size_t count, double t) {
  if (count == 1) return poses[0];
  double s = t * (double)(count - 1);
  size_t i = s <= 0 ? 0 : (size_t)s;
  if (i > count - 2) i = count - 2;
  return oracle_pose_between(&poses[i], &poses[i + 1], s - (double)i);
}
ORACLE_DEF void oracle_transform(const oracle_pose *pose, const double *v, double *out) {
  double m[9], r[3];
  oracle_matrix(pose->rotation, m);
  oracle_rotate(m, v, r);
  for (int i = 0; i < 3; i++) out[i] = r[i] + pose->position[i];
}
// `outer` after `inner`.
ORACLE_DEF oracle_pose oracle_compose(const oracle_pose *outer, const oracle_pose *inner) {
  oracle_pose out;
  oracle_transform(outer, inner->position, out.position);
  oracle_quat_mul(outer->rotation, inner->rotation, out.rotation);
  oracle_quat_normalize(out.rotation);
  return out;
}

// ----------------------------------------------------------------------------------- mesh topology

typedef struct oracle_weld_key {
  double v[3];
  uint32_t id;
} oracle_weld_key;

ORACLE_DEF int oracle_weld_compare(const void *pa, const void *pb) {
  const oracle_weld_key *a = (const oracle_weld_key *)pa;
  const oracle_weld_key *b = (const oracle_weld_key *)pb;
  for (int i = 0; i < 3; i++)
    if (a->v[i] < b->v[i] || a->v[i] > b->v[i]) return a->v[i] < b->v[i] ? -1 : 1;
  return (a->id > b->id) - (a->id < b->id);
}
// welded[i] = the lowest index of a vertex that is at exactly the same place as vertex i.
ORACLE_DEF int oracle_weld(const double *positions, size_t vertices, uint32_t *welded) {
  oracle_weld_key *keys = (oracle_weld_key *)malloc((vertices + 1) * sizeof *keys);
  if (!keys) return 0;
  for (size_t i = 0; i < vertices; i++) {
    for (size_t k = 0; k < 3; k++) keys[i].v[k] = positions[3 * i + k];
    keys[i].id = (uint32_t)i;
  }
  qsort(keys, vertices, sizeof *keys, oracle_weld_compare);
  for (size_t i = 0; i < vertices; i++) {
    int same = i > 0;
    for (int k = 0; k < 3 && same; k++)
      same = !(keys[i].v[k] < keys[i - 1].v[k] || keys[i].v[k] > keys[i - 1].v[k]);
    welded[keys[i].id] = same ? welded[keys[i - 1].id] : keys[i].id;
  }
  free(keys);
  return 1;
}
ORACLE_DEF int oracle_u64_compare(const void *pa, const void *pb) {
  uint64_t a = *(const uint64_t *)pa;
  uint64_t b = *(const uint64_t *)pb;
  return (a > b) - (a < b);
}
// Closed: after welding, every directed edge is matched by its reverse, as often as it occurs.
ORACLE_DEF int oracle_is_closed(const double *positions, size_t vertices, const uint32_t *indices,
                                size_t triangles) {
  uint32_t *welded = (uint32_t *)malloc((vertices + 1) * sizeof *welded);
  uint64_t *edges = (uint64_t *)malloc((6 * triangles + 1) * sizeof *edges);
  uint64_t *reversed = edges + 3 * triangles;
  int closed = welded && edges && oracle_weld(positions, vertices, welded);
  for (size_t i = 0; closed && i < 3 * triangles; i++) {
    uint64_t a = welded[indices[i]];
    uint64_t b = welded[indices[i % 3 == 2 ? i - 2 : i + 1]];
    edges[i] = a << 32 | b;
    reversed[i] = b << 32 | a;
  }
  if (closed) {
    qsort(edges, 3 * triangles, sizeof *edges, oracle_u64_compare);
    qsort(reversed, 3 * triangles, sizeof *edges, oracle_u64_compare);
    closed = memcmp(edges, reversed, 3 * triangles * sizeof *edges) == 0;
  }
  free(welded);
  free(edges);
  return closed;
}

// -------------------------------------------------------------------------------------------- mesh
// A bounding volume hierarchy of axis-aligned boxes in the body frame, one triangle per leaf.

typedef struct oracle_triangle {
  double v[3][3];
  // unit; zero when the triangle is too thin to have one (its edges then say everything)
  double normal[3];
} oracle_triangle;

typedef struct oracle_node {
  double center[3], half[3];
  size_t child;     // children are child and child + 1; 0: a leaf
  size_t triangle;  // leaves only
} oracle_node;

typedef struct oracle_mesh {
  oracle_triangle *triangles;
  oracle_node *nodes;  // 2 triangle_count - 1, the root first
  double *seeds;       // (seed_count, 3): one vertex of every connected component
  size_t triangle_count, node_count, seed_count;
  double low[3], high[3];    // bounds
  double center[3], radius;  // the bounds' centre; the radius reaches the farthest vertex
} oracle_mesh;

ORACLE_DEF void oracle_mesh_free(oracle_mesh *mesh) {
  free(mesh->triangles);
  free(mesh->nodes);
  free(mesh->seeds);
  memset(mesh, 0, sizeof *mesh);
}
ORACLE_DEF double oracle_centroid(const oracle_triangle *t, size_t axis) {
  return (t->v[0][axis] + t->v[1][axis] + t->v[2][axis]) / 3;
}
ORACLE_DEF void oracle_node_bounds(oracle_mesh *mesh, oracle_node *node, size_t begin, size_t end) {
  for (size_t k = 0; k < 3; k++) {
    double low = DBL_MAX;
    double high = -DBL_MAX;
    for (size_t i = begin; i < end; i++)
      for (size_t j = 0; j < 3; j++) {
        low = fmin(low, mesh->triangles[i].v[j][k]);
        high = fmax(high, mesh->triangles[i].v[j][k]);
      }
    node->center[k] = (low + high) / 2;
    node->half[k] = (high - low) / 2;
  }
}
// Moves triangles whose centroid is in the lower half to the front; halves the list when that
// separates nothing, or when the tree grows too deep.
ORACLE_DEF size_t oracle_partition(oracle_mesh *mesh, size_t begin, size_t end, int depth) {
  double low[3], high[3];
  size_t axis = 0;
  size_t middle = begin;
  for (size_t k = 0; k < 3; k++) {
    low[k] = DBL_MAX;
    high[k] = -DBL_MAX;
    for (size_t i = begin; i < end; i++) {
      double c = oracle_centroid(&mesh->triangles[i], k);
      low[k] = fmin(low[k], c);
      high[k] = fmax(high[k], c);
    }
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  }
  double split = (low[axis] + high[axis]) / 2;
  for (size_t i = begin; i < end; i++) {
    if (oracle_centroid(&mesh->triangles[i], axis) > split) continue;
    oracle_triangle swap = mesh->triangles[i];
    mesh->triangles[i] = mesh->triangles[middle];
    mesh->triangles[middle++] = swap;
  }
  return middle == begin || middle == end || depth > 48 ? (begin + end) / 2 : middle;
}
ORACLE_DEF void oracle_build(oracle_mesh *mesh, size_t index, size_t begin, size_t end, int depth) {
  oracle_node *node = &mesh->nodes[index];
  oracle_node_bounds(mesh, node, begin, end);
  node->child = 0;
  node->triangle = begin;
  if (end - begin == 1) return;
  size_t middle = oracle_partition(mesh, begin, end, depth);
  node->child = mesh->node_count;
  mesh->node_count += 2;
  oracle_build(mesh, node->child, begin, middle, depth + 1);
  oracle_build(mesh, node->child + 1, middle, end, depth + 1);
}
ORACLE_DEF void oracle_triangle_normal(oracle_triangle *t) {
  double e0[3], e1[3], n[3];
  oracle_sub(t->v[1], t->v[0], e0);
  oracle_sub(t->v[2], t->v[0], e1);
  oracle_cross(e0, e1, n);
  double area = oracle_length(n);
  double size = fmax(oracle_dot(e0, e0), oracle_dot(e1, e1));
  for (int i = 0; i < 3; i++) t->normal[i] = area > 1e-9 * size ? n[i] / area : 0;
}
ORACLE_DEF uint32_t oracle_find(uint32_t *parent, uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}
// One vertex of every connected component (after welding): where no surfaces touch, it speaks for
// the whole.
ORACLE_DEF int oracle_seeds(oracle_mesh *mesh, const double *positions, size_t vertices,
                            const uint32_t *indices, double scale) {
  uint32_t *parent = (uint32_t *)malloc((vertices + 1) * sizeof *parent);
  uint32_t *welded = (uint32_t *)malloc((vertices + 1) * sizeof *welded);
  unsigned char *seen = (unsigned char *)calloc(vertices + 1, 1);
  mesh->seeds = (double *)malloc((3 * vertices + 1) * sizeof(double));
  int ok = parent && welded && seen && mesh->seeds && oracle_weld(positions, vertices, welded);
  for (size_t i = 0; ok && i < vertices; i++) parent[i] = (uint32_t)i;
  for (size_t i = 0; ok && i < 3 * mesh->triangle_count; i++) {
    uint32_t a = oracle_find(parent, welded[indices[i]]);
    uint32_t b = oracle_find(parent, welded[indices[i - i % 3]]);
    parent[a] = b;
  }
  for (size_t i = 0; ok && i < 3 * mesh->triangle_count; i += 3) {
    uint32_t root = oracle_find(parent, welded[indices[i]]);
    if (seen[root]) continue;
    seen[root] = 1;
    for (size_t k = 0; k < 3; k++)
      mesh->seeds[3 * mesh->seed_count + k] = scale * positions[3 * root + k];
    mesh->seed_count++;
  }
  free(parent);
  free(welded);
  free(seen);
  return ok;
}
// positions: (vertices, 3), multiplied by scale; indices: (triangles, 3), valid, triangles >= 1.
// Returns 0 without memory.
ORACLE_DEF int oracle_mesh_init(oracle_mesh *mesh, const double *positions, size_t vertices,
                                const uint32_t *indices, size_t triangles, double scale) {
  memset(mesh, 0, sizeof *mesh);
  mesh->triangle_count = triangles;
  mesh->triangles = (oracle_triangle *)malloc(triangles * sizeof *mesh->triangles);
  mesh->nodes = (oracle_node *)malloc(2 * triangles * sizeof *mesh->nodes);
  if (!mesh->triangles || !mesh->nodes ||
      !oracle_seeds(mesh, positions, vertices, indices, scale)) {
    oracle_mesh_free(mesh);
    return 0;
  }
  for (size_t i = 0; i < triangles; i++) {
    for (size_t j = 0; j < 3; j++)
      for (size_t k = 0; k < 3; k++)
        mesh->triangles[i].v[j][k] = scale * positions[3 * indices[3 * i + j] + k];
    oracle_triangle_normal(&mesh->triangles[i]);
  }
  mesh->node_count = 1;
  oracle_build(mesh, 0, 0, triangles, 0);
  for (size_t k = 0; k < 3; k++) {
    mesh->center[k] = mesh->nodes[0].center[k];
    mesh->low[k] = mesh->center[k] - mesh->nodes[0].half[k];
    mesh->high[k] = mesh->center[k] + mesh->nodes[0].half[k];
  }
  for (size_t i = 0; i < 3 * triangles; i++) {
    double d[3];
    oracle_sub(mesh->triangles[i / 3].v[i % 3], mesh->center, d);
    mesh->radius = fmax(mesh->radius, oracle_length(d));
  }
  return 1;
}

// -------------------------------------------------------------------------- two triangles, exactly

ORACLE_DEF double oracle_clamp01(double x) {
  return x < 0 ? 0 : x > 1 ? 1 : x;
}

// Squared distance of segments p0 p1 and q0 q1, with the closest points (Ericson, Real-Time
// Collision Detection, 5.1.9).
ORACLE_DEF double oracle_segments(const double *p0, const double *p1, const double *q0,
                                  const double *q1, double *on_p, double *on_q) {
  double d1[3];
  double d2[3];
  double r[3];
  double s = 0;
  double t = 0;
  oracle_sub(p1, p0, d1);
  oracle_sub(q1, q0, d2);
  oracle_sub(p0, q0, r);
  double a = oracle_dot(d1, d1);
  double e = oracle_dot(d2, d2);
  double f = oracle_dot(d2, r);
  double c = oracle_dot(d1, r);
  if (a > 0 && e > 0) {
    double b = oracle_dot(d1, d2);
    double denominator = a * e - b * b;
    // Near parallel segments have a flat valley: any s will do, and clamping t corrects s below.
    if (denominator > 1e-14 * a * e) s = oracle_clamp01((b * f - c * e) / denominator);
    t = (b * s + f) / e;
    if (t < 0) {
      t = 0;
      s = oracle_clamp01(-c / a);
    }
    if (t > 1) {
      t = 1;
      s = oracle_clamp01((b - c) / a);
    }
  } else if (e > 0) {
    t = oracle_clamp01(f / e);
  } else if (a > 0) {
    s = oracle_clamp01(-c / a);
  }
  double sum = 0;
  for (int i = 0; i < 3; i++) {
    on_p[i] = p0[i] + s * d1[i];
    on_q[i] = q0[i] + t * d2[i];
    sum += (on_p[i] - on_q[i]) * (on_p[i] - on_q[i]);
  }
  return sum;
}
// Is x, or its projection along the normal, inside the triangle?
ORACLE_DEF int oracle_projects_inside(const oracle_triangle *t, const double *x) {
  for (int i = 0; i < 3; i++) {
    double edge[3], to[3], c[3];
    oracle_sub(t->v[(i + 1) % 3], t->v[i], edge);
    oracle_sub(x, t->v[i], to);
    oracle_cross(edge, to, c);
    if (oracle_dot(c, t->normal) < 0) return 0;
  }
  return 1;
}
// heights[k]: signed distance of vertex k of b from the plane of a. Returns how far all of b stays
// on one side, or 0.
ORACLE_DEF double oracle_heights(const oracle_triangle *a, const oracle_triangle *b,
                                 double *heights) {
  for (int k = 0; k < 3; k++) {
    double d[3];
    oracle_sub(b->v[k], a->v[0], d);
    heights[k] = oracle_dot(d, a->normal);
  }
  double low = fmin(fmin(heights[0], heights[1]), heights[2]);
  double high = fmax(fmax(heights[0], heights[1]), heights[2]);
  return low > 0 ? low : high < 0 ? -high : 0;
}
// Does an edge of b pass through a? Then x is where.
ORACLE_DEF int oracle_edge_crosses(const oracle_triangle *a, const oracle_triangle *b,
                                   const double *heights, double *x) {
  for (int k = 0; k < 3; k++) {
    double h0 = heights[k];
    double h1 = heights[(k + 1) % 3];
    if ((h0 > 0) == (h1 > 0)) continue;
    for (int i = 0; i < 3; i++)
      x[i] = b->v[k][i] + h0 / (h0 - h1) * (b->v[(k + 1) % 3][i] - b->v[k][i]);
    if (oracle_projects_inside(a, x)) return 1;
  }
  return 0;
}
// Squared distance of two triangles, 0 where they intersect, if it is below limit (with the closest
// points); otherwise any lower bound of it that is at least limit, points untouched.
ORACLE_DEF double oracle_triangles(const oracle_triangle *a, const oracle_triangle *b, double limit,
                                   double *on_a, double *on_b) {
  double over_a[3];
  double over_b[3];
  double x[3];
  double y[3];
  double best = limit;
  double gap_a = oracle_heights(a, b, over_a);
  double gap_b = oracle_heights(b, a, over_b);
  double gap = fmax(gap_a, gap_b);
  if (gap * gap >= limit) return gap * gap;
  int flat_a = oracle_dot(a->normal, a->normal) > 0;
  int flat_b = oracle_dot(b->normal, b->normal) > 0;
  if (gap <= 0 && ((flat_a && oracle_edge_crosses(a, b, over_a, x)) ||
                   (flat_b && oracle_edge_crosses(b, a, over_b, x)))) {
    memcpy(on_a, x, sizeof x);
    memcpy(on_b, x, sizeof x);
    return 0;
  }
  for (int k = 0; k < 3; k++) {  // a vertex of one over the face of the other
    if (flat_a && over_a[k] * over_a[k] < best && oracle_projects_inside(a, b->v[k])) {
      best = over_a[k] * over_a[k];
      for (int i = 0; i < 3; i++) {
        on_b[i] = b->v[k][i];
        on_a[i] = on_b[i] - over_a[k] * a->normal[i];
      }
    }
    if (flat_b && over_b[k] * over_b[k] < best && oracle_projects_inside(b, a->v[k])) {
      best = over_b[k] * over_b[k];
      for (int i = 0; i < 3; i++) {
        on_a[i] = a->v[k][i];
        on_b[i] = on_a[i] - over_b[k] * b->normal[i];
      }
    }
  }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      double d = oracle_segments(a->v[i], a->v[(i + 1) % 3], b->v[j], b->v[(j + 1) % 3], x, y);
      if (d >= best) continue;
      best = d;
      memcpy(on_a, x, sizeof x);
      memcpy(on_b, y, sizeof y);
    }
  return best;
}

// -------------------------------------------------------------------------- distance of two meshes

typedef struct oracle_search {
  const oracle_mesh *a, *b;
  double rotation[9], position[3];  // b's body frame as seen from a's
  double magnitude[9];              // |rotation|, element by element
  double best;                      // squared distance found so far, or the limit
  double on_a[3], on_b[3];          // the nearest points, in a's frame
  size_t triangle_a, triangle_b;    // the pair that gave it: a good first guess for a pose nearby
} oracle_search;

// A lower bound on the squared distance of two boxes: b's box is boxed in a's frame, and the other
// way round.
ORACLE_DEF double oracle_box_gap(const oracle_search *s, const oracle_node *a,
                                 const oracle_node *b) {
  const double *r = s->rotation;
  const double *m = s->magnitude;
  double d[3];
  double in_a = 0;
  double in_b = 0;
  for (int i = 0; i < 3; i++) {
    d[i] = oracle_dot(r + 3 * i, b->center) + s->position[i] - a->center[i];
    double gap = fabs(d[i]) - a->half[i] - oracle_dot(m + 3 * i, b->half);
    in_a += gap > 0 ? gap * gap : 0;
  }
  for (int j = 0; j < 3; j++) {
    double along = r[j] * d[0] + r[3 + j] * d[1] + r[6 + j] * d[2];
    double gap = fabs(along) - b->half[j] -
                 (m[j] * a->half[0] + m[3 + j] * a->half[1] + m[6 + j] * a->half[2]);
    in_b += gap > 0 ? gap * gap : 0;
  }
  return in_a > in_b ? in_a : in_b;
}
ORACLE_DEF void oracle_try_triangles(oracle_search *s, size_t ia, size_t ib) {
  const oracle_triangle *b = &s->b->triangles[ib];
  oracle_triangle moved;
  double on_a[3], on_b[3];
  for (int k = 0; k < 3; k++) {
    oracle_rotate(s->rotation, b->v[k], moved.v[k]);
    for (int i = 0; i < 3; i++) moved.v[k][i] += s->position[i];
  }
  oracle_rotate(s->rotation, b->normal, moved.normal);
  double d = oracle_triangles(&s->a->triangles[ia], &moved, s->best, on_a, on_b);
  if (d >= s->best) return;
  s->best = d;
  s->triangle_a = ia;
  s->triangle_b = ib;
  memcpy(s->on_a, on_a, sizeof on_a);
  memcpy(s->on_b, on_b, sizeof on_b);
}
ORACLE_DEF double oracle_node_size(const oracle_node *n) {
  return oracle_dot(n->half, n->half);
}

// Opens the larger box and visits the nearer child first.
ORACLE_DEF void oracle_descend(oracle_search *s, size_t ia, size_t ib) {
  const oracle_node *a = &s->a->nodes[ia];
  const oracle_node *b = &s->b->nodes[ib];
  if (!a->child && !b->child) {
    oracle_try_triangles(s, a->triangle, b->triangle);
    return;
  }
  int open_a = a->child && (!b->child || oracle_node_size(a) > oracle_node_size(b));
  size_t a0 = open_a ? a->child : ia;
  size_t a1 = open_a ? a->child + 1 : ia;
  size_t b0 = open_a ? ib : b->child;
  size_t b1 = open_a ? ib : b->child + 1;
  double gap0 = oracle_box_gap(s, &s->a->nodes[a0], &s->b->nodes[b0]);
  double gap1 = oracle_box_gap(s, &s->a->nodes[a1], &s->b->nodes[b1]);
  if (gap0 <= gap1) {
    if (gap0 < s->best) oracle_descend(s, a0, b0);
    if (gap1 < s->best) oracle_descend(s, a1, b1);
  } else {
    if (gap1 < s->best) oracle_descend(s, a1, b1);
    if (gap0 < s->best) oracle_descend(s, a0, b0);
  }
}
ORACLE_DEF void oracle_search_pose(oracle_search *s, const oracle_pose *a, const oracle_pose *b) {
  double ra[9], rb[9], d[3];
  oracle_matrix(a->rotation, ra);
  oracle_matrix(b->rotation, rb);
  oracle_sub(b->position, a->position, d);
  oracle_rotate_back(ra, d, s->position);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      s->rotation[3 * i + j] = ra[i] * rb[j] + ra[3 + i] * rb[3 + j] + ra[6 + i] * rb[6 + j];
      s->magnitude[3 * i + j] = fabs(s->rotation[3 * i + j]);
    }
}
ORACLE_DEF void oracle_search_begin(oracle_search *s, const oracle_mesh *a, const oracle_mesh *b) {
  memset(s, 0, sizeof *s);
  s->a = a;
  s->b = b;
}
// The distance if it is below limit, else limit. The search remembers the closest pair and starts
// from it next time.
ORACLE_DEF double oracle_search_run(oracle_search *s, const oracle_pose *a, const oracle_pose *b,
                                    double limit) {
  oracle_search_pose(s, a, b);
  s->best = limit < 1e150 ? limit * limit : DBL_MAX;
  oracle_try_triangles(s, s->triangle_a, s->triangle_b);
  if (oracle_box_gap(s, &s->a->nodes[0], &s->b->nodes[0]) < s->best) oracle_descend(s, 0, 0);
  double found = sqrt(s->best);
  return found < limit ? found : limit;
}
// The distance of two posed surfaces (0 if they intersect) and the closest points in the world;
// points may be NULL.
ORACLE_DEF double oracle_distance(const oracle_mesh *a, const oracle_pose *pose_a,
                                  const oracle_mesh *b, const oracle_pose *pose_b, double *on_a,
                                  double *on_b) {
  oracle_search s;
  oracle_search_begin(&s, a, b);
  double d = oracle_search_run(&s, pose_a, pose_b, DBL_MAX);
  if (on_a) oracle_transform(pose_a, s.on_a, on_a);
  if (on_b) oracle_transform(pose_a, s.on_b, on_b);
  return d;
}

// ------------------------------------------------------------------------------------- containment

// Generalised winding number (Jacobson et al. 2013) of the mesh about a point in its body frame:
// the solid angles of all triangles (van Oosterom and Strackee 1983) over 4 pi. 1 inside, 0
// outside, in between only where the mesh is open.
ORACLE_DEF double oracle_winding(const oracle_mesh *mesh, const double *point) {
  double sum = 0;
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    double a[3], b[3], c[3], bc[3];
    oracle_sub(mesh->triangles[i].v[0], point, a);
    oracle_sub(mesh->triangles[i].v[1], point, b);
    oracle_sub(mesh->triangles[i].v[2], point, c);
    oracle_cross(b, c, bc);
    double la = oracle_length(a);
    double lb = oracle_length(b);
    double lc = oracle_length(c);
    sum += atan2(oracle_dot(a, bc), la * lb * lc + oracle_dot(a, b) * lc + oracle_dot(b, c) * la +
                                        oracle_dot(c, a) * lb);
  }
  return sum / 6.283185307179586;
}
// The largest |winding number| of outer about the components of inner. Meaningful where the
// surfaces do not touch.
ORACLE_DEF double oracle_inside(const oracle_mesh *inner, const oracle_pose *pose_inner,
                                const oracle_mesh *outer, const oracle_pose *pose_outer) {
  double m[9];
  double most = 0;
  oracle_matrix(pose_outer->rotation, m);
  for (size_t i = 0; i < inner->seed_count; i++) {
    double world[3], local[3];
    oracle_transform(pose_inner, inner->seeds + 3 * i, world);
    oracle_sub(world, pose_outer->position, world);
    oracle_rotate_back(m, world, local);
    int outside = 0;
    for (int k = 0; k < 3; k++)
      outside = outside || local[k] < outer->low[k] || local[k] > outer->high[k];
    if (!outside) most = fmax(most, fabs(oracle_winding(outer, local)));
  }
  return most;
}

// ----------------------------------------------------------------------------------- swept queries
// Time is replaced by u, a bound on the path length of every point of the moving body: between u
// and u' no point moves farther than |u - u'|, so that the distance d(u) changes by at most |u -
// u'| too. The least distance is then found by Piyavskii's branch and bound, and the first contact
// by stepping u forward by d: conservative advancement.

typedef struct oracle_motion {
  const oracle_pose *poses;
  size_t count;
  double *u;  // (count)
} oracle_motion;

// Bound on the path length of any point x of the mesh between two poses. With c the centre of the
// mesh's bounds: velocity(x) = velocity(c) + w x (x - c), and velocity(c) leaves its value at half
// time by at most |w|^2 |c'| / 2, where c' is the part of c across the axis.
ORACLE_DEF double oracle_path_bound(const oracle_mesh *mesh, const oracle_pose *p0,
                                    const oracle_pose *p1) {
  oracle_pose middle = oracle_pose_between(p0, p1, 0.5);
  double axis[3];
  double m[9];
  double c[3];
  double spin[3];
  double velocity[3];
  double body_axis[3];
  double reach = 0;
  double angle = oracle_quat_arc(p0->rotation, p1->rotation, axis);
  oracle_matrix(middle.rotation, m);
  oracle_rotate(m, mesh->center, c);
  oracle_cross(axis, c, spin);
  for (int i = 0; i < 3; i++) velocity[i] = p1->position[i] - p0->position[i] + angle * spin[i];
  oracle_rotate_back(m, axis, body_axis);
  // the farthest corner of the bounds from the axis through c
  for (int corner = 0; corner < 8; corner++) {
    double half[3], cross[3];
    for (int i = 0; i < 3; i++)
      half[i] = ((corner >> i) & 1 ? 1 : -1) * (mesh->high[i] - mesh->low[i]) / 2;
    oracle_cross(body_axis, half, cross);
    reach = fmax(reach, oracle_length(cross));
  }
  return oracle_length(velocity) + angle * angle * oracle_length(spin) / 2 +
         angle * fmin(reach, mesh->radius);
}
ORACLE_DEF int oracle_motion_init(oracle_motion *motion, const oracle_mesh *mesh,
                                  const oracle_pose *poses, size_t count) {
  motion->poses = poses;
  motion->count = count;
  motion->u = (double *)calloc(count, sizeof(double));
  for (size_t i = 1; motion->u && i < count; i++)
    motion->u[i] =
        motion->u[i - 1] + oracle_path_bound(mesh, &poses[i - 1], &poses[i]) * (1 + 1e-12);
  return motion->u != NULL;
}
ORACLE_DEF void oracle_motion_free(oracle_motion *motion) {
  free(motion->u);
  motion->u = NULL;
}
ORACLE_DEF double oracle_motion_time(const oracle_motion *motion, double u) {
  if (motion->count == 1) return 0;
  size_t low = 0;
  size_t high = motion->count - 1;
  while (high - low > 1) {
    size_t middle = (low + high) / 2;
    if (motion->u[middle] <= u)
      low = middle;
    else
      high = middle;
  }
  double length = motion->u[high] - motion->u[low];
  double f = length > 0 ? oracle_clamp01((u - motion->u[low]) / length) : 0;
  return ((double)low + f) / (double)(motion->count - 1);
}

typedef enum oracle_status {
  ORACLE_FREE,      // the least separation exceeds the tolerance
  ORACLE_COLLIDES,  // triangles intersect
  // no triangles intersect, but at the start a component of one body lies inside the other
  ORACLE_INSIDE,
  ORACLE_UNDECIDED,  // the least separation found is positive and within the tolerance
  ORACLE_NO_MEMORY
} oracle_status;

typedef struct oracle_options {
  double tolerance;  // metres; 0: 1e-4
  // stop once the separation is known to exceed this; 0: find the least one to the tolerance
  double enough;
  // if they collide: time and points of the first contact, not of the one found first
  int first_contact;
  int no_inside;  // skip the containment test
} oracle_options;

typedef struct oracle_result {
  oracle_status status;
  // least separation, at most `tolerance` too large; 0 if colliding (an upper bound with `enough`)
  double distance;
  double lower;                      // proven: the surfaces never come closer than this
  double time;                       // time of `distance`, in [0,1]
  double on_moving[3], on_fixed[3];  // the closest points, in the world
  // the largest |winding number| seen, about 0 or 1 for closed meshes
  double winding;
  size_t evaluations;  // distances computed
} oracle_result;

typedef struct oracle_interval {
  double u0, u1, d0, d1;  // distances at the ends, or lower bounds of them
  double lower;           // the distance in between is at least this
} oracle_interval;

typedef struct oracle_sweep_state {
  oracle_search search;
  oracle_motion motion;
  const oracle_pose *fixed;
  oracle_result *result;
  oracle_interval *heap;  // least lower bound first
  size_t count, capacity;
} oracle_sweep_state;

// The distance at u if it is below limit, else limit; keeps the least one in the result.
ORACLE_DEF double oracle_evaluate(oracle_sweep_state *s, double u, double limit) {
  oracle_result *r = s->result;
  double time = oracle_motion_time(&s->motion, u);
  oracle_pose pose = oracle_pose_at(s->motion.poses, s->motion.count, time);
  double d = oracle_search_run(&s->search, s->fixed, &pose, limit);
  r->evaluations++;
  if (d >= limit || d >= r->distance) return d;
  r->distance = d;
  r->time = time;
  oracle_transform(s->fixed, s->search.on_a, r->on_fixed);
  oracle_transform(s->fixed, s->search.on_b, r->on_moving);
  return d;
}
ORACLE_DEF int oracle_push(oracle_sweep_state *s, double u0, double u1, double d0, double d1) {
  oracle_interval interval = {u0, u1, d0, d1, fmax(0, (d0 + d1 - (u1 - u0)) / 2)};
  if (s->count == s->capacity) {
    size_t capacity = s->capacity ? 2 * s->capacity : 64;
    oracle_interval *heap = (oracle_interval *)realloc(s->heap, capacity * sizeof *heap);
    if (!heap) return 0;
    s->heap = heap;
    s->capacity = capacity;
  }
  size_t i = s->count++;
  for (; i && s->heap[(i - 1) / 2].lower > interval.lower; i = (i - 1) / 2)
    s->heap[i] = s->heap[(i - 1) / 2];
  s->heap[i] = interval;
  return 1;
}
ORACLE_DEF oracle_interval oracle_pop(oracle_sweep_state *s) {
  oracle_interval top = s->heap[0];
  oracle_interval last = s->heap[--s->count];
  size_t i = 0;
  for (size_t child; (child = 2 * i + 1) < s->count; i = child) {
    if (child + 1 < s->count && s->heap[child + 1].lower < s->heap[child].lower) child++;
    if (s->heap[child].lower >= last.lower) break;
    s->heap[i] = s->heap[child];
  }
  s->heap[i] = last;
  return top;
}
// Branch and bound: always splits the interval that may hold the least distance. Ends because an
// interval narrower than 2 tolerance cannot be better than its ends by more than the tolerance.
ORACLE_DEF int oracle_minimize(oracle_sweep_state *s, const oracle_options *options) {
  oracle_result *r = s->result;
  double end = s->motion.u[s->motion.count - 1];
  double d0 = oracle_evaluate(s, 0, DBL_MAX);
  double d1 = end > 0 ? oracle_evaluate(s, end, DBL_MAX) : d0;
  if (end > 0 && !oracle_push(s, 0, end, d0, d1)) return 0;
  r->lower = r->distance;
  while (s->count && r->distance > 0) {
    oracle_interval in = oracle_pop(s);
    // intervals that cannot fall below it do not matter
    double goal = r->distance - options->tolerance;
    if (options->enough > 0) goal = fmin(goal, options->enough);
    goal = fmax(goal, 0);  // this near, only a true intersection settles the matter
    r->lower = fmin(r->distance, in.lower);
    if (in.lower > goal) break;
    // only where distance <= tolerance: undecided
    if (in.u1 - in.u0 <= 0.02 * options->tolerance) continue;
    double u =
        oracle_clamp01(0.5 + (in.d0 - in.d1) / (in.u1 - in.u0) / 2) * (in.u1 - in.u0) + in.u0;
    // Keep off the ends: there the distance is known (or bounded) already.
    double margin = fmin(0.05 * (in.u1 - in.u0), options->tolerance / 4);
    u = fmin(fmax(u, in.u0 + margin), in.u1 - margin);
    // A distance above this proves both halves to be of no interest: no need to know it exactly.
    double limit =
        fmax(fmax(2 * goal + (u - in.u0) - in.d0, 2 * goal + (in.u1 - u) - in.d1), goal) +
        1e-3 * options->tolerance;
    double d = oracle_evaluate(s, u, fmax(limit, 0.1 * options->tolerance));
    if (!oracle_push(s, in.u0, u, in.d0, d) || !oracle_push(s, u, in.u1, d, in.d1)) return 0;
  }
  if (!s->count && !(r->lower < r->distance)) r->lower = r->distance;
  return 1;
}
// Conservative advancement (Mirtich 1996): nothing can touch before u + d. Stops within half the
// tolerance.
ORACLE_DEF void oracle_first_contact(oracle_sweep_state *s, double tolerance) {
  double end = s->motion.u[s->motion.count - 1];
  double u = 0;
  for (;;) {
    s->result->distance = DBL_MAX;  // the result follows the advance
    double d = oracle_evaluate(s, u, DBL_MAX);
    if (d <= tolerance / 2 || u >= end) break;
    u = fmin(u + d, end);
  }
  s->result->distance = 0;
}
// Does the moving body, on its motion, touch the fixed one? options may be NULL.
ORACLE_DEF oracle_result oracle_sweep(const oracle_mesh *moving, const oracle_pose *poses,
                                      size_t count, const oracle_mesh *fixed,
                                      const oracle_pose *fixed_pose,
                                      const oracle_options *options) {
  oracle_options o = {0, 0, 0, 0};
  oracle_result r;
  oracle_sweep_state s;
  if (options) o = *options;
  if (o.tolerance <= 0) o.tolerance = 1e-4;
  memset(&r, 0, sizeof r);
  memset(&s, 0, sizeof s);
  r.distance = DBL_MAX;
  s.result = &r;
  s.fixed = fixed_pose;
  oracle_search_begin(&s.search, fixed, moving);
  int ok = oracle_motion_init(&s.motion, moving, poses, count) && oracle_minimize(&s, &o);
  if (ok && r.distance <= 0 && o.first_contact) oracle_first_contact(&s, o.tolerance);
  oracle_motion_free(&s.motion);
  free(s.heap);
  r.status = !ok ? ORACLE_NO_MEMORY : r.distance <= 0 ? ORACLE_COLLIDES : ORACLE_FREE;
  if (r.status != ORACLE_FREE) return r;
  if (!o.no_inside)
    r.winding = fmax(oracle_inside(moving, &poses[0], fixed, fixed_pose),
                     oracle_inside(fixed, fixed_pose, moving, &poses[0]));
  if (r.distance <= o.tolerance)
    r.status = ORACLE_UNDECIDED;
  else if (r.winding > 0.5)
    r.status = ORACLE_INSIDE;
  return r;
}

#endif
