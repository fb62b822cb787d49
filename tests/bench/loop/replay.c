// replay.c - the loop's certificates, replayed in double by arithmetic that is not its own.
// usage: replay [--both] [--press N] [--remote N] [--poses N] [--limit N]
//     [--first SHARE] [--clearance METRES] [--seed N] FILE.txt ...   (files as build/problems makes them)
// Whenever the loop says that a plane parts what is at two places of its trees over a stretch of
// time, this hears of it, and holds the plane against the meshes' own corners at poses of its own,
// at both ends of that time and some times between: all corners of one side have to be above all of
// the other. Some pairs of triangles of each problem are watched, half of them near each other:
// where the verdict is free, what parts them has to cover all of [0,1] without a hole. Witnesses'
// triangles have to be as near as the quanta say. --press: the bodies are pressed together, in N
// halvings of the way, until free and hit are that near to each other: there roundings and quanta
// matter. --poses: only so many of each motion. --first, --clearance: answers are held against
// nsvcd_sweep's too: statuses alike, and what both prove of the first contact has to agree. --remote: meshes are N times their size from their origins. From the loop come only the planes and which
// triangles (by number) are at a place of a tree. Exits with 1 if anything is wrong.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../../neuralsvcd.h"
#define PROGRAM "replay"
#include "../../../examples/scenery/problem_file.h"
#define CHECK_EQ(a, b) ((void)((a) == (b)))  // of proof_scene.h, nothing that is used here
#include "../../proof_scene.h"
#include "../../../examples/scenery/status_of.h"

#include "lanes.h"
struct loop;
struct span;
static void replay_axis(uint32_t from, lanes gap, lanes3 n);
static void replay_lanes(const struct loop *p, const struct span *s, uint32_t parted, const void *a,
                         uint32_t in_a, const void *b, uint32_t in_b);
static void replay_best(const struct loop *p, const struct span *s, const void *a, uint32_t l_a,
                        const void *b, uint32_t l_b, int parted);
static void replay_plane(const struct loop *p, const struct span *s, const void *a, uint32_t in_a,
                         const void *b, uint32_t in_b, nsvcd__d3 n);
static void replay_arcs(const struct loop *p, const struct span *s, uint64_t met, uint32_t place_a,
                        uint32_t place_b);
#define LOOP_AXIS replay_axis
#define LOOP_CERTIFY replay_lanes
#define LOOP_CERTIFY_BEST replay_best
#define LOOP_CERTIFY_PLANE replay_plane
#define LOOP_CERTIFY_ARCS replay_arcs
#include "build.h"
#include "inside.h"

#define PROBES 128   // pairs of triangles that are watched
#define MOST_AXES 32
#define TIMES 5
#define ALL_CHECKED 3000  // of a problem's certificates; of more than that one in eight

// A body as it is here: the mesh, and which of its triangles are where.
typedef struct replay_body {
  const nsvcd_body *old;
  tree_body *tree;
  nsvcd_mesh mesh;
  unsigned char *is_leaf;  // words
  uint32_t *leaf_of;  // of each triangle: the word of its leaf, and the lane; 0: none
  double size;
  float shift;  // of the mesh, along each axis
} replay_body;

typedef struct interval {
  double start, end;
} interval;

// A pair of triangles: the places that they are at, from the top down to leaf and lane.
typedef struct probe {
  uint32_t path[2][12];
  interval *parted;
  size_t count, capacity;
} probe;

static struct {
  const replay_body *body[2];
  const nsvcd_mover *mover[2];
  double size;
  shapes_rng rng;
  probe probes[PROBES];
  struct {
    uint32_t from;
    lanes gap;
    lanes3 n;
  } axes[MOST_AXES];
  uint32_t axis_count;
  size_t here;  // certificates of this problem
  // of all
  size_t heard, checked, wrong, unexplained, by_kind[6], wrong_kind[6];
  size_t watched, bare, witnesses, wrong_witnesses;
  // questions: as those below; what nsvcd_sweep says of them too
  float first, clearance;
  double apart;  // the clearance, in units of the second body
  size_t asked, unlike, late, loose;
  double nearest, farthest;  // least gap of a certificate; witnesses' greatest distance over quanta
  int kind;
} heard;

static const char *const kinds[6] = {"children", "triangles", "couple, float", "plane", "arcs", ""};

// ---- the true motion

static oracle_pose pose_at(const nsvcd_mover *m, double t) {
  if (m->count == 1)
    return pose_widened(m->poses);
  const double at = t * (double)(m->count - 1);
  const size_t last = m->count - 2;
  const size_t k = at <= 0 ? 0 : (size_t)at < last ? (size_t)at : last;
  const oracle_pose a = pose_widened(&m->poses[k]);
  const oracle_pose b = pose_widened(&m->poses[k + 1]);
  const double f = at - (double)k;
  double product = 0;
  double apart = 0;
  double together = 0;
  double q[4];
  for (int i = 0; i < 4; i++)
    product += (double)m->poses[k].rotation[i] * (double)m->poses[k + 1].rotation[i];
  for (int i = 0; i < 4; i++) {
    q[i] = product < 0 ? -b.rotation[i] : b.rotation[i];
    apart += (q[i] - a.rotation[i]) * (q[i] - a.rotation[i]);
    together += (q[i] + a.rotation[i]) * (q[i] + a.rotation[i]);
  }
  const double half = 2 * atan2(sqrt(apart), sqrt(together));
  const double before = half > 1e-9 ? sin((1 - f) * half) / sin(half) : 1 - f;
  const double after = half > 1e-9 ? sin(f * half) / sin(half) : f;
  oracle_pose out;
  for (int i = 0; i < 4; i++)
    out.rotation[i] = before * a.rotation[i] + after * q[i];
  for (int i = 0; i < 3; i++)
    out.position[i] = a.position[i] + f * (b.position[i] - a.position[i]);
  oracle_quat_normalize(out.rotation);
  return out;
}

// From the mesh of the first to that of the second.
static proof_place place_at(double t) {
  const oracle_pose moving = pose_at(heard.mover[0], t);
  const oracle_pose fixed = pose_at(heard.mover[1], t);
  const double unit = (double)heard.mover[1]->scale;
  proof_place at = proof_relative(&moving, &fixed);
  for (int k = 0; k < 9; k++)
    at.matrix[k] *= (double)heard.mover[0]->scale / unit;
  for (int k = 0; k < 3; k++)
    at.position[k] /= unit;
  return at;
}

static void corner_of(const replay_body *b, uint32_t triangle, size_t k, double *out) {
  const float *x = b->mesh.positions + 3 * (size_t)b->mesh.indices[3 * (size_t)triangle + k];
  for (int c = 0; c < 3; c++)
    out[c] = (double)x[c];
}

// ---- certificates

// Greatest and least height of all that is at a place.
static void reach_along(const replay_body *b, uint32_t word, uint32_t lanes_in, int is_leaf,
                        const double *n, double *low, double *high) {
  const tree_body *tree = b->tree;
  for (uint32_t left = lanes_in; left; left &= left - 1) {
    const unsigned l = lowest_bit(left);
    if (!is_leaf) {
      const uint32_t link = node_at(tree, word)->links[l];
      const uint32_t to = link & ~LEAF_LINK;
      const int leads_to_leaf = (link & LEAF_LINK) != 0;
      const uint32_t count = leads_to_leaf ? ((const tree_leaf *)body_at(tree, to))->count
                                           : node_at(tree, to)->count;
      reach_along(b, to, first_lanes(count), leads_to_leaf, n, low, high);
      continue;
    }
    const uint32_t number = leaf_number(tree, (const tree_leaf *)body_at(tree, word), l);
    for (size_t k = 0; k < 3; k++) {
      double x[3];
      corner_of(b, number, k, x);
      const double height = oracle_dot(n, x);
      *low = fmin(*low, height);
      *high = fmax(*high, height);
    }
  }
}

// The least gap over some times, with the same side above at all of them.
static double least_gap(const uint32_t *words, const uint32_t *in, const int *leaf, double start,
                        double end, const double *n) {
  double above = HUGE_VAL;
  double below = HUGE_VAL;
  double rest[2] = {HUGE_VAL, -HUGE_VAL};
  reach_along(heard.body[1], words[1], in[1], leaf[1], n, &rest[0], &rest[1]);
  for (int k = 0; k < TIMES; k++) {
    const double share = k < 3 ? 0.5 * k : shapes_uniform(&heard.rng, 0, 1);
    const proof_place at = place_at(start + share * (end - start));
    double turned[3];
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    oracle_rotate_back(at.matrix, n, turned);
    reach_along(heard.body[0], words[0], in[0], leaf[0], turned, &low, &high);
    const double height = oracle_dot(n, at.position);
    above = fmin(above, low + height - rest[1]);
    below = fmin(below, rest[0] - high - height);
  }
  return fmax(above, below);
}

// Is one of the probe's places on a side among these?
static int holds(const uint32_t *path, uint32_t word, uint32_t in) {
  for (; *path; path += 2) {
    if (path[0] == word)
      return in >> path[1] & 1;
  }
  return 0;
}

static void certificate(const loop *p, double start, double end, const void *a, uint32_t in_a,
                        const void *b, uint32_t in_b, const double *n) {
  const uint32_t words[2] = {(uint32_t)((const uint32_t *)a - (const uint32_t *)(const void *)p->a),
                             (uint32_t)((const uint32_t *)b - (const uint32_t *)(const void *)p->b)};
  const uint32_t in[2] = {in_a, in_b};
  if (!in_a || !in_b)
    return;
  const int leaf[2] = {heard.body[0]->is_leaf[words[0]], heard.body[1]->is_leaf[words[1]]};
  if (heard.kind == 0 && (leaf[0] || leaf[1]))
    heard.kind = 1;
  heard.heard++;
  heard.by_kind[heard.kind]++;
  for (size_t i = 0; i < PROBES; i++) {
    probe *w = &heard.probes[i];
    if (!holds(w->path[0], words[0], in_a) || !holds(w->path[1], words[1], in_b))
      continue;
    w->parted = (interval *)room_for_one(w->parted, w->count, &w->capacity, sizeof *w->parted);
    w->parted[w->count].start = start;
    w->parted[w->count++].end = end;
  }
  if (heard.here++ > ALL_CHECKED && shapes_pick(&heard.rng, 8))
    return;
  heard.checked++;
  const double distance = least_gap(words, in, leaf, start, end, n) / oracle_length(n);
  const double gap = (distance - heard.apart) / heard.size;
  if (!(gap > 0)) {
    heard.wrong++;
    heard.wrong_kind[heard.kind]++;
  }
  heard.nearest = fmin(heard.nearest, gap);
}

static void replay_axis(uint32_t from, lanes gap, lanes3 n) {
  if (heard.axis_count == MOST_AXES)
    exit(1);
  heard.axes[heard.axis_count].from = from;
  heard.axes[heard.axis_count].gap = gap;
  heard.axes[heard.axis_count++].n = n;
}

// Of lane l, the first axis that parts. NULL: none.
static const double *first_axis(uint32_t l) {
  static double n[3];
  for (uint32_t k = 0; k < heard.axis_count; k++) {
    if (heard.axes[k].from != l / LANES * LANES || !(heard.axes[k].gap[l % LANES] > 0))
      continue;
    n[0] = (double)heard.axes[k].n.x[l % LANES];
    n[1] = (double)heard.axes[k].n.y[l % LANES];
    n[2] = (double)heard.axes[k].n.z[l % LANES];
    return n;
  }
  heard.unexplained++;
  return NULL;
}

static void replay_lanes(const loop *p, const span *s, uint32_t parted, const void *a,
                         uint32_t in_a, const void *b, uint32_t in_b) {
  double start;
  double end;
  span_times(&p->m, s, &start, &end);
  heard.kind = 0;
  for (; parted; parted &= parted - 1) {
    const uint32_t l = lowest_bit(parted);
    const double *n = first_axis(l);
    if (n)
      certificate(p, start, end, a, in_a ? in_a : 1u << l, b, in_b ? in_b : 1u << l, n);
  }
  heard.axis_count = 0;
}

static void replay_best(const loop *p, const span *s, const void *a, uint32_t l_a, const void *b,
                        uint32_t l_b, int parted) {
  double start;
  double end;
  const lanes gap = heard.axes[0].gap;
  const lanes3 *all = &heard.axes[0].n;
  const unsigned l = lowest_bit(~lanes_above(lanes_set(lanes_most(gap)), gap));
  const double n[3] = {(double)all->x[l], (double)all->y[l], (double)all->z[l]};
  span_times(&p->m, s, &start, &end);
  heard.axis_count = 0;
  heard.kind = 2;
  if (parted)
    certificate(p, start, end, a, 1u << l_a, b, 1u << l_b, n);
}

static void replay_plane(const loop *p, const span *s, const void *a, uint32_t in_a, const void *b,
                         uint32_t in_b, nsvcd__d3 n) {
  double start;
  double end;
  span_times(&p->m, s, &start, &end);
  heard.kind = 3;
  certificate(p, start, end, a, in_a, b, in_b, &n.x);
}

static void replay_arcs(const loop *p, const span *s, uint64_t met, uint32_t place_a,
                        uint32_t place_b) {
  const double ticks = (double)p->m.of->ticks;
  heard.kind = 4;
  for (uint32_t k = 0; k < s->last - s->first; k++) {
    if (met >> k & 1)
      continue;
    const double *n = first_axis(k);
    if (n)
      certificate(p, (double)p->m.knots.tick[s->first + k] / ticks,
                  (double)p->m.knots.tick[s->first + k + 1] / ticks, node_at(p->a, place_a >> 4),
                  1u << (place_a & 15), node_at(p->b, place_b >> 4), 1u << (place_b & 15), n);
  }
  heard.axis_count = 0;
}

// ---- bodies and probes

static void find_leaves(replay_body *b, uint32_t link) {
  const uint32_t word = link & ~LEAF_LINK;
  if (!(link & LEAF_LINK)) {
    for (uint32_t k = 0; k < node_at(b->tree, word)->count; k++)
      find_leaves(b, node_at(b->tree, word)->links[k]);
    return;
  }
  const tree_leaf *leaf = (const tree_leaf *)body_at(b->tree, word);
  b->is_leaf[word] = 1;
  for (unsigned l = 0; l < leaf->count; l++) {
    uint32_t *of = &b->leaf_of[leaf_number(b->tree, leaf, l)];
    if (*of)
      complain("a triangle is in two places: bodies are not to be cut here"), exit(1);
    *of = word << 4 | l;
  }
}

static int load_body(const char *path, float remote, replay_body *out) {
  nsvcd_encode_options options;
  memset(&options, 0, sizeof options);
  memset(out, 0, sizeof *out);
  if (nsvcd_obj_load(path, NULL, &out->mesh, NULL))
    return complain("%s: cannot be read", path);
  for (size_t k = 0; k < 3 * out->mesh.vertex_count; k++)
    out->shift = fmaxf(out->shift, remote * fabsf(out->mesh.positions[k]));
  for (size_t k = 0; k < 3 * out->mesh.vertex_count; k++)
    out->mesh.positions[k] += out->shift;
  if (nsvcd_encode(&out->mesh, &options, NULL, NULL, 0, &out->old))
    return complain("%s: cannot be encoded", path);
  out->tree = build_body(&out->mesh, &default_cut);
  out->leaf_of = (uint32_t *)calloc(out->mesh.triangle_count, sizeof *out->leaf_of);
  out->is_leaf = (unsigned char *)calloc(out->tree->bytes / 4 + 1, 1);
  if (!out->leaf_of || !out->is_leaf)
    return 0;
  find_leaves(out, out->tree->top);
  for (size_t t = 0; t < out->mesh.triangle_count; t++) {
    if (!out->leaf_of[t])
      return complain("%s: triangle %zu is nowhere", path, t);
  }
  for (int k = 0; k < 3; k++)
    out->size = fmax(out->size, (double)(out->tree->high[k] - out->tree->low[k]));
  return 1;
}

// The way from a node to a leaf's lane: words and slots. 0: not there.
static int find_path(const replay_body *b, uint32_t word, uint32_t leaf_lane, uint32_t *out) {
  const tree_node *node = node_at(b->tree, word);
  out[0] = word;
  for (uint32_t k = 0; k < node->count; k++) {
    out[1] = k;
    if (node->links[k] & LEAF_LINK) {
      if ((node->links[k] & ~LEAF_LINK) != leaf_lane >> 4)
        continue;
      out[2] = leaf_lane >> 4;
      out[3] = leaf_lane & 15;
      out[4] = 0;
      return 1;
    }
    if (find_path(b, node->links[k], leaf_lane, out + 2))
      return 1;
  }
  return 0;
}

// Half of the pairs are the nearest of some, at some time.
static void choose_probes(void) {
  for (size_t i = 0; i < PROBES; i++) {
    probe *w = &heard.probes[i];
    const proof_place at = place_at(shapes_uniform(&heard.rng, 0, 1));
    uint32_t best[2] = {0, 0};
    double least = HUGE_VAL;
    for (size_t trial = 0; trial < (i % 2 ? 1 : 300); trial++) {
      uint32_t t[2];
      double x[3], y[3], placed[3], d[3];
      for (int side = 0; side < 2; side++)
        t[side] =
            (uint32_t)shapes_pick(&heard.rng, (int)heard.body[side]->mesh.triangle_count);
      corner_of(heard.body[0], t[0], (size_t)shapes_pick(&heard.rng, 3), x);
      corner_of(heard.body[1], t[1], (size_t)shapes_pick(&heard.rng, 3), y);
      proof_apply(&at, x, placed);
      oracle_sub(placed, y, d);
      if (oracle_length(d) >= least)
        continue;
      least = oracle_length(d);
      best[0] = t[0];
      best[1] = t[1];
    }
    w->count = 0;
    for (int side = 0; side < 2; side++) {
      const replay_body *b = heard.body[side];
      if (!find_path(b, b->tree->top, b->leaf_of[best[side]], w->path[side]))
        exit(1);
    }
  }
}

static int compare_intervals(const void *a, const void *b) {
  const double x = ((const interval *)a)->start;
  const double y = ((const interval *)b)->start;
  return x < y ? -1 : x > y;
}

// Pairs whose certificates leave a hole before `until`.
static void check_cover(double until) {
  for (size_t i = 0; i < PROBES; i++) {
    probe *w = &heard.probes[i];
    double covered = 0;
    qsort(w->parted, w->count, sizeof *w->parted, compare_intervals);
    for (size_t k = 0; k < w->count && w->parted[k].start <= covered + 1e-12; k++)
      covered = fmax(covered, w->parted[k].end);
    heard.watched++;
    heard.bare += !w->count || covered < until - 1e-12;
  }
}

// A triangle, posed at t where it is that of the first body.
static void true_triangle(int side, uint32_t number, const proof_place *at, oracle_triangle *out) {
  for (size_t k = 0; k < 3; k++) {
    double x[3];
    corner_of(heard.body[side], number, k, x);
    memcpy(out->v[k], x, sizeof x);
    if (!side)
      proof_apply(at, x, out->v[k]);
  }
  oracle_triangle_normal(out);
}

static void check_witness(double t, uint32_t number_a, uint32_t number_b) {
  const proof_place at = place_at(t);
  const double scale = (double)heard.mover[0]->scale / (double)heard.mover[1]->scale;
  oracle_triangle a, b;
  double on_a[3], on_b[3];
  true_triangle(0, number_a, &at, &a);
  true_triangle(1, number_b, &at, &b);
  const double distance = sqrt(oracle_triangles(&a, &b, DBL_MAX, on_a, on_b)) - heard.apart;
  const double quanta = scale * (double)heard.body[0]->tree->quantum +
                        (double)heard.body[1]->tree->quantum + 1e-9 * heard.size;
  heard.witnesses++;
  heard.wrong_witnesses += !(distance <= quanta);
  heard.farthest = fmax(heard.farthest, distance / quanta);
}

// ---- problems

typedef struct verdicts {
  size_t count, right, wrong, undecided, far;
} verdicts;

// The other body moves a little too.
static void drift_along(nsvcd_question *q, const nsvcd_pose *rest, size_t n, nsvcd_pose *drift) {
  for (int k = 0; k < 4; k++) {
    const float turn = 0.05f * (float)k * (n % 2 ? 1 : -1);
    const float *r = rest->rotation;
    const float c = cosf(turn);
    const float t = sinf(turn);
    drift[k] = *rest;
    drift[k].position[k % 3] += 0.003f * (float)k;
    drift[k].rotation[0] = c * r[0] - t * r[1];
    drift[k].rotation[1] = c * r[1] + t * r[0];
    drift[k].rotation[2] = c * r[2] + t * r[3];
    drift[k].rotation[3] = c * r[3] - t * r[2];
  }
  q->b.poses = drift;
  q->b.count = 4;
}

// Free and witness, where both decide; [free_until, time] of both have to meet, and be as short as
// asked unless there was doubt.
static void compare_answers(const nsvcd_question *q, const loop_answer *now) {
  const size_t size = nsvcd_sweep_workspace_size(q);
  void *workspace = allocate(size);
  nsvcd_answer old;
  nsvcd_question asked = *q;
  asked.method = NSVCD_METHOD_PROOF;
  if (nsvcd_sweep(&asked, workspace, size, &old))
    exit(1);
  free(workspace);
  static const status wanted[4] = {STATUS_CERTIFIED_FREE, STATUS_WITNESS, STATUS_INSIDE,
                                   STATUS_UNDECIDED};
  heard.asked++;
  const int is_late = now->verdict == LOOP_HIT && status_of(&old) == STATUS_WITNESS &&
                      (now->free_until > (double)contact_time_of(&old) + 3e-7 ||
                       (double)old.time.low > now->time + 3e-7);
  const int is_hit = now->verdict == LOOP_HIT || now->verdict == LOOP_INSIDE;
  const int was_hit = old.verdict == NSVCD_HIT;
  // a body that both meets and is within is either
  const int unlike = wanted[now->verdict] != status_of(&old) && !(is_hit && was_hit);
  heard.unlike += unlike;
  if (unlike || (is_late && heard.first > 0))
    printf("  unlike: the loop says %d at %.9g free until %.9g, nsvcd_sweep %s at %.9g until %.9g\n",
           (int)now->verdict, now->time, now->free_until, status_string(status_of(&old)),
           (double)contact_time_of(&old), (double)old.time.low);
  if (now->verdict != LOOP_HIT || status_of(&old) != STATUS_WITNESS || !(heard.first > 0))
    return;
  // its time is a float
  const double hair = 3e-7;
  heard.late += is_late;
  heard.loose += now->time - now->free_until > (double)heard.first + hair;
}

static loop_verdict replay_problem(const nsvcd_question *q, const replay_body *a, const replay_body *b,
                           int label, verdicts *sum) {
  const int swapped = nsvcd__is_swapped(&q->a, &q->b);
  const size_t before = heard.heard;
  void *memory = NULL;
  loop_answer now;
  heard.body[0] = swapped ? b : a;
  heard.body[1] = swapped ? a : b;
  heard.mover[0] = swapped ? &q->b : &q->a;
  heard.mover[1] = swapped ? &q->a : &q->b;
  heard.size = (double)heard.mover[0]->scale / (double)heard.mover[1]->scale * heard.body[0]->size +
               heard.body[1]->size;
  heard.apart = (double)heard.clearance / (double)heard.mover[1]->scale;
  heard.here = 0;
  heard.axis_count = 0;
  choose_probes();
  if (posix_memalign(&memory, 64, loop_memory((uint32_t)(q->a.count + q->b.count + 6))))
    exit(1);
  if (!loop_sweep(q, a->tree, b->tree, memory, &now))
    exit(1);
  const int hit = now.verdict == LOOP_HIT || now.verdict == LOOP_INSIDE;
  sum->count++;
  sum->undecided += now.verdict == LOOP_UNDECIDED;
  sum->right += now.verdict != LOOP_UNDECIDED && (label < 0 || hit == label);
  sum->wrong += now.verdict != LOOP_UNDECIDED && label >= 0 && hit != label;
  sum->far += heard.heard == before;
  if (q->ask == NSVCD_ASK_FIRST || q->clearance > 0)
    compare_answers(q, &now);
  if (now.verdict == LOOP_HIT && now.free_until > 0 && heard.heard > before)
    check_cover(now.free_until);
  if (now.verdict == LOOP_FREE && heard.heard > before)
    check_cover(q->a.count + q->b.count > 2 ? 1 : 0);
  if (now.verdict == LOOP_HIT)
    check_witness(now.time, swapped ? now.triangle_b : now.triangle_a,
                  swapped ? now.triangle_a : now.triangle_b);
  free(memory);
  return now.verdict;
}

// Poses of a mesh that has been shifted, so that it stays where it was at these.
static nsvcd_pose *shift_poses(const nsvcd_mover *m, const replay_body *b) {
  nsvcd_pose *out = (nsvcd_pose *)allocate(m->count * sizeof *out);
  const double by = (double)m->scale * (double)b->shift;
  const double shift[3] = {by, by, by};
  for (size_t i = 0; i < m->count; i++) {
    const oracle_pose pose = pose_widened(&m->poses[i]);
    double matrix[9], moved[3];
    oracle_matrix(pose.rotation, matrix);
    oracle_rotate(matrix, shift, moved);
    out[i] = m->poses[i];
    for (int k = 0; k < 3; k++)
      out[i].position[k] = (float)(pose.position[k] - moved[k]);
  }
  return out;
}

// Between where it is free and where it is not; way: from a to b.
static void press_problem(const nsvcd_question *q, const replay_body *a, const replay_body *b,
                          const float *towards, size_t times, verdicts *sum) {
  nsvcd_question pressed = *q;
  nsvcd_pose *poses = (nsvcd_pose *)allocate(q->a.count * sizeof *poses);
  double free_at = 0;
  double way = 0.5;
  pressed.a.poses = poses;
  for (size_t n = 0; n < times; n++, way *= 0.5) {
    const double to = free_at + way;
    for (size_t i = 0; i < q->a.count; i++) {
      poses[i] = q->a.poses[i];
      for (int k = 0; k < 3; k++)
        poses[i].position[k] += (float)to * towards[k];
    }
    if (replay_problem(&pressed, a, b, -1, sum) == LOOP_FREE)
      free_at = to;
  }
  free(poses);
}

static nsvcd_pose *some_poses(const nsvcd_mover *m, size_t count) {
  nsvcd_pose *out = (nsvcd_pose *)allocate(count * sizeof *out);
  for (size_t i = 0; i < count; i++)
    out[i] = m->poses[i * (m->count - 1) / (count - 1)];
  return out;
}

static int replay_file(const char *name, size_t limit, int both, size_t press, float remote,
                       size_t fewer) {
  problem_file file;
  verdicts sum;
  memset(&sum, 0, sizeof sum);
  if (!read_problems(name, &file))
    return 0;
  replay_body *all = (replay_body *)allocate(file.mesh_count * sizeof *all);
  for (size_t i = 0; i < file.mesh_count; i++) {
    char path[4096];
    const char *slash = strrchr(name, '/');
    snprintf(path, sizeof path, "%.*s%s", slash ? (int)(slash - name + 1) : 0, name,
             file.meshes[i].path);
    if (!load_body(path, remote, &all[i]))
      return 0;
  }
  for (size_t n = 0; n < file.problem_count && n < limit; n++) {
    const problem *p = &file.problems[n];
    nsvcd_question q = question_of_problem(&file, p);
    nsvcd_pose drift[4];
    q.ask = heard.first > 0 ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
    q.to_time = heard.first;
    q.clearance = heard.clearance;
    if (fewer && fewer < q.a.count)
      q.a.poses = some_poses(&q.a, fewer), q.a.count = fewer;
    q.a.body = all[p->moving].old;
    q.b.body = all[p->fixed].old;
    if (both)
      drift_along(&q, &p->fixed_pose, n, drift);
    float towards[3];
    for (int k = 0; k < 3; k++)
      towards[k] = q.b.poses->position[k] - q.a.poses[q.a.count / 2].position[k];
    if (remote > 0) {
      q.a.poses = shift_poses(&q.a, &all[p->moving]);
      q.b.poses = shift_poses(&q.b, &all[p->fixed]);
    }
    if (press)
      press_problem(&q, &all[p->moving], &all[p->fixed], towards, press, &sum);
    else
      replay_problem(&q, &all[p->moving], &all[p->fixed], both || remote > 0 || fewer || heard.clearance > 0 ? -1 : p->label, &sum);
  }
  printf("%s: %zu problems: %zu right, %zu wrong, %zu undecided; %zu without a certificate\n", name,
         sum.count, sum.right, sum.wrong, sum.undecided, sum.far);
  free_problems(&file);
  return sum.wrong == 0;
}

int main(int argc, char **argv) {
  size_t limit = (size_t)-1;
  size_t press = 0;
  float remote = 0;
  size_t fewer = 0;
  int both = 0;
  int good = 1;
  heard.nearest = HUGE_VAL;
  heard.rng.state = 1;
  for (int i = 1; i < argc; i++) {
    if (!strcmp(argv[i], "--limit"))
      limit = (size_t)atoi(argv[++i]);
    else if (!strcmp(argv[i], "--seed"))
      heard.rng.state = (uint64_t)atoi(argv[++i]);
    else if (!strcmp(argv[i], "--poses"))
      fewer = (size_t)atoi(argv[++i]);
    else if (!strcmp(argv[i], "--first"))
      heard.first = (float)atof(argv[++i]);
    else if (!strcmp(argv[i], "--clearance"))
      heard.clearance = (float)atof(argv[++i]);
    else if (!strcmp(argv[i], "--remote"))
      remote = (float)atof(argv[++i]);
    else if (!strcmp(argv[i], "--press"))
      press = (size_t)atoi(argv[++i]);
    else if (!strcmp(argv[i], "--both"))
      both = 1;
    else
      good &= replay_file(argv[i], limit, both, press, remote, fewer);
  }
  printf("certificates: %zu heard, %zu checked at %d times, %zu wrong, %zu without a plane; "
         "least gap %.2g of both sizes\n",
         heard.heard, heard.checked, TIMES, heard.wrong, heard.unexplained, heard.nearest);
  for (int k = 0; k < 5; k++)
    printf("  %s: %zu heard, %zu wrong\n", kinds[k], heard.by_kind[k], heard.wrong_kind[k]);
  printf("cover: %zu pairs of triangles watched, %zu with a hole\n", heard.watched, heard.bare);
  printf("witnesses: %zu, %zu too far apart; at most %.2g of the quanta\n", heard.witnesses,
         heard.wrong_witnesses, heard.farthest);
  if (heard.asked)
    printf("nsvcd_sweep: %zu asked too: %zu unlike; first contacts: %zu that cannot both be, %zu "
           "not as near as asked\n",
           heard.asked, heard.unlike, heard.late, heard.loose);
  good &= !heard.late && !heard.wrong && !heard.unexplained && !heard.bare && !heard.wrong_witnesses;
  return !good;
}
