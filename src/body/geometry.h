// In: the surface of each patch. Out: the proof's blob, and what it says of a patch.
//
// A body of triangles. Its spheres are the least ones about the surface in each patch. Behind them:
//
//   counts          nsvcd__counts
//   box             (2, 3)   float: least and greatest coordinates of the surface
//   widest          (2)      float: the greatest of `errors`; and how far the mesh's vertices are
//                            off, metres: 0, except in bodies that are scaled or coarse
//   balls           (4, A)   float: balls that cover the mesh; A: their count, rounded up to 16,
//                            padding as above; each 16 are neighbours
//   clusters        (4, A')  float: spheres over 16 balls each; A': as G of A
//   slabs           (6, P)   float: normal n, low, high, across: points x of a piece have
//                            low <= n.(x - c) <= high and are within `across` of the line along n
//                            through c, the centre of the patch's sphere
//   group slabs     (6, G)   float: the same over the members of a group; c: its sphere's centre
//   steps           (P)      float: metres per integer: a stored point is c + step (x, y, z)
//   margins         (P)      float: pieces are within this of the hull of the first points
//   errors          (P)      float: corners that are stored points are within this of the mesh's
//   first_vertex, first_own, first_reference, first_triangle, first_byte
//                   (5, N + 1) uint32: where a patch's stored points, the vertices that no patch
//                            before it has, its references to others, its entries and their bytes
//                            begin
//   first_seed      (G' + 1) uint32: where a group's seeds begin; G': groups without padding
//   seeds           (C, 3)   float: a point of each component, group by group, in the group's
//                            sphere
//   positions       (W, 3)   float: the mesh's vertices as the caller gave them, each position
//                            once: first those that patches own, then those of no patch
//   cut             (K)      uint32: the caller's triangles that are stored in pieces, ascending
//   cut_corners     (K, 3)   uint32: their corners, numbers of vertices
//   references      (R)      uint32, or uint16 if W <= 65536: patch by patch, numbers of vertices
//                            that an earlier patch owns
//   vertices        (3 V)    int16: patch by patch x, y, z of its stored points: those of the hull,
//                            then corners of pieces
//                   (16)     int16: padding, so that 16 can be read from any point on
//   entries         (B)      bytes: of each patch's T triangles
//     corners       (T, 3)   uint8, or uint16 in patches of more than 256 points: numbers in the
//                            patch of its stored points, its own vertices, its references. An
//                            entry of vertices alone is a triangle of the caller's; any other is a
//                            piece of one
//     numbers       (T)      each in 1 to 5 bytes: see nsvcd__read_code
//   hull_counts     (N)      uint8: vertices of the hull, at most 16; 0: the patch has no surface
#pragma once
#include "covering.h"
#include "traversal.h"

#define NSVCD__HULLS (NSVCD__GROUP * NSVCD__HULL)  // vertices of a group, at most
// Where everything is in a body of triangles. Only who builds or scales one writes through this.
typedef struct nsvcd__geometry {
  nsvcd_body *body;
  nsvcd__counts *counts;
  float *box, *balls, *slabs, *group_slabs, *steps, *margins, *errors, *seeds, *positions;
  uint32_t *first_vertex, *first_own, *first_reference, *first_triangle, *first_byte;
  uint32_t *first_seed, *cut, *cut_corners;
  unsigned char *references;
  int16_t *vertices;
  unsigned char *entries;
  uint8_t *hull_counts;
  // of each: 2 or 4
  size_t reference_bytes;
  // of an entry's code: 1 or 2
  unsigned kind_bits;
} nsvcd__geometry;

// The next `count` numbers in a body; NULL: only counts them.
#define NSVCD__PASS(type, count) ((type *)nsvcd__pass(body, &at, count, sizeof(type)))
static void *nsvcd__pass(nsvcd_body *body, uint64_t *at, uint64_t count, size_t size) {
  void *out = body ? (char *)body + *at : NULL;
  *at += count * size;
  return out;
}

// Lays out a body of `patches` patches; NULL: only finds its size. Returns that, or 0 if it takes
// more than 32 bits.
static size_t nsvcd__geometry_layout(nsvcd_body *body, size_t patches,
                                     const nsvcd__counts *counts, nsvcd__geometry *f) {
  const size_t padded = nsvcd__round_up(patches, NSVCD__GROUP);
  const size_t starts = patches + 1;
  uint64_t at = nsvcd__spheres_size(padded);
  f->body = body;
  f->reference_bytes = counts->positions <= 65536 ? 2 : 4;
  f->kind_bits = 1 + (counts->is_mixed != 0);
  f->counts = NSVCD__PASS(nsvcd__counts, 1);
  f->box = NSVCD__PASS(float, NSVCD__GEOMETRY_BOX);
  f->balls = NSVCD__PASS(float, 4 * nsvcd__ball_slots(counts));
  f->slabs = NSVCD__PASS(float, 6 * padded);
  f->group_slabs = NSVCD__PASS(float, 6 * nsvcd__group_slots(padded));
  f->steps = NSVCD__PASS(float, padded);
  f->margins = NSVCD__PASS(float, padded);
  f->errors = NSVCD__PASS(float, padded);
  f->first_vertex = NSVCD__PASS(uint32_t, starts);
  f->first_own = NSVCD__PASS(uint32_t, starts);
  f->first_reference = NSVCD__PASS(uint32_t, starts);
  f->first_triangle = NSVCD__PASS(uint32_t, starts);
  f->first_byte = NSVCD__PASS(uint32_t, starts);
  f->first_seed = NSVCD__PASS(uint32_t, padded / NSVCD__GROUP + 1);
  f->seeds = NSVCD__PASS(float, (uint64_t)3 * counts->components);
  f->positions = NSVCD__PASS(float, (uint64_t)3 * counts->positions);
  f->cut = NSVCD__PASS(uint32_t, counts->cut);
  f->cut_corners = NSVCD__PASS(uint32_t, (uint64_t)3 * counts->cut);
  const uint64_t references = (uint64_t)f->reference_bytes * counts->references;
  f->references = NSVCD__PASS(unsigned char, references);
  f->vertices = NSVCD__PASS(int16_t, (uint64_t)3 * counts->vertices + NSVCD__LANES);
  f->entries = NSVCD__PASS(unsigned char, counts->entry_bytes);
  f->hull_counts = NSVCD__PASS(uint8_t, patches);
  at += NSVCD_ALIGNMENT - at % NSVCD_ALIGNMENT;
  return at > 0xffffffffu ? 0 : (size_t)at;
}

static nsvcd__geometry nsvcd__geometry_of(const nsvcd_body *body) {
  nsvcd__geometry f;
  nsvcd_body *b;
  // a cast would take away a const
  memcpy(&b, &body, sizeof b);
  (void)nsvcd__geometry_layout(b, body->patches, nsvcd__counts_of(body), &f);
  return f;
}

static float nsvcd__widest_error(const nsvcd__geometry *f) {
  return f->box[6];
}
// How far nsvcd__patch_triangle may be off the mesh's triangle.
static float nsvcd__off_mesh(const nsvcd__geometry *f) {
  return f->box[7];
}

// ---- one patch

// The stored points of a patch: integers, in steps from its centre.
typedef struct nsvcd__vertices {
  const int16_t *x, *y, *z;
  size_t count;
} nsvcd__vertices;

NSVCD__INLINE nsvcd__vertices nsvcd__vertices_of(const nsvcd__geometry *f, size_t patch) {
  const size_t first = f->first_vertex[patch];
  nsvcd__vertices out;
  out.count = f->first_vertex[patch + 1] - first;
  out.x = f->vertices + 3 * first;
  out.y = out.x + out.count;
  out.z = out.y + out.count;
  return out;
}
static nsvcd__d3 nsvcd__vertex_at(const nsvcd__vertices *vertices, size_t i) {
  return nsvcd__d3_of(vertices->x[i], vertices->y[i], vertices->z[i]);
}

// A patch numbers the points that its corners can be: stored points, then own vertices, then
// references. These are their counts.
typedef struct nsvcd__patch_points {
  size_t stored, own, all;
} nsvcd__patch_points;

NSVCD__INLINE nsvcd__patch_points nsvcd__points_of(const nsvcd__geometry *f, size_t patch) {
  nsvcd__patch_points out;
  out.stored = f->first_vertex[patch + 1] - f->first_vertex[patch];
  out.own = f->first_own[patch + 1] - f->first_own[patch];
  const uint32_t *references = f->first_reference + patch;
  out.all = out.stored + out.own + references[1] - references[0];
  return out;
}

// Bytes of a corner in a patch of `points` points.
static size_t nsvcd__corner_bytes(size_t points) {
  return points <= 256 ? 1 : 2;
}

// The vertex that reference n names.
NSVCD__INLINE size_t nsvcd__reference_at(const nsvcd__geometry *f, size_t n) {
  uint32_t number;
  uint16_t narrow;
  if (f->reference_bytes == 4) {
    memcpy(&number, f->references + 4 * n, sizeof number);
    return number;
  }
  memcpy(&narrow, f->references + 2 * n, sizeof narrow);
  return narrow;
}

// The position of point i of a patch, not a stored one: (3).
NSVCD__INLINE const float *nsvcd__position_of(const nsvcd__geometry *f, size_t patch,
                                              nsvcd__patch_points points, size_t i) {
  i -= points.stored;
  if (i < points.own) return f->positions + 3 * (f->first_own[patch] + i);
  const size_t at = f->first_reference[patch] + i - points.own;
  return f->positions + 3 * nsvcd__reference_at(f, at);
}

// The number, in the patch, of corner k (0..2) of entry n.
static size_t nsvcd__triangle_corner(const nsvcd__geometry *f, size_t patch, size_t n,
                                     size_t k) {
  const unsigned char *corners = f->entries + f->first_byte[patch];
  const size_t at = 3 * (n - f->first_triangle[patch]) + k;
  if (nsvcd__corner_bytes(nsvcd__points_of(f, patch).all) == 1) return corners[at];
  uint16_t corner;
  memcpy(&corner, corners + 2 * at, sizeof corner);
  return corner;
}

// The numbers of entries follow each other as codes. The upper bits of a code are the triangle's
// number in the caller's mesh minus that of the entry before, modulo 2^30. The lowest bit tells
// whether it belongs to a closed component; in a body with other kinds than CLOSED and SHEET, the
// lowest two are the kind. A code has 7 bits a byte, the lowest first; the top bit tells that more
// follow. Most codes take one byte, for neighbours have near numbers.
static uint32_t nsvcd__read_code(const unsigned char **at) {
  uint32_t code = 0;
  for (unsigned shift = 0; shift < 35; shift += 7) {
    const uint32_t byte = *(*at)++;
    code |= (byte & 0x7f) << shift;
    if (!(byte & 0x80)) break;
  }
  return code;
}

// Reads the numbers of a patch's entries, one after another.
typedef struct nsvcd__numbers {
  const unsigned char *at;
  size_t next;  // entry
  // of the entry before
  uint32_t number, kind;
  unsigned kind_bits;
} nsvcd__numbers;

static nsvcd__numbers nsvcd__numbers_of(const nsvcd__geometry *f, size_t patch) {
  const size_t bytes = nsvcd__corner_bytes(nsvcd__points_of(f, patch).all);
  const size_t triangles = f->first_triangle[patch + 1] - f->first_triangle[patch];
  nsvcd__numbers out;
  out.at = f->entries + f->first_byte[patch] + 3 * triangles * bytes;
  out.next = f->first_triangle[patch];
  out.number = 0;
  out.kind = NSVCD__SHEET;
  out.kind_bits = f->kind_bits;
  return out;
}

// Reads on up to entry n, which has not been read yet.
static void nsvcd__read_number(nsvcd__numbers *numbers, size_t n) {
  for (; numbers->next <= n; numbers->next++) {
    const uint32_t code = nsvcd__read_code(&numbers->at);
    const unsigned bits = numbers->kind_bits;
    numbers->number = (numbers->number + (code >> bits)) & NSVCD__NUMBER;
    numbers->kind = bits == 1 ? (code & 1) * NSVCD__CLOSED : code & 3;
  }
}

// The caller's triangle of entry n.
static uint32_t nsvcd__triangle_number(const nsvcd__geometry *f, size_t patch, size_t n) {
  nsvcd__numbers numbers = nsvcd__numbers_of(f, patch);
  nsvcd__read_number(&numbers, n);
  return numbers.number;
}

// Does entry n belong to a closed surface?
static inline int nsvcd__is_in_solid(const nsvcd__geometry *f, size_t patch, size_t n) {
  nsvcd__numbers numbers = nsvcd__numbers_of(f, patch);
  nsvcd__read_number(&numbers, n);
  return numbers.kind >= NSVCD__CLOSED && !f->body->open;
}

static nsvcd__f3 nsvcd__patch_centre(const nsvcd__geometry *f, size_t patch) {
  return nsvcd__centre_of(nsvcd__body_patches(f->body), patch);
}
// The same in double: the origin of the stored points.
static nsvcd__d3 nsvcd__patch_origin(const nsvcd__geometry *f, size_t patch) {
  return nsvcd__d3_widen(nsvcd__patch_centre(f, patch));
}

// Stored point i of a patch.
static nsvcd__d3 nsvcd__stored_point(const nsvcd__geometry *f, size_t patch, size_t i) {
  const nsvcd__vertices vertices = nsvcd__vertices_of(f, patch);
  const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, i);
  return nsvcd__d3_fma((double)f->steps[patch], vertex, nsvcd__patch_origin(f, patch));
}

// The corners (3) of a triangle of the caller's that is stored in pieces.
static void nsvcd__whole_triangle(const nsvcd__geometry *f, uint32_t number,
                                  nsvcd__d3 *corners) {
  size_t first = 0;
  for (size_t left = f->counts->cut; left > 1;) {
    const size_t half = left / 2;
    if (f->cut[first + half] <= number) first += half;
    left -= half;
  }
  for (size_t k = 0; k < 3; k++)
    corners[k] = nsvcd__d3_row(f->positions, f->cut_corners[3 * first + k]);
}

// The corners (3) of the caller's triangle that entry n is, or is a piece of. In a coarse body
// those of the entry itself.
static inline void nsvcd__patch_triangle(const nsvcd__geometry *f, size_t patch, size_t n,
                                         nsvcd__d3 *corners) {
  const nsvcd__patch_points points = nsvcd__points_of(f, patch);
  for (size_t k = 0; k < 3; k++) {
    const size_t i = nsvcd__triangle_corner(f, patch, n, k);
    if (i >= points.stored) {
      corners[k] = nsvcd__d3_load(nsvcd__position_of(f, patch, points, i));
    } else if (f->counts->cut > 0) {
      nsvcd__whole_triangle(f, nsvcd__triangle_number(f, patch, n), corners);
      return;
    } else {
      corners[k] = nsvcd__stored_point(f, patch, i);
    }
  }
}

// ---- what follows from the patches

typedef struct nsvcd__dslab {
  double low, high, across;
} nsvcd__dslab;

// The extent of a group along a direction and across it, from the centre of its sphere. Stops once
// that is no thinner than `most`.
static nsvcd__dslab nsvcd__slab_of_group(const nsvcd__geometry *f, size_t g, nsvcd__d3 normal,
                                         double most) {
  const size_t first = NSVCD__GROUP * g;
  const nsvcd__spheres groups = nsvcd__groups_of(f->body);
  const nsvcd__d3 centre = nsvcd__d3_widen(nsvcd__centre_of(groups, g));
  nsvcd__dslab slab = {HUGE_VAL, -HUGE_VAL, 0};
  for (size_t i = first; i < first + NSVCD__GROUP && i < f->body->patches; i++) {
    if (slab.high - slab.low >= most) break;
    const nsvcd__vertices vertices = nsvcd__vertices_of(f, i);
    const nsvcd__d3 own = nsvcd__d3_sub(nsvcd__patch_origin(f, i), centre);
    const double step = (double)f->steps[i];
    const double margin = (double)f->margins[i];
    double farthest = 0;
    for (size_t k = 0; k < f->hull_counts[i]; k++) {
      const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, k);
      const nsvcd__d3 v = nsvcd__d3_fma(step, vertex, own);
      const double height = nsvcd__d3_dot(normal, v);
      farthest = nsvcd__max(farthest, nsvcd__d3_dot(v, v) - height * height);
      slab.low = nsvcd__min(slab.low, height - margin);
      slab.high = nsvcd__max(slab.high, height + margin);
    }
    if (f->hull_counts[i]) slab.across = nsvcd__max(slab.across, sqrt(farthest) + margin);
  }
  return slab;
}

// Writes a group's slab. Its normal is the mean of the members' normals, or that of every fourth
// member, whichever makes it thinnest.
static void nsvcd__finish_group(nsvcd_body *b, size_t g) {
  const nsvcd__geometry f = nsvcd__geometry_of(b);
  nsvcd__d3 normals[1 + NSVCD__GROUP] = {{0, 0, 0}};
  for (size_t k = 0; k < NSVCD__GROUP; k++) {
    const float *n = f.slabs + NSVCD__GROUP * g + k;
    const nsvcd__d3 normal = nsvcd__d3_widen(nsvcd__f3_get(n, b->padded));
    normals[1 + k] = normal;
    const double sign = nsvcd__d3_dot(normal, normals[1]) < 0 ? -1 : 1;
    normals[0] = nsvcd__d3_fma(sign, normal, normals[0]);
  }
  nsvcd__d3 best = {0, 0, 1};
  nsvcd__dslab thinnest = {0, HUGE_VAL, 0};
  for (size_t k = 0; k < 1 + NSVCD__GROUP; k += k == 0 ? 1 : 4) {
    const double length = nsvcd__d3_norm(normals[k]);
    if (!(length > 1e-3)) continue;
    // as it is stored, and not longer than 1
    const nsvcd__d3 shorter = nsvcd__d3_scale(normals[k], 0.9999998 / length);
    const nsvcd__d3 unit = nsvcd__d3_widen(nsvcd__f3_round(shorter));
    const double most = thinnest.high - thinnest.low;
    const nsvcd__dslab slab = nsvcd__slab_of_group(&f, g, unit, most);
    if (!(slab.high - slab.low < most)) continue;
    thinnest = slab;
    best = unit;
  }
  // rounding to float; and `across` assumes |n| = 1
  const double margin = 1e-6 * (double)b->extent;
  nsvcd__slab slab;
  slab.normal = nsvcd__f3_round(best);
  slab.low = (float)(thinnest.low - margin);
  slab.high = thinnest.high < HUGE_VAL ? (float)(thinnest.high + margin) : 0;
  slab.across = nsvcd__above(thinnest.across + margin);
  nsvcd__slab_store(slab, f.group_slabs, nsvcd__group_slots(b->padded), g);
}

// Spheres about the hulls' vertices, which together contain the surface of a group. A patch without
// surface is a point.
typedef struct nsvcd__hulls {
  size_t count;
  // x, y, z, r
  float spheres[4][NSVCD__HULLS];
} nsvcd__hulls;

static void nsvcd__collect_hulls(const nsvcd__geometry *f, size_t g, nsvcd__hulls *out) {
  const size_t end = NSVCD__GROUP * (g + 1);
  out->count = 0;
  for (size_t i = end - NSVCD__GROUP; i < end && i < f->body->patches; i++) {
    const size_t count = f->hull_counts[i];
    for (size_t k = 0; k < count + !count; k++) {
      nsvcd__d3 v = nsvcd__patch_origin(f, i);
      if (count) v = nsvcd__stored_point(f, i, k);
      // of v to float
      const double rounding = 1.1e-7 * nsvcd__d3_norm(v);
      const size_t n = out->count++;
      out->spheres[3][n] = nsvcd__above((double)f->margins[i] + rounding);
      nsvcd__f3_put(nsvcd__f3_round(v), &out->spheres[0][n], NSVCD__HULLS);
    }
  }
}

static nsvcd__spheres nsvcd__hull_spheres(const nsvcd__hulls *hulls) {
  return nsvcd__spheres_of(hulls->spheres[0], NSVCD__HULLS);
}

// Fills in the spheres over 16 balls each.
static void nsvcd__cover_balls(const nsvcd__geometry *f) {
  const nsvcd__covering all = nsvcd__covering_of(f->body);
  float *out = f->balls + 4 * all.ball_slots;
  nsvcd__cover_groups(all.balls, all.counts->balls, out, all.cluster_slots);
}

// Completes a body of triangles whose patches are in place: spheres of groups and levels, the box,
// the greatest error, the groups' slabs. off: of the mesh's vertices, metres.
static void nsvcd__geometry_finish(nsvcd_body *b, float off) {
  const nsvcd__geometry f = nsvcd__geometry_of(b);
  const nsvcd__level groups = nsvcd__level_of(b->padded, 0);
  float *out = (float *)(b + 1) + groups.first;
  for (size_t g = 0; g < groups.slots; g++) {
    nsvcd__sphere over = {{0, 0, 0}, NSVCD__NOWHERE};
    nsvcd__hulls hulls;
    if (g < groups.count) {
      nsvcd__collect_hulls(&f, g, &hulls);
      over = nsvcd__cover_spheres(nsvcd__hull_spheres(&hulls), hulls.count);
    }
    nsvcd__sphere_store(over, out, groups.slots, g);
  }
  nsvcd__body_finish(b);
  const nsvcd__d3 all = {1, 1, 1};
  nsvcd__d3 low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  nsvcd__d3 high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  float widest = 0;
  for (size_t n = 0; n < f.counts->positions; n++) {
    low = nsvcd__d3_min(low, nsvcd__d3_row(f.positions, n));
    high = nsvcd__d3_max(high, nsvcd__d3_row(f.positions, n));
  }
  for (size_t i = 0; i < b->patches; i++) {
    const size_t count = f.first_vertex[i + 1] - f.first_vertex[i];
    const double error = (double)f.errors[i];
    widest = f.errors[i] > widest ? f.errors[i] : widest;
    for (size_t k = 0; k < count && f.counts->positions == 0; k++) {
      const nsvcd__d3 vertex = nsvcd__stored_point(&f, i, k);
      low = nsvcd__d3_min(low, nsvcd__d3_fma(-error, all, vertex));
      high = nsvcd__d3_max(high, nsvcd__d3_fma(error, all, vertex));
    }
  }
  // 1e-6: rounding to float
  const double margin = 1e-6 * (double)b->extent + (double)off;
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(-margin, all, low)), f.box);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(margin, all, high)), f.box + 3);
  f.box[6] = widest;
  f.box[7] = f.counts->positions > 0 ? off : widest;
  for (size_t g = 0; g < nsvcd__body_groups(b); g++) nsvcd__finish_group(b, g);
  b->checksum = nsvcd__body_checksum(b);
}

// The radius of a body's sphere, its convex radius included.
static float nsvcd__whole_radius(const nsvcd_body *body) {
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  return body->radius + (triangles ? nsvcd__counts_of(triangles)->convex_radius : 0);
}
