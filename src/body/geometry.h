// In: the surface of each patch. Out: the blob of the proof, and what it says of a patch.
//
// The body of triangles. Its spheres are the least about each patch's pieces of the surface. Behind
// them stand
//
//   counts          (4)      uint32: triangles listed L, points stored V, components C, bytes of
//                            entries B
//   convex_radius   (1)      float: metres that the body goes beyond its triangles
//   counts          (3)      uint32: vertices of the mesh W, references to them R, triangles that
//                            are listed in pieces K. 0, 0, 0: the body is coarse
//   solids          (4)      uint32: components as they are told, how many of these are open, open
//                            edges; 1: entries have kinds of two bits
//   gap             (1)      float: metres: corners no farther apart count as one where
//                            it is asked what is closed
//   box             (2, 3)   float: least and greatest coordinates of the surface
//   widest          (2)      float: the greatest of the quantization errors; and metres that the
//                            mesh's vertices are off by: 0, but in a body that was scaled, or is
//                            coarse
//   slabs           (6, P)   float: normal n, low, high, across: points x of a piece have
//                            low <= n.(x - c) <= high, and are no farther than `across` from the
//                            line along n; c: centre of the patch's sphere
//   group slabs     (6, G)   float: the same over the members of each group; c: centre of the
//                            group's sphere
//   steps           (P)      float: metres per integer: a stored point is c + step (x, y, z)
//   margins         (P)      float: pieces are within this of the hull of the first points
//   errors (P)  float: corners that are stored points are within this of the mesh's
//   first_vertex, first_own, first_reference, first_triangle, first_byte
//                   (5, N + 1) uint32: where a patch's stored points, the vertices that it is the
//                            first to have, references to others, triangles and entries begin
//   first_seed      (G' + 1) uint32: where the seeds of a group begin; G': groups, without the
//                            padding
//   seeds           (C, 3)   float: a point of each component, group by group, within its sphere
//   positions       (W, 3)   float: the mesh's vertices as the caller gave them, each place once:
//                            of each patch its own, then those of no patch
//   cut             (K)      uint32: triangles of the caller's that are listed in pieces, in order
//   cut_corners     (K, 3)   uint32: their corners, numbers of vertices
//   references      (R)      uint32, or uint16 if W is 65536 at most: patch by patch, numbers of
//                            vertices that a patch before it has
//   vertices        (3 V)    int16: patch by patch x, y, z of its stored points: the hull's, then
//                            corners of pieces
//                   (16)     int16: so that 16 can be read from any point on
//   entries        (B)      bytes: patch by patch, of its T triangles
//     corners       (T, 3)   uint8, or uint16 in patches of more than 256: points within the patch:
//                            its stored ones, its own vertices, its references. A triangle of
//                            vertices alone is one of the caller's; another is a piece of one
//     numbers       (T)      each in 1 to 5 bytes: see nsvcd__read_code
//   hull_counts     (N)      uint8: vertices of the hull, 16 at most; 0: the patch has no surface
#pragma once
#include "../surface/pieces.h"
#include "traversal.h"

#ifndef NSVCD_NO_PROOF
#define NSVCD__HULLS (NSVCD__GROUP * NSVCD__HULL)  // vertices of a group, at most
#define NSVCD__GEOMETRY_BOX 8                      // with the greatest quantization error

typedef struct nsvcd__geometry_counts {
  uint32_t listed, vertices, components, triangle_codes_size;
  float convex_radius;
  uint32_t positions, references, cut;
  uint32_t solids, open_solids, open_edges, is_mixed;
  float gap;
} nsvcd__geometry_counts;

typedef struct nsvcd__geometry {
  // of triangles
  const nsvcd_body *body;
  const float *box, *slabs, *group_slabs, *steps, *margins, *errors;
  const uint32_t *first_vertex, *first_own, *first_reference, *first_triangle, *first_byte;
  const uint32_t *first_seed;
  const float *seeds, *positions;
  const uint32_t *cut, *cut_corners;
  // of 16 bits or 32
  const unsigned char *references;
  const int16_t *vertices;
  const unsigned char *triangle_codes;
  const uint8_t *hull_counts;
  size_t listed, vertex_count, components, triangle_codes_size;
  size_t position_count, reference_count, cut_count;
  float convex_radius, gap;
  // bits of a entry's code that are its kind
  unsigned kind_bits;
} nsvcd__geometry;

// The body of triangles in a body, or NULL.
static const nsvcd_body *nsvcd__triangles_of(const nsvcd_body *body) {
  if (body->triangles == 0 || body->weights_id == 0) return body->triangles ? body : NULL;
  return (const nsvcd_body *)(const void *)((const char *)body + body->inner);
}

static const nsvcd__geometry_counts *nsvcd__counts_of(const nsvcd_body *body) {
  const char *at = (const char *)body + nsvcd__spheres_size(body->padded);
  return (const nsvcd__geometry_counts *)(const void *)at;
}

// The next `count` numbers in a body, or, where that is NULL, only counts them.
#define NSVCD__PASS(type, count) ((const type *)nsvcd__pass(body, &at, count, sizeof(type)))
static const void *nsvcd__pass(const nsvcd_body *body, uint64_t *at, uint64_t count,
                               size_t size) {
  const void *out = body ? (const char *)body + *at : NULL;
  *at += count * size;
  return out;
}

static size_t nsvcd__reference_bytes(const nsvcd__geometry *f) {
  return f->position_count <= 65536 ? 2 : 4;
}

// Where all is in a body of so many patches. body: NULL to know only how large it is to be. Returns
// its bytes; 0 if they cannot be counted in 32 bits.
static size_t nsvcd__geometry_layout(const nsvcd_body *body, size_t patches,
                                     const nsvcd__geometry_counts *counts,
                                     nsvcd__geometry *f) {
  const size_t padded = nsvcd__round_up(patches, NSVCD__GROUP);
  const size_t starts = patches + 1;
  uint64_t at = nsvcd__spheres_size(padded) + sizeof *counts;
  f->body = body;
  f->listed = counts->listed;
  f->vertex_count = counts->vertices;
  f->components = counts->components;
  f->triangle_codes_size = counts->triangle_codes_size;
  f->convex_radius = counts->convex_radius;
  f->position_count = counts->positions;
  f->reference_count = counts->references;
  f->cut_count = counts->cut;
  f->gap = counts->gap;
  f->kind_bits = 1 + (counts->is_mixed != 0);
  f->box = NSVCD__PASS(float, NSVCD__GEOMETRY_BOX);
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
  f->seeds = NSVCD__PASS(float, (uint64_t)3 * f->components);
  f->positions = NSVCD__PASS(float, (uint64_t)3 * f->position_count);
  f->cut = NSVCD__PASS(uint32_t, f->cut_count);
  f->cut_corners = NSVCD__PASS(uint32_t, (uint64_t)3 * f->cut_count);
  const size_t wide = nsvcd__reference_bytes(f);
  f->references = NSVCD__PASS(unsigned char, (uint64_t)wide * f->reference_count);
  f->vertices = NSVCD__PASS(int16_t, (uint64_t)3 * f->vertex_count + NSVCD__LANES);
  f->triangle_codes = NSVCD__PASS(unsigned char, f->triangle_codes_size);
  f->hull_counts = NSVCD__PASS(uint8_t, patches);
  at += NSVCD_ALIGNMENT - at % NSVCD_ALIGNMENT;
  return at > 0xffffffffu ? 0 : (size_t)at;
}

static nsvcd__geometry nsvcd__geometry_of(const nsvcd_body *body) {
  nsvcd__geometry f;
  (void)nsvcd__geometry_layout(body, body->patches, nsvcd__counts_of(body), &f);
  return f;
}

static float nsvcd__widest_quantization(const nsvcd__geometry *f) {
  return f->box[6];
}
// How far nsvcd__patch_triangle may be off the mesh's.
static float nsvcd__off_mesh(const nsvcd__geometry *f) {
  return f->box[7];
}

// ---- one patch

// The stored points of a patch: integers, in steps from its centre.
typedef struct nsvcd__vertices {
  // (count) each
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

// The points that corners of a patch can be, by their numbers in it: stored ones, from 0; its own
// vertices; and references.
typedef struct nsvcd__patch_points {
  size_t stored, own, all;
} nsvcd__patch_points;

NSVCD__INLINE nsvcd__patch_points nsvcd__points_of(const nsvcd__geometry *f, size_t patch) {
  nsvcd__patch_points out;
  out.stored = f->first_vertex[patch + 1] - f->first_vertex[patch];
  out.own = f->first_own[patch + 1] - f->first_own[patch];
  out.all = out.stored + out.own + f->first_reference[patch + 1] - f->first_reference[patch];
  return out;
}

// Bytes of a corner in a patch of so many points.
static size_t nsvcd__corner_bytes(size_t points) {
  return points <= 256 ? 1 : 2;
}

// The number of a vertex that reference n is.
NSVCD__INLINE size_t nsvcd__reference_at(const nsvcd__geometry *f, size_t n) {
  uint32_t number;
  uint16_t narrow;
  if (nsvcd__reference_bytes(f) == 4) {
    memcpy(&number, f->references + 4 * n, sizeof number);
    return number;
  }
  memcpy(&narrow, f->references + 2 * n, sizeof narrow);
  return narrow;
}

// The place of point i of a patch, which is no stored one, (3).
NSVCD__INLINE const float *nsvcd__position_of(const nsvcd__geometry *f, size_t patch,
                                              nsvcd__patch_points points, size_t i) {
  i -= points.stored;
  if (i < points.own) return f->positions + 3 * (f->first_own[patch] + i);
  const size_t at = f->first_reference[patch] + i - points.own;
  return f->positions + 3 * nsvcd__reference_at(f, at);
}

// The point, of its patch, of corner k (0..2) of entry n.
static size_t nsvcd__triangle_corner(const nsvcd__geometry *f, size_t patch, size_t n,
                                     size_t k) {
  const unsigned char *corners = f->triangle_codes + f->first_byte[patch];
  const size_t at = 3 * (n - f->first_triangle[patch]) + k;
  if (nsvcd__corner_bytes(nsvcd__points_of(f, patch).all) == 1) return corners[at];
  uint16_t corner;
  memcpy(&corner, corners + 2 * at, sizeof corner);
  return corner;
}

// The numbers of a patch's triangles in the caller's mesh follow each other as codes: what the
// number is more than the one before, modulo 2^30, and below it one bit: does the triangle belong
// to a closed component? Where there are other kinds than closed ones and sheets, two bits: the
// kind. A code is stored 7 bits a byte, the lowest first; the top bit says that there are more.
// Most take one byte, for neighbours have near numbers.
static uint32_t nsvcd__read_code(const unsigned char **at) {
  uint32_t code = 0;
  for (unsigned shift = 0; shift < 35; shift += 7) {
    const uint32_t byte = *(*at)++;
    code |= (byte & 0x7f) << shift;
    if (!(byte & 0x80)) break;
  }
  return code;
}

// The numbers of a patch's triangles, read one after another.
typedef struct nsvcd__numbers {
  const unsigned char *at;
  size_t next;      // entry
  uint32_t number;  // of the one before
  uint32_t kind;
  unsigned kind_bits;
} nsvcd__numbers;

static nsvcd__numbers nsvcd__numbers_of(const nsvcd__geometry *f, size_t patch) {
  const size_t bytes = nsvcd__corner_bytes(nsvcd__points_of(f, patch).all);
  const size_t triangles = f->first_triangle[patch + 1] - f->first_triangle[patch];
  nsvcd__numbers out;
  out.at = f->triangle_codes + f->first_byte[patch] + 3 * triangles * bytes;
  out.next = f->first_triangle[patch];
  out.number = 0;
  out.kind = NSVCD__SHEET;
  out.kind_bits = f->kind_bits;
  return out;
}

// Reads on until entry n, which has not been read before.
static void nsvcd__read_number(nsvcd__numbers *numbers, size_t n) {
  for (; numbers->next <= n; numbers->next++) {
    const uint32_t code = nsvcd__read_code(&numbers->at);
    const unsigned bits = numbers->kind_bits;
    numbers->number = (numbers->number + (code >> bits)) & NSVCD__NUMBER;
    numbers->kind = bits == 1 ? (code & 1) * NSVCD__CLOSED : code & 3;
    NSVCD__TALLY(numbers, 1);
  }
}

// The triangle, in the caller's mesh, of entry n.
static uint32_t nsvcd__triangle_number(const nsvcd__geometry *f, size_t patch, size_t n) {
  nsvcd__numbers numbers = nsvcd__numbers_of(f, patch);
  nsvcd__read_number(&numbers, n);
  return numbers.number;
}

// Does entry n belong to a closed surface?
static int nsvcd__is_in_solid(const nsvcd__geometry *f, size_t patch, size_t n) {
  nsvcd__numbers numbers = nsvcd__numbers_of(f, patch);
  nsvcd__read_number(&numbers, n);
  return numbers.kind >= NSVCD__CLOSED && !f->body->open;
}

static nsvcd__f3 nsvcd__patch_centre(const nsvcd__geometry *f, size_t patch) {
  return nsvcd__centre_of(nsvcd__body_patches(f->body), patch);
}
// The same in double: what the vertices are counted from.
static nsvcd__d3 nsvcd__patch_origin(const nsvcd__geometry *f, size_t patch) {
  return nsvcd__d3_widen(nsvcd__patch_centre(f, patch));
}

// The corners (3) of a triangle that is listed in pieces, by its number in the caller's mesh.
static void nsvcd__whole_triangle(const nsvcd__geometry *f, uint32_t number,
                                  nsvcd__d3 *corners) {
  size_t first = 0;
  for (size_t left = f->cut_count; left > 1;) {
    const size_t half = left / 2;
    if (f->cut[first + half] <= number) first += half;
    left -= half;
  }
  for (size_t k = 0; k < 3; k++)
    corners[k] = nsvcd__d3_row(f->positions, f->cut_corners[3 * first + k]);
}

// The corners (3) of the caller's triangle that entry n of a patch is, or is a piece of. Of a
// coarse body, those of the entry itself.
static void nsvcd__patch_triangle(const nsvcd__geometry *f, size_t patch, size_t n,
                                  nsvcd__d3 *corners) {
  const nsvcd__patch_points points = nsvcd__points_of(f, patch);
  for (size_t k = 0; k < 3; k++) {
    const size_t i = nsvcd__triangle_corner(f, patch, n, k);
    if (i >= points.stored) {
      corners[k] = nsvcd__d3_load(nsvcd__position_of(f, patch, points, i));
    } else if (f->cut_count > 0) {
      nsvcd__whole_triangle(f, nsvcd__triangle_number(f, patch, n), corners);
      return;
    } else {
      const nsvcd__vertices vertices = nsvcd__vertices_of(f, patch);
      const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, i);
      corners[k] =
          nsvcd__d3_fma((double)f->steps[patch], vertex, nsvcd__patch_origin(f, patch));
    }
  }
}

// ---- what follows from the patches

// What the members of a group extend to along a direction and across it, from the centre of the
// group's sphere. One that is seen to be no thinner than `most` is not measured to the end.
typedef struct nsvcd__slab_of_hulls {
  double low, high, across;
} nsvcd__slab_of_hulls;

static nsvcd__slab_of_hulls nsvcd__slab_of_group(const nsvcd__geometry *f, size_t g,
                                                 nsvcd__d3 normal, double most) {
  const size_t first = NSVCD__GROUP * g;
  const nsvcd__spheres groups = nsvcd__groups_of(f->body);
  const nsvcd__d3 centre = nsvcd__d3_widen(nsvcd__centre_of(groups, g));
  nsvcd__slab_of_hulls slab = {HUGE_VAL, -HUGE_VAL, 0};
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

// Writes a group's slab. Its normal is the mean of the members', or that of every fourth member:
// the one in which the group is thinnest.
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
  nsvcd__slab_of_hulls thinnest = {0, HUGE_VAL, 0};
  for (size_t k = 0; k < 1 + NSVCD__GROUP; k += k == 0 ? 1 : 4) {
    const double length = nsvcd__d3_length(normals[k]);
    if (!(length > 1e-3)) continue;
    // As it is stored, and no longer than 1.
    const nsvcd__d3 shorter = nsvcd__d3_scale(normals[k], 0.9999998 / length);
    const nsvcd__d3 unit = nsvcd__d3_widen(nsvcd__f3_round(shorter));
    const double most = thinnest.high - thinnest.low;
    const nsvcd__slab_of_hulls slab = nsvcd__slab_of_group(&f, g, unit, most);
    if (!(slab.high - slab.low < most)) continue;
    thinnest = slab;
    best = unit;
  }
  // float rounding, and that `across` takes |n| to be 1
  const double margin = 1e-6 * (double)b->extent;
  nsvcd__slab slab;
  slab.normal = nsvcd__f3_round(best);
  slab.low = (float)(thinnest.low - margin);
  slab.high = thinnest.high < HUGE_VAL ? (float)(thinnest.high + margin) : 0;
  slab.across = nsvcd__above(thinnest.across + margin);
  float *slabs = (float *)nsvcd__writable(b, f.group_slabs);
  nsvcd__slab_store(slab, slabs, nsvcd__group_slots(b->padded), g);
}

// The surface in a group: spheres about the vertices of its patches' hulls. A patch without surface
// is a point.
typedef struct nsvcd__hulls {
  size_t count;
  float spheres[4][NSVCD__HULLS];  // x, y, z, r
} nsvcd__hulls;

static void nsvcd__collect_hulls(const nsvcd__geometry *f, size_t g, nsvcd__hulls *out) {
  const size_t end = NSVCD__GROUP * (g + 1);
  out->count = 0;
  for (size_t i = end - NSVCD__GROUP; i < end && i < f->body->patches; i++) {
    const nsvcd__vertices vertices = nsvcd__vertices_of(f, i);
    const nsvcd__d3 origin = nsvcd__patch_origin(f, i);
    const double step = (double)f->steps[i];
    const size_t count = f->hull_counts[i];
    for (size_t k = 0; k < count + !count; k++) {
      nsvcd__d3 v = {0, 0, 0};
      if (count) v = nsvcd__vertex_at(&vertices, k);
      v = nsvcd__d3_fma(step, v, origin);
      // as float rounds it
      const double rounding = 1.1e-7 * nsvcd__d3_length(v);
      const double radius = (double)f->margins[i] + rounding;
      const size_t n = out->count++;
      out->spheres[3][n] = nsvcd__above(radius);
      nsvcd__f3_put(nsvcd__f3_round(v), &out->spheres[0][n], NSVCD__HULLS);
    }
  }
}

static nsvcd__spheres nsvcd__hull_spheres(const nsvcd__hulls *hulls) {
  return nsvcd__spheres_of(hulls->spheres[0], NSVCD__HULLS);
}

// What is computed from the patches of a body of triangles, when these are in place: the spheres
// above them, the box with the greatest of the quantization errors, and the groups' slabs. off:
// metres that the mesh's vertices are off by.
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
  for (size_t n = 0; n < f.position_count; n++) {
    low = nsvcd__d3_min(low, nsvcd__d3_row(f.positions, n));
    high = nsvcd__d3_max(high, nsvcd__d3_row(f.positions, n));
  }
  for (size_t i = 0; i < b->patches; i++) {
    const nsvcd__vertices vertices = nsvcd__vertices_of(&f, i);
    const nsvcd__d3 origin = nsvcd__patch_origin(&f, i);
    const double quantization_error = (double)f.errors[i];
    widest = f.errors[i] > widest ? f.errors[i] : widest;
    for (size_t k = 0; k < vertices.count && f.position_count == 0; k++) {
      nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, k);
      vertex = nsvcd__d3_fma((double)f.steps[i], vertex, origin);
      low = nsvcd__d3_min(low, nsvcd__d3_fma(-quantization_error, all, vertex));
      high = nsvcd__d3_max(high, nsvcd__d3_fma(quantization_error, all, vertex));
    }
  }
  // float rounding
  const double margin = 1e-6 * (double)b->extent + (double)off;
  float *box = (float *)nsvcd__writable(b, f.box);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(-margin, all, low)), box);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(margin, all, high)), box + 3);
  box[6] = widest;
  box[7] = f.position_count > 0 ? off : widest;
  for (size_t g = 0; g < nsvcd__body_groups(b); g++) nsvcd__finish_group(b, g);
  b->checksum = nsvcd__body_checksum(b);
}
#endif  // NSVCD_NO_PROOF

// Of a sphere about a body, with what it goes beyond its triangles.
static float nsvcd__whole_radius(const nsvcd_body *body) {
#ifndef NSVCD_NO_PROOF
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  if (triangles) return body->radius + nsvcd__counts_of(triangles)->convex_radius;
#endif
  return body->radius;
}
