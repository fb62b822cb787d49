// SPDX-License-Identifier: MIT
// nsvcd_verify_scene.h - what nsvcd_verify.h speaks of: meshes with their trees, and motions.
#ifndef NSVCD_VERIFY_SCENE_H
#define NSVCD_VERIFY_SCENE_H
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

// The build and the arithmetic that a proof needs. verify__arithmetic looks for what has no macro.
#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "nsvcd_verify: not with -ffast-math, -ffinite-math-only or /fp:fast: NaN would pass"
#endif
#if defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "nsvcd_verify: not with -fassociative-math, -freciprocal-math or -funsafe-math-optimizations"
#endif
#if FLT_RADIX != 2 || FLT_MANT_DIG != 24 || DBL_MANT_DIG != 53
#error "nsvcd_verify: float and double must be IEEE 754 binary32 and binary64"
#endif

#define NSVCD_VERIFY_NONE 0xffffffffu
#define VERIFY__LEVELS 40     // levels of a tree, and some more
#define VERIFY__BEYOND 1e100  // more than anything becomes; infinities are not used

// A mesh, its components (triangles joined by corners at the same place), and a tree over its
// triangles. A node is a run of triangles with a box about them. The root has all; a node of n > 1
// triangles is cut along the axis along which the sums of their corners differ most (of equals the
// first): its left child has the n / 2 triangles with the least sums (of equals the lower numbers),
// its right child the others.
typedef struct nsvcd_verify_mesh {
  const float *positions;   // (vertices, 3) metres
  const uint32_t *indices;  // (triangles, 3), counter-clockwise from outside
  size_t vertices, triangles;
  uint32_t *order;  // (triangles): the leaves, from left to right
  float *boxes;     // (2 triangles - 1, 6) low, high: of a node, of its left tree, its right tree
  uint32_t *part;   // (vertices): the lowest vertex of its component; NONE: it is of none
  int32_t *sums;    // (vertices): of each component, outwards less inwards along a ray
  uint8_t *open;    // (vertices): 1: the component is not closed
  uint32_t digest;
} nsvcd_verify_mesh;

typedef struct nsvcd_verify_node {
  uint32_t box, first, count;  // a row of boxes; of order
} nsvcd_verify_node;

/*@ // What nsvcd_verify_mesh_init has accepted.
    predicate a_mesh(nsvcd_verify_mesh *m) =
      \valid_read(m) && 1 <= m->triangles <= 0x20000000 && m->vertices <= 0x60000000 &&
      \valid_read(m->positions + (0 .. 3 * m->vertices - 1)) &&
      \valid_read(m->indices + (0 .. 3 * m->triangles - 1)) &&
      (\forall integer i; 0 <= i < 3 * m->triangles ==> m->indices[i] < m->vertices) &&
      \valid(m->order + (0 .. m->triangles - 1)) &&
      (\forall integer i; 0 <= i < m->triangles ==> m->order[i] < m->triangles) &&
      \valid(m->boxes + (0 .. 12 * m->triangles - 7));
    // A node of the tree of a mesh: its triangles are there, and the boxes of all below it.
    predicate a_node(nsvcd_verify_node *n, nsvcd_verify_mesh *m) =
      1 <= n->count && n->first + n->count <= m->triangles &&
      n->box + 2 * n->count <= 2 * m->triangles; */

// Takes a corner x to turn scale x + at.
typedef struct nsvcd_verify_place {
  double turn[9], at[3];
} nsvcd_verify_place;

// A mesh that moves. A motion is three functions: where it is at a time; the next knot (a time at
// which it has a corner) after a time before 1; and by how much, at most, a point leaves its chord
// between two times without a knot between. Along a unit direction n of the world that is deviation[0]
// + deviation[1] r + deviation[2] rho |n x R a|, for a point at r metres from the body's origin and rho
// from the line through that along a = deviation[3..5], a unit vector of the body that R takes to the
// same one at all these times. What is not set is 0.
typedef struct nsvcd_verify_mover {
  const nsvcd_verify_mesh *mesh;
  double scale;
  void (*place)(const void *motion, double t, nsvcd_verify_place *place);
  double (*next)(const void *motion, double t);
  void (*deviation)(const void *motion, double t0, double t1, double *deviation);
  const void *motion;
  double reach;       // metres: what its places are computed from is no farther off
  uint32_t digest;    // digest of the scale and the motion
  const void *clock;  // the joints' motion, which both movers share; NULL for paths
  uint32_t base;      // the link from which it is seen, the same for both; 0, the world, for paths
} nsvcd_verify_mover;

/*@ predicate a_mover(nsvcd_verify_mover *a) = \valid_read(a) && a_mesh(a->mesh); */

// Between two poses the position is linear and the rotation a slerp, the shorter way round. Both
// ways are as long, to a rounding, where the turn is one of 180 degrees: the sign of x x' + y y' +
// z z' + w w' decides, summed so in double, of which the products are exact.
typedef struct nsvcd_verify_path {
  const float *poses;  // (count, 7): x y z, and a unit quaternion x y z w
  const float *times;  // (count) from 0 to 1, rising; NULL: uniform
  size_t count;
} nsvcd_verify_path;

// The lesser of two numbers, and the greater; fmin and fmax, which look for NaN, are calls.
/*@ assigns \nothing;
    ensures \result == a || \result == b; */
static inline double verify__min(double a, double b) {
  return a < b ? a : b;
}
/*@ assigns \nothing;
    ensures \result == a || \result == b; */
static inline double verify__max(double a, double b) {
  return a > b ? a : b;
}

// A double also where registers are wider (x87), for what is compared with itself computed again: a
// knot, or it would be the next one after itself; a key to sort by, or nothing would be at its
// place.
/*@ assigns \nothing;
    ensures \result == x; */
static inline double verify__stored(double x) {
#if FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 1
  return x;
#else
  volatile double stored = x;
  return stored;
#endif
}

// Is a number no larger than a bound, whatever its sign? By their bits without the sign, which are
// in the order of the numbers, with infinity and NaN above: so no option of a compiler lets them
// by.
static inline int verify__within(float x, float most) {
  uint32_t bits, limit;
  memcpy(&bits, &x, sizeof bits);
  memcpy(&limit, &most, sizeof limit);
  return (bits & 0x7fffffffu) <= limit;
}
static inline int verify__within_double(double x, double most) {
  uint64_t bits, limit;
  memcpy(&bits, &x, sizeof bits);
  memcpy(&limit, &most, sizeof limit);
  return (bits & 0x7fffffffffffffffu) <= limit;
}

// NULL, or what of this thread's arithmetic a proof cannot rest on. A processor can be told to
// round otherwise, to fewer digits, or to take subnormal floats for 0, which a library may do as it
// is loaded; a compiler can be told, without a macro, to reorder sums, to divide by reciprocals,
// and that there is no NaN. None of this is an invalid operation, which some have trapped.
static inline const char *verify__arithmetic(void) {
  static const uint64_t quiet_nan = 0x7ff8000000000000u;
  volatile double input[5] = {1, 1e30, 49, 0.5 * DBL_EPSILON, 0.75 * DBL_EPSILON};
  volatile float least = 1e-45f;
  volatile double sums[2], read_nan;
  double nan;
  memcpy(&nan, &quiet_nan, sizeof nan);
  read_nan = nan;
  nan = read_nan;
  const double one = input[0];
  const double large = input[1];
  for (int k = 0; k < 2; k++) sums[k] = one + input[3 + k];
  if (sums[0] > one || !(sums[1] > one)) return "this thread does not round to the nearest double";
  if (!((double)least > 0)) return "this thread takes subnormal floats for 0";
  if ((one + large) - large > 0) return "this build reorders sums";
  if (input[2] / 49 < 1) return "this build divides by reciprocals";
  if (nan == nan) return "this build takes NaN for a number";
  return NULL;
}

static inline uint32_t verify__hash(uint32_t hash, const void *words, size_t count) {
  for (size_t i = 0; i < count; i++) {
    uint32_t word;
    memcpy(&word, (const char *)words + 4 * i, 4);
    hash = (hash ^ word) * 0x9e3779b1u;
    hash ^= hash >> 15;
  }
  return hash;
}

// ---- meshes

/*@ requires a_mesh(m) && triangle < m->triangles && k < 3;
    assigns \nothing;
    ensures \valid_read(\result + (0 .. 2)); */
static inline const float *verify__corner(const nsvcd_verify_mesh *m, size_t triangle, size_t k) {
  return m->positions + 3 * (size_t)m->indices[3 * triangle + k];
}

/*@ requires a_mesh(m) && triangle < m->triangles && 0 <= axis <= 2;
    assigns \nothing; */
static inline double verify__sum(const nsvcd_verify_mesh *m, uint32_t triangle, int axis) {
  const double sum = verify__stored((double)verify__corner(m, triangle, 0)[axis] +
                                    (double)verify__corner(m, triangle, 1)[axis]);
  return verify__stored(sum + (double)verify__corner(m, triangle, 2)[axis]);
}

/*@ requires a_mesh(m) && i < m->triangles && j < m->triangles && 0 <= axis <= 2;
    assigns \nothing; */
static inline int verify__before(const nsvcd_verify_mesh *m, uint32_t i, uint32_t j, int axis) {
  const double x = verify__sum(m, i, axis);
  const double y = verify__sum(m, j, axis);
  return x < y || (!(y < x) && i < j);
}

// Makes a node's box, and cuts it: puts the triangles of its left child first (Hoare's selection).
static inline void verify__cut(nsvcd_verify_mesh *m, const nsvcd_verify_node *node) {
  uint32_t *order = m->order + node->first;
  float *low = m->boxes + 6 * (size_t)node->box;
  float *high = low + 3;
  const int64_t half = node->count / 2;
  double widest = -1;
  int axis = 0;
  for (int k = 0; k < 3; k++) {
    double least = VERIFY__BEYOND;
    double most = -VERIFY__BEYOND;
    low[k] = high[k] = verify__corner(m, order[0], 0)[k];
    for (uint32_t i = 0; i < node->count; i++) {
      const double sum = verify__sum(m, order[i], k);
      for (uint32_t n = 0; n < 3; n++) {
        const float x = verify__corner(m, order[i], n)[k];
        if (x < low[k]) low[k] = x;
        if (x > high[k]) high[k] = x;
      }
      least = verify__min(least, sum);
      most = verify__max(most, sum);
    }
    const double side = verify__stored(most - least);
    if (side > widest) axis = k;
    widest = verify__max(widest, side);
  }
  for (int64_t from = 0, to = (int64_t)node->count - 1; from < to;) {
    const uint32_t pivot = order[(from + to) / 2];
    int64_t i = from;
    int64_t j = to;
    while (i <= j) {
      while (verify__before(m, order[i], pivot, axis)) i++;
      while (verify__before(m, pivot, order[j], axis)) j--;
      if (i > j) break;
      const uint32_t swapped = order[i];
      order[i++] = order[j];
      order[j--] = swapped;
    }
    if (half > j) from = i;
    if (half < i) to = j;
  }
}

/*@ requires \valid_read(node) && \valid(child + (0 .. 1)) && \separated(node, child + (0 .. 1));
    requires 1 < node->count <= 0x20000000 && node->box < 0x40000000 && node->first < 0x20000000;
    assigns child[0 .. 1];
    ensures child[0].count == node->count / 2 && child[1].count == node->count - node->count / 2;
    ensures child[0].first == node->first && child[1].first == node->first + child[0].count;
    ensures child[0].box == node->box + 1 && child[1].box == node->box + 2 * child[0].count; */
static inline void verify__children(const nsvcd_verify_node *node, nsvcd_verify_node *child) {
  const uint32_t half = node->count / 2;
  //@ assert 1 <= half && 2 * half <= node->count <= 2 * half + 1;
  const nsvcd_verify_node left = {node->box + 1, node->first, half};
  const nsvcd_verify_node right = {node->box + 2 * half, node->first + half, node->count - half};
  child[0] = left;
  child[1] = right;
}

// Below 0, 0 or above it: vertex i is before, at or after the place of vertex j.
static inline int verify__vertex_order(const nsvcd_verify_mesh *m, uint32_t i, uint32_t j) {
  for (size_t k = 0; k < 3; k++) {
    const float x = m->positions[3 * (size_t)i + k];
    const float y = m->positions[3 * (size_t)j + k];
    if (x < y || x > y) return x < y ? -1 : 1;
  }
  return 0;
}

// Below 0, 0 or above it: edge i is before, at or after edge j, by their ends, the lower end first,
// whichever way they go. Edge 3 t + k begins at corner k of triangle t. Vertices count as the one
// that stands for their place, in m->sums.
static inline int verify__edge_order(const nsvcd_verify_mesh *m, uint32_t i, uint32_t j) {
  const uint32_t *weld = (const uint32_t *)m->sums;
  const uint32_t edges[2] = {i, j};
  uint64_t ends[2];
  for (int n = 0; n < 2; n++) {
    const uint32_t from = weld[m->indices[edges[n]]];
    const uint32_t to = weld[m->indices[edges[n] / 3 * 3 + (edges[n] + 1) % 3]];
    ends[n] = from < to ? (uint64_t)from << 32 | to : (uint64_t)to << 32 | from;
  }
  return ends[0] < ends[1] ? -1 : ends[0] > ends[1];
}

typedef int verify__order(const nsvcd_verify_mesh *m, uint32_t i, uint32_t j);

// Heap sort (Williams 1964).
static inline void verify__sort(const nsvcd_verify_mesh *m, verify__order *order, uint32_t *list,
                                size_t count) {
  for (size_t n = 2 * count; n > 1; n--) {
    // the first count steps make a heap, the others take the last out of it
    const size_t end = n > count ? count : n - 1;
    size_t at = n > count ? n - count - 1 : 0;
    const uint32_t sinks = n > count ? list[at] : list[end];
    if (n <= count) list[end] = list[0];
    for (size_t child = 2 * at + 1; child < end; child = 2 * at + 1) {
      if (child + 1 < end && order(m, list[child], list[child + 1]) < 0) child++;
      if (order(m, sinks, list[child]) >= 0) break;
      list[at] = list[child];
      at = child;
    }
    list[at] = sinks;
  }
}

static inline uint32_t verify__root(uint32_t *part, uint32_t v) {
  while (part[v] != v) {
    part[v] = part[part[v]];
    v = part[v];
  }
  return v;
}

static inline void verify__unite(uint32_t *part, uint32_t v, uint32_t w) {
  const uint32_t x = verify__root(part, v);
  const uint32_t y = verify__root(part, w);
  part[x > y ? x : y] = x > y ? y : x;
}

// Finds the components, and which are not closed: an edge of theirs goes there and back not equally
// often. edges: (3 triangles), to work with. The vertex that stands for a place may be of no
// triangle where another one there is: it is of the component then, and may be its lowest one; a
// ray from it begins at a corner all the same. Other vertices of no triangle stay of none: no box
// holds them, no ray begins there, and no sum is theirs.
static inline void verify__join(nsvcd_verify_mesh *m, uint32_t *edges) {
  const size_t corners = 3 * m->triangles;
  uint32_t *weld = (uint32_t *)m->sums;
  for (size_t v = 0; v < m->vertices; v++) m->part[v] = (uint32_t)v;
  verify__sort(m, verify__vertex_order, m->part, m->vertices);
  for (size_t i = 0; i < m->vertices; i++) {
    const uint32_t v = m->part[i];
    const int same = i > 0 && verify__vertex_order(m, m->part[i - 1], v) == 0;
    weld[v] = same ? weld[m->part[i - 1]] : v;
  }
  for (size_t i = 0; i < corners; i++) edges[i] = (uint32_t)i;
  verify__sort(m, verify__edge_order, edges, corners);
  memset(m->open, 0, m->vertices);
  for (size_t v = 0; v < m->vertices; v++) m->part[v] = NSVCD_VERIFY_NONE;
  for (size_t i = 0; i < corners; i++) {
    m->part[m->indices[i]] = m->indices[i];
    m->part[weld[m->indices[i]]] = weld[m->indices[i]];
  }
  for (size_t i = 0; i < corners; i++) {
    verify__unite(m->part, m->indices[i], m->indices[i / 3 * 3]);
    verify__unite(m->part, m->indices[i], weld[m->indices[i]]);
  }
  for (size_t i = 0; i < corners; i++)
    m->part[m->indices[i]] = verify__root(m->part, m->indices[i]);
  for (size_t i = 0, end; i < corners; i = end) {
    int64_t balance = 0;
    for (end = i; end < corners && verify__edge_order(m, edges[i], edges[end]) == 0; end++) {
      const uint32_t e = edges[end];
      const uint32_t to = m->indices[e / 3 * 3 + (e + 1) % 3];
      balance += weld[m->indices[e]] < weld[to] ? 1 : weld[m->indices[e]] > weld[to] ? -1 : 0;
    }
    if (balance != 0) m->open[m->part[m->indices[edges[i]]]] = 1;
  }
}

// Bytes of the memory that nsvcd_verify_mesh_init takes; of no more than SIZE_MAX / 128 triangles
// and SIZE_MAX / 32 vertices.
#define NSVCD_VERIFY_MESH_BYTES(vertices, triangles) \
  (52 * (size_t)(triangles) + 9 * (size_t)(vertices))

// Checks a mesh and builds its tree, in memory aligned to 4 bytes that stays, as the arrays do.
// Returns why not, or NULL. Takes its triangles times the logarithm of their number; of a mesh made
// for it, their square.
static inline const char *nsvcd_verify_mesh_init(const float *positions, size_t vertices,
                                                 const uint32_t *indices, size_t triangles,
                                                 void *memory, nsvcd_verify_mesh *m) {
  nsvcd_verify_node stack[VERIFY__LEVELS];
  size_t height = 1;
  const char *unfit = verify__arithmetic();
  if (unfit) return unfit;
  if (triangles < 1 || triangles > 0x20000000 || vertices > 0x60000000 ||
      triangles > SIZE_MAX / 128 || vertices > SIZE_MAX / 32)
    return "a mesh has no triangles, or too many";
  for (size_t i = 0; i < 3 * triangles; i++) {
    if (indices[i] >= vertices) return "a mesh has an index out of range";
  }
  for (size_t i = 0; i < 3 * vertices; i++) {
    if (!verify__within(positions[i], 1e6f)) return "a mesh has a coordinate out of range";
  }
  m->positions = positions;
  m->indices = indices;
  m->vertices = vertices;
  m->triangles = triangles;
  m->boxes = (float *)memory;
  m->order = (uint32_t *)(m->boxes + 12 * triangles);
  m->part = m->order + triangles;
  m->sums = (int32_t *)(m->part + vertices);
  m->open = (uint8_t *)(m->sums + vertices);
  m->digest = verify__hash((uint32_t)vertices, positions, 3 * vertices);
  m->digest = verify__hash(m->digest, indices, 3 * triangles);
  verify__join(m, (uint32_t *)memory);
  for (size_t i = 0; i < triangles; i++) m->order[i] = (uint32_t)i;
  stack[0].box = stack[0].first = 0;
  stack[0].count = (uint32_t)triangles;
  while (height > 0) {
    const nsvcd_verify_node node = stack[--height];
    verify__cut(m, &node);
    if (node.count == 1) continue;
    verify__children(&node, stack + height);
    height += 2;
  }
  return NULL;
}

/*@ // What nsvcd_verify_path_init has accepted.
    predicate a_path(nsvcd_verify_path *p) =
      \valid_read(p) && 1 <= p->count <= 65536 && \valid_read(p->poses + (0 .. 7 * p->count - 1)) &&
      (p->times == \null || \valid_read(p->times + (0 .. p->count - 1))); */

// ---- paths

/*@ requires a_path(p) && k < p->count;
    assigns \nothing; */
static inline double verify__knot(const nsvcd_verify_path *p, size_t k) {
  if (p->times) return (double)p->times[k];
  return verify__stored((double)k / (double)(p->count - 1));
}

// The last pose, but for the last one, that is not after a time.
/*@ requires a_path(p);
    assigns \nothing;
    ensures \result < p->count && (p->count > 1 ==> \result + 1 < p->count); */
static inline size_t verify__pose_before(const nsvcd_verify_path *p, double t) {
  size_t low = 0;
  size_t high = p->count - 1;
  /*@ loop invariant 0 <= low <= high < p->count && (p->count > 1 ==> low < high);
      loop assigns low, high;
      loop variant high - low; */
  while (high > low + 1) {
    const size_t middle = (low + high) / 2;
    if (verify__knot(p, middle) > t)
      high = middle;
    else
      low = middle;
  }
  return low;
}

// The share of the way from pose k to the next one between two times, which may be t0 = knot k.
/*@ requires a_path(p) && (p->count > 1 ==> k + 1 < p->count);
    assigns \nothing; */
static inline double verify__share(const nsvcd_verify_path *p, size_t k, double t0, double t1) {
  return p->count > 1 ? (t1 - t0) / (verify__knot(p, k + 1) - verify__knot(p, k)) : 0;
}

// The quaternions of pose k and the next one, unit, on the same side, and the angle of the turn.
/*@ requires a_path(p) && k < p->count && (p->count > 1 ==> k + 1 < p->count);
    requires \valid(from + (0 .. 3)) && \valid(to + (0 .. 3)) && \separated(from + (0 .. 3), to + (0 .. 3));
    assigns from[0 .. 3], to[0 .. 3]; */
static inline double verify__turn(const nsvcd_verify_path *p, size_t k, double *from, double *to) {
  const float *a = p->poses + 7 * k + 3;
  const float *b = p->count > 1 ? a + 7 : a;
  double dot = 0, square_a = 0, square_b = 0, apart = 0, together = 0;
  /*@ loop invariant 0 <= i <= 4;
      loop assigns i, dot, square_a, square_b;
      loop variant 4 - i; */
  for (int i = 0; i < 4; i++) {
    dot = verify__stored(dot + (double)a[i] * (double)b[i]);
    square_a += (double)a[i] * (double)a[i];
    square_b += (double)b[i] * (double)b[i];
  }
  const double length_a = sqrt(square_a);
  const double length_b = dot < 0 ? -sqrt(square_b) : sqrt(square_b);
  /*@ loop invariant 0 <= i <= 4;
      loop assigns i, apart, together, from[0 .. 3], to[0 .. 3];
      loop variant 4 - i; */
  for (int i = 0; i < 4; i++) {
    from[i] = (double)a[i] / length_a;
    to[i] = (double)b[i] / length_b;
    apart += (to[i] - from[i]) * (to[i] - from[i]);
    together += (to[i] + from[i]) * (to[i] + from[i]);
  }
  return 4 * atan2(sqrt(apart), sqrt(together));
}

// The rotation matrix of a quaternion of any length but 0: one that was checked has about 1, a
// slerp's below the sine of half its turn, which is over 1e-7.
/*@ requires \valid_read(q + (0 .. 3)) && \valid(m + (0 .. 8)) && \separated(q + (0 .. 3), m + (0 .. 8));
    assigns m[0 .. 8]; */
static inline void verify__matrix(const double *q, double *m) {
  const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, m[0 .. 8];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    m[4 * i] = 1 - 2 * (q[j] * q[j] + q[k] * q[k]) / square;
    m[3 * i + j] = 2 * (q[i] * q[j] - q[k] * q[3]) / square;
    m[3 * i + k] = 2 * (q[i] * q[k] + q[j] * q[3]) / square;
  }
}

/*@ requires a_path((nsvcd_verify_path *)motion) && \valid(out);
    requires \separated(out, (nsvcd_verify_path *)motion);
    assigns *out; */
static inline void verify__path_place(const void *motion, double t, nsvcd_verify_place *out) {
  const nsvcd_verify_path *p = (const nsvcd_verify_path *)motion;
  const size_t k = verify__pose_before(p, t);
  const double u = verify__share(p, k, p->count > 1 ? verify__knot(p, k) : 0, t);
  const float *a = p->poses + 7 * k;
  const float *b = p->count > 1 ? a + 7 : a;
  double q[4], to[4];
  const double half = 0.5 * verify__turn(p, k, q, to);
  const int turns = half > 1e-7;  // below, a line is as good: a turn off by less than half^3
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, out->at[0 .. 2];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) out->at[i] = (1 - u) * (double)a[i] + u * (double)b[i];
  /*@ loop invariant 0 <= i <= 4;
      loop assigns i, q[0 .. 3];
      loop variant 4 - i; */
  for (int i = 0; i < 4; i++)
    q[i] = turns ? sin((1 - u) * half) * q[i] + sin(u * half) * to[i] : (1 - u) * q[i] + u * to[i];
  verify__matrix(q, out->turn);
}

/*@ requires a_path((nsvcd_verify_path *)motion);
    assigns \nothing; */
static inline double verify__path_next(const void *motion, double t) {
  const nsvcd_verify_path *p = (const nsvcd_verify_path *)motion;
  return p->count > 1 ? verify__knot(p, verify__pose_before(p, t) + 1) : 1;
}

// A turn by h at a constant rate about an axis a has a second derivative of h^2 a x (a x y) at y =
// R x. Along n that is h^2 (n x a).(a x y), no more than h^2 |n x a| rho, and the deviation is an
// eighth of it. The turn from q to q' is about the vector of q^-1 q', as the body has it: off by
// 1e-15 / h, and the deviation by 1e-16 h r for that. The pose before is looked up half way. Where t0
// and t1 are neighbours, half way may be t1 (ties go to even), the knot at the end, and the pose
// one too late. Then t1 - t0 < 1.2e-16, of a stretch of 0.99e-7 at least: a turn by less than 4e-9,
// a true deviation below 2e-18 r, which the margin, 1e-10 r, holds.
/*@ requires a_path((nsvcd_verify_path *)motion) && \valid(deviation + (0 .. 5));
    requires \separated(deviation + (0 .. 5), (nsvcd_verify_path *)motion);
    assigns deviation[1 .. 5]; */
static inline void verify__path_deviation(const void *motion, double t0, double t1,
                                          double *deviation) {
  const nsvcd_verify_path *p = (const nsvcd_verify_path *)motion;
  const size_t k = verify__pose_before(p, 0.5 * (t0 + t1));
  double from[4], to[4];
  const double h = verify__share(p, k, t0, t1) * verify__turn(p, k, from, to);
  double *axis = deviation + 3;
  double square = 0;
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, square, deviation[3 .. 5];
      loop variant 3 - i; */
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3;
    const int l = (i + 2) % 3;
    axis[i] = from[3] * to[i] - to[3] * from[i] - (from[j] * to[l] - from[l] * to[j]);
    square += axis[i] * axis[i];
  }
  /*@ loop invariant 0 <= i <= 3;
      loop assigns i, deviation[3 .. 5];
      loop variant 3 - i; */
  for (int i = 0; i < 3 && square > 0; i++) axis[i] /= sqrt(square);
  if (square > 0)
    deviation[2] = 0.1250001 * h * h;
  else
    deviation[1] = 0.1250001 * h * h;
}

// Makes a mover of a mesh, a scale and a path, which stay. Returns why not, or NULL.
static inline const char *nsvcd_verify_path_init(const nsvcd_verify_mesh *mesh, float scale,
                                                 const nsvcd_verify_path *p,
                                                 nsvcd_verify_mover *mover) {
  const int timed = p->times && p->count > 1;
  if (p->count < 1 || p->count > 65536) return "a path has no poses, or too many";
  if (!(verify__within(scale, 1e6f) && scale >= 1e-6f)) return "a scale is out of range";
  for (size_t i = 0; i < 7 * p->count; i++) {
    if (!verify__within(p->poses[i], 1e6f)) return "a pose is out of range";
  }
  for (size_t k = 0; timed && k < p->count; k++) {
    if (!verify__within(p->times[k], 1)) return "times are not 0 to 1";
  }
  for (size_t k = 0; k < p->count; k++) {
    const float *q = p->poses + 7 * k + 3;
    double square = 0;
    for (int i = 0; i < 4; i++) square += (double)q[i] * (double)q[i];
    if (!(fabs(square - 1) < 2.1e-4)) return "a quaternion is not of unit length";
    if (timed && k > 0 && !((double)p->times[k] - (double)p->times[k - 1] >= 0.99e-7))
      return "times do not rise";
  }
  if (timed && (p->times[0] != 0 || p->times[p->count - 1] != 1)) return "times are not 0 to 1";
  mover->mesh = mesh;
  mover->scale = (double)scale;
  mover->place = verify__path_place;
  mover->next = verify__path_next;
  mover->deviation = verify__path_deviation;
  mover->motion = p;
  mover->clock = NULL;
  mover->base = 0;
  mover->reach = 0;
  for (size_t k = 0; k < p->count; k++) {
    const float *at = p->poses + 7 * k;
    const double far_off = fabs((double)at[0]) + fabs((double)at[1]) + fabs((double)at[2]);
    mover->reach = verify__max(mover->reach, far_off);
  }
  mover->digest = verify__hash((uint32_t)p->count, p->poses, 7 * p->count);
  mover->digest = verify__hash(mover->digest, &scale, 1);
  if (timed) mover->digest = verify__hash(mover->digest, p->times, p->count);
  return NULL;
}
#endif  // NSVCD_VERIFY_SCENE_H
