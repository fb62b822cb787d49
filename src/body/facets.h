// In: the surface of each patch. Out: the blob of the proof, and what it says of a patch.
//
// The body of triangles. Its spheres are the least about each patch's pieces of the surface. Behind
// them stand
//
//   counts          (4)      uint32: triangles listed L, vertices V, components C, bytes of
//                            listings B
//   round           (1)      float: metres that the body goes beyond its triangles
//   zeros           (3)      uint32
//   box             (2, 3)   float: least and greatest coordinates of the surface
//   widest          (2)      float: the greatest of the quanta, and zero
//   discs           (6, P)   float: normal n, low, high, across: points x of a piece have
//                            low <= n.(x - c) <= high, and are no farther than `across` from the
//                            line along n; c: centre of the patch's sphere
//   group discs     (6, G)   float: the same over the members of each group; c: centre of the
//                            group's sphere
//   steps           (P)      float: metres per integer: a stored vertex is c + step (x, y, z)
//   slacks          (P)      float: pieces are within this of the hull of the first vertices
//   quanta          (P)      float: corners of triangles are within this of the stored vertices
//   first_vertex, first_triangle, first_byte
//                   (3, N + 1) uint32: where a patch's vertices, triangles and listings begin
//   first_seed      (G' + 1) uint32: where the seeds of a group begin; G': groups, without the
//                            padding
//   seeds           (C, 3)   float: a point of each component, group by group, within its sphere
//   vertices        (3 V)    int16: patch by patch x, y, z; the hull's first
//                   (16)     int16: so that 16 can be read from any vertex on
//   listings        (B)      bytes: patch by patch, of its T triangles
//     corners       (T, 3)   uint8, or uint16 in patches of more than 256 vertices: vertices within
//                            the patch
//     numbers       (T)      each in 1 to 5 bytes: see nsvcd__read_code
//   hull_counts     (N)      uint8: vertices of the hull, 16 at most; 0: the patch has no surface
#pragma once
#include "../surface/pieces.h"
#include "walk.h"

#ifndef NSVCD_NO_PROOF
#define NSVCD__HULLS (NSVCD__GROUP * NSVCD__HULL)  // vertices of a group, at most
#define NSVCD__FACET_BOX 8                         // with the greatest quantum

typedef struct nsvcd__facet_counts {
  uint32_t listed, vertices, components, listings_size;
  float round;
  uint32_t zeros[3];
} nsvcd__facet_counts;

typedef struct nsvcd__facets {
  // of triangles
  const nsvcd_body *body;
  const float *box, *discs, *group_discs, *steps, *slacks, *quanta;
  const uint32_t *first_vertex, *first_triangle, *first_byte, *first_seed;
  const float *seeds;
  const int16_t *vertices;
  const unsigned char *listings;
  const uint8_t *hull_counts;
  size_t listed, vertex_count, components, listings_size;
  float round;
} nsvcd__facets;

// The body of triangles in a body, or NULL.
static const nsvcd_body *nsvcd__triangles_of(const nsvcd_body *body) {
  if (body->triangles == 0 || body->weights_id == 0) return body->triangles ? body : NULL;
  return (const nsvcd_body *)(const void *)((const char *)body + body->inner);
}

static const nsvcd__facet_counts *nsvcd__counts_of(const nsvcd_body *body) {
  const char *at = (const char *)body + nsvcd__spheres_size(body->padded);
  return (const nsvcd__facet_counts *)(const void *)at;
}

// The next `count` numbers in a body, or, where that is NULL, only counts them.
#define NSVCD__PASS(type, count) ((const type *)nsvcd__pass(body, &at, count, sizeof(type)))
static const void *nsvcd__pass(const nsvcd_body *body, uint64_t *at, uint64_t count,
                               size_t size) {
  const void *out = body ? (const char *)body + *at : NULL;
  *at += count * size;
  return out;
}

// Where all is in a body of so many patches. body: NULL to know only how large it is to be. Returns
// its bytes; 0 if they cannot be counted in 32 bits.
static size_t nsvcd__facets_lay(const nsvcd_body *body, size_t patches,
                                const nsvcd__facet_counts *counts, nsvcd__facets *f) {
  const size_t padded = nsvcd__round_up(patches, NSVCD__GROUP);
  const size_t starts = patches + 1;
  uint64_t at = nsvcd__spheres_size(padded) + sizeof *counts;
  f->body = body;
  f->listed = counts->listed;
  f->vertex_count = counts->vertices;
  f->components = counts->components;
  f->listings_size = counts->listings_size;
  f->round = counts->round;
  f->box = NSVCD__PASS(float, NSVCD__FACET_BOX);
  f->discs = NSVCD__PASS(float, 6 * padded);
  f->group_discs = NSVCD__PASS(float, 6 * nsvcd__group_slots(padded));
  f->steps = NSVCD__PASS(float, padded);
  f->slacks = NSVCD__PASS(float, padded);
  f->quanta = NSVCD__PASS(float, padded);
  f->first_vertex = NSVCD__PASS(uint32_t, starts);
  f->first_triangle = NSVCD__PASS(uint32_t, starts);
  f->first_byte = NSVCD__PASS(uint32_t, starts);
  f->first_seed = NSVCD__PASS(uint32_t, padded / NSVCD__GROUP + 1);
  f->seeds = NSVCD__PASS(float, (uint64_t)3 * f->components);
  f->vertices = NSVCD__PASS(int16_t, (uint64_t)3 * f->vertex_count + NSVCD__LANES);
  f->listings = NSVCD__PASS(unsigned char, f->listings_size);
  f->hull_counts = NSVCD__PASS(uint8_t, patches);
  at += NSVCD_ALIGNMENT - at % NSVCD_ALIGNMENT;
  return at > 0xffffffffu ? 0 : (size_t)at;
}

static nsvcd__facets nsvcd__facets_of(const nsvcd_body *body) {
  nsvcd__facets f;
  (void)nsvcd__facets_lay(body, body->patches, nsvcd__counts_of(body), &f);
  return f;
}

static float nsvcd__widest_quantum(const nsvcd__facets *f) {
  return f->box[6];
}

// ---- one patch

// The vertices of a patch: integers, in steps from its centre.
typedef struct nsvcd__vertices {
  // (count) each
  const int16_t *x, *y, *z;
  size_t count;
} nsvcd__vertices;

NSVCD__INLINE nsvcd__vertices nsvcd__vertices_of(const nsvcd__facets *f, size_t patch) {
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

// Bytes of a corner in a patch of so many vertices.
static size_t nsvcd__corner_bytes(size_t vertices) {
  return vertices <= 256 ? 1 : 2;
}

// The vertex, of its patch, of corner k (0..2) of listing n.
static size_t nsvcd__facet_corner(const nsvcd__facets *f, size_t patch, size_t n, size_t k) {
  const unsigned char *corners = f->listings + f->first_byte[patch];
  const size_t at = 3 * (n - f->first_triangle[patch]) + k;
  if (nsvcd__corner_bytes(nsvcd__vertices_of(f, patch).count) == 1) return corners[at];
  uint16_t corner;
  memcpy(&corner, corners + 2 * at, sizeof corner);
  return corner;
}

// The numbers of a patch's triangles in the caller's mesh follow each other as codes: twice what
// the number is more than the one before, modulo 2^31, the lowest bit set if the triangle belongs
// to a closed component. A code is stored 7 bits a byte, the lowest first; the top bit says that
// there are more. Most take one byte, for neighbours have near numbers.
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
  size_t next;      // listing
  uint32_t number;  // of the one before
  // does it belong to a closed component?
  int encloses;
} nsvcd__numbers;

static nsvcd__numbers nsvcd__numbers_of(const nsvcd__facets *f, size_t patch) {
  const size_t bytes = nsvcd__corner_bytes(nsvcd__vertices_of(f, patch).count);
  const size_t triangles = f->first_triangle[patch + 1] - f->first_triangle[patch];
  nsvcd__numbers out;
  out.at = f->listings + f->first_byte[patch] + 3 * triangles * bytes;
  out.next = f->first_triangle[patch];
  out.number = 0;
  out.encloses = 0;
  return out;
}

// Reads on until listing n, which has not been read before.
static void nsvcd__read_number(nsvcd__numbers *numbers, size_t n) {
  for (; numbers->next <= n; numbers->next++) {
    const uint32_t code = nsvcd__read_code(&numbers->at);
    numbers->number = (numbers->number + (code >> 1)) & ~NSVCD__ENCLOSES;
    numbers->encloses = (int)(code & 1);
    NSVCD__TALLY(numbers, 1);
  }
}

// The triangle, in the caller's mesh, of listing n.
static uint32_t nsvcd__facet_number(const nsvcd__facets *f, size_t patch, size_t n) {
  nsvcd__numbers numbers = nsvcd__numbers_of(f, patch);
  nsvcd__read_number(&numbers, n);
  return numbers.number;
}

// Does listing n belong to a closed surface?
static int nsvcd__facet_encloses(const nsvcd__facets *f, size_t patch, size_t n) {
  nsvcd__numbers numbers = nsvcd__numbers_of(f, patch);
  nsvcd__read_number(&numbers, n);
  return numbers.encloses && !f->body->open;
}

static nsvcd__f3 nsvcd__facet_centre(const nsvcd__facets *f, size_t patch) {
  return nsvcd__centre_of(nsvcd__body_patches(f->body), patch);
}
// The same in double: what the vertices are counted from.
static nsvcd__d3 nsvcd__facet_origin(const nsvcd__facets *f, size_t patch) {
  return nsvcd__d3_widen(nsvcd__facet_centre(f, patch));
}

// The corners (3) of listing n of a patch, exactly.
static void nsvcd__facet_triangle(const nsvcd__facets *f, size_t patch, size_t n,
                                  nsvcd__d3 *corners) {
  const nsvcd__vertices vertices = nsvcd__vertices_of(f, patch);
  const nsvcd__d3 origin = nsvcd__facet_origin(f, patch);
  const double step = (double)f->steps[patch];
  for (size_t k = 0; k < 3; k++) {
    const size_t i = nsvcd__facet_corner(f, patch, n, k);
    const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, i);
    corners[k] = nsvcd__d3_fma(step, vertex, origin);
  }
}

// ---- what follows from the patches

// A float not less than x, which is not negative.
static float nsvcd__above(double x) {
  return (float)(x * (1 + 2e-7)) + 1e-37f;
}

// What the members of a group extend to along a direction and across it, from the centre of the
// group's sphere. One that is seen to be no thinner than `most` is not measured to the end.
typedef struct nsvcd__slab {
  double low, high, across;
} nsvcd__slab;

static nsvcd__slab nsvcd__slab_of_group(const nsvcd__facets *f, size_t g, nsvcd__d3 normal,
                                        double most) {
  const size_t first = NSVCD__GROUP * g;
  const nsvcd__spheres groups = nsvcd__groups_of(f->body);
  const nsvcd__d3 centre = nsvcd__d3_widen(nsvcd__centre_of(groups, g));
  nsvcd__slab slab = {HUGE_VAL, -HUGE_VAL, 0};
  for (size_t i = first; i < first + NSVCD__GROUP && i < f->body->patches; i++) {
    if (slab.high - slab.low >= most) break;
    const nsvcd__vertices vertices = nsvcd__vertices_of(f, i);
    const nsvcd__d3 own = nsvcd__d3_sub(nsvcd__facet_origin(f, i), centre);
    const double step = (double)f->steps[i];
    const double slack = (double)f->slacks[i];
    double farthest = 0;
    for (size_t k = 0; k < f->hull_counts[i]; k++) {
      const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, k);
      const nsvcd__d3 v = nsvcd__d3_fma(step, vertex, own);
      const double height = nsvcd__d3_dot(normal, v);
      farthest = nsvcd__max(farthest, nsvcd__d3_dot(v, v) - height * height);
      slab.low = nsvcd__min(slab.low, height - slack);
      slab.high = nsvcd__max(slab.high, height + slack);
    }
    if (f->hull_counts[i]) slab.across = nsvcd__max(slab.across, sqrt(farthest) + slack);
  }
  return slab;
}

// Writes a group's disc. Its normal is the mean of the members', or that of every fourth member:
// the one in which the group is thinnest.
static void nsvcd__finish_group(nsvcd_body *b, size_t g) {
  const nsvcd__facets f = nsvcd__facets_of(b);
  nsvcd__d3 normals[1 + NSVCD__GROUP] = {{0, 0, 0}};
  for (size_t k = 0; k < NSVCD__GROUP; k++) {
    const float *n = f.discs + NSVCD__GROUP * g + k;
    const nsvcd__d3 normal = nsvcd__d3_widen(nsvcd__f3_get(n, b->padded));
    normals[1 + k] = normal;
    const double sign = nsvcd__d3_dot(normal, normals[1]) < 0 ? -1 : 1;
    normals[0] = nsvcd__d3_fma(sign, normal, normals[0]);
  }
  nsvcd__d3 best = {0, 0, 1};
  nsvcd__slab thinnest = {0, HUGE_VAL, 0};
  for (size_t k = 0; k < 1 + NSVCD__GROUP; k += k == 0 ? 1 : 4) {
    const double length = nsvcd__d3_length(normals[k]);
    if (!(length > 1e-3)) continue;
    // As it is stored, and no longer than 1.
    const nsvcd__d3 shorter = nsvcd__d3_scale(normals[k], 0.9999998 / length);
    const nsvcd__d3 unit = nsvcd__d3_widen(nsvcd__f3_round(shorter));
    const double most = thinnest.high - thinnest.low;
    const nsvcd__slab slab = nsvcd__slab_of_group(&f, g, unit, most);
    if (!(slab.high - slab.low < most)) continue;
    thinnest = slab;
    best = unit;
  }
  // float rounding, and that `across` takes |n| to be 1
  const double margin = 1e-6 * (double)b->extent;
  nsvcd__disc disc;
  disc.normal = nsvcd__f3_round(best);
  disc.low = (float)(thinnest.low - margin);
  disc.high = thinnest.high < HUGE_VAL ? (float)(thinnest.high + margin) : 0;
  disc.across = nsvcd__above(thinnest.across + margin);
  float *discs = (float *)nsvcd__writable(b, f.group_discs);
  nsvcd__disc_store(disc, discs, nsvcd__group_slots(b->padded), g);
}

// The surface in a group: spheres about the vertices of its patches' hulls. A patch without surface
// is a point.
typedef struct nsvcd__hulls {
  size_t count;
  float spheres[4][NSVCD__HULLS];  // x, y, z, r
} nsvcd__hulls;

static void nsvcd__gather_hulls(const nsvcd__facets *f, size_t g, nsvcd__hulls *out) {
  const size_t end = NSVCD__GROUP * (g + 1);
  out->count = 0;
  for (size_t i = end - NSVCD__GROUP; i < end && i < f->body->patches; i++) {
    const nsvcd__vertices vertices = nsvcd__vertices_of(f, i);
    const nsvcd__d3 origin = nsvcd__facet_origin(f, i);
    const double step = (double)f->steps[i];
    const size_t count = f->hull_counts[i];
    for (size_t k = 0; k < count + !count; k++) {
      nsvcd__d3 v = {0, 0, 0};
      if (count) v = nsvcd__vertex_at(&vertices, k);
      v = nsvcd__d3_fma(step, v, origin);
      // as float rounds it
      const double rounding = 1.1e-7 * nsvcd__d3_length(v);
      const double radius = (double)f->slacks[i] + rounding;
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
// above them, the box with the greatest of the quanta, and the groups' discs.
static void nsvcd__facets_finish(nsvcd_body *b) {
  const nsvcd__facets f = nsvcd__facets_of(b);
  const nsvcd__level groups = nsvcd__level_of(b->padded, 0);
  float *out = (float *)(b + 1) + groups.first;
  for (size_t g = 0; g < groups.slots; g++) {
    nsvcd__sphere over = {{0, 0, 0}, NSVCD__NOWHERE};
    nsvcd__hulls hulls;
    if (g < groups.count) {
      nsvcd__gather_hulls(&f, g, &hulls);
      over = nsvcd__cover_spheres(nsvcd__hull_spheres(&hulls), hulls.count);
    }
    nsvcd__sphere_store(over, out, groups.slots, g);
  }
  nsvcd__body_finish(b);
  const nsvcd__d3 all = {1, 1, 1};
  nsvcd__d3 low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  nsvcd__d3 high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  float widest = 0;
  for (size_t i = 0; i < b->patches; i++) {
    const nsvcd__vertices vertices = nsvcd__vertices_of(&f, i);
    const nsvcd__d3 origin = nsvcd__facet_origin(&f, i);
    const double quantum = (double)f.quanta[i];
    nsvcd__d3 least = {32767, 32767, 32767};
    nsvcd__d3 most = {-32767, -32767, -32767};
    for (size_t k = 0; k < vertices.count; k++) {
      const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, k);
      least = nsvcd__d3_min(least, vertex);
      most = nsvcd__d3_max(most, vertex);
    }
    if (vertices.count == 0) continue;
    least = nsvcd__d3_fma((double)f.steps[i], least, origin);
    most = nsvcd__d3_fma((double)f.steps[i], most, origin);
    low = nsvcd__d3_min(low, nsvcd__d3_fma(-quantum, all, least));
    high = nsvcd__d3_max(high, nsvcd__d3_fma(quantum, all, most));
    widest = f.quanta[i] > widest ? f.quanta[i] : widest;
  }
  // float rounding
  const double margin = 1e-6 * (double)b->extent;
  float *box = (float *)nsvcd__writable(b, f.box);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(-margin, all, low)), box);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(margin, all, high)), box + 3);
  box[6] = widest;
  box[7] = 0;
  for (size_t g = 0; g < nsvcd__body_groups(b); g++) nsvcd__finish_group(b, g);
  b->checksum = nsvcd__body_checksum(b);
}

#ifndef NSVCD_NO_ENCODER
// ---- writing

// Writes the numbers of patch i as codes; NULL: only counts their bytes. Returns how many.
static size_t nsvcd__numbers_write(const nsvcd__surface *s, size_t i, unsigned char *to) {
  size_t size = 0;
  uint32_t last = 0;
  for (size_t n = s->first_triangle[i]; n < s->first_triangle[i + 1]; n++) {
    const uint32_t id = s->ids[n];
    uint32_t code = ((id - last) & ~NSVCD__ENCLOSES) << 1 | id >> 31;
    for (int more = 1; more; code >>= 7) {
      more = code > 0x7f;
      if (to) to[size] = (unsigned char)(more ? code | 0x80 : code);
      size++;
    }
    last = id;
  }
  return size;
}

// The counts of the body of triangles that a surface makes.
static nsvcd__facet_counts nsvcd__facets_count(const nsvcd__surface *s) {
  nsvcd__facet_counts counts;
  memset(&counts, 0, sizeof counts);
  counts.listed = (uint32_t)s->listed;
  counts.vertices = (uint32_t)s->vertex_count;
  counts.components = (uint32_t)s->seed_count;
  uint64_t bytes = 0;
  for (size_t i = 0; i < s->count; i++) {
    const size_t vertices = s->first_vertex[i + 1] - s->first_vertex[i];
    const size_t triangles = s->first_triangle[i + 1] - s->first_triangle[i];
    bytes += (uint64_t)3 * triangles * nsvcd__corner_bytes(vertices);
    bytes += nsvcd__numbers_write(s, i, NULL);
  }
  // then the body is refused as too large
  counts.listings_size = bytes < 0xffffffffu ? (uint32_t)bytes : 0xffffffffu;
  return counts;
}

// Writes patch `to`, from patch `from` of a surface. One without surface is a point.
static void nsvcd__patch_write(const nsvcd__surface *s, size_t from, nsvcd_body *b,
                               nsvcd__facets f, size_t to) {
  const size_t padded = b->padded;
  nsvcd__sphere ball = s->balls[from];
  if (s->hull_counts[from] == 0) ball.radius = 0;
  nsvcd__sphere_store(ball, (float *)(b + 1), padded, to);
  nsvcd__disc_store(s->discs[from], (float *)nsvcd__writable(b, f.discs), padded, to);
  *(float *)nsvcd__writable(b, f.steps + to) = s->steps[from];
  *(float *)nsvcd__writable(b, f.slacks + to) = s->slacks[from];
  *(float *)nsvcd__writable(b, f.quanta + to) = s->quanta[from];
  *(uint8_t *)nsvcd__writable(b, f.hull_counts + to) = s->hull_counts[from];

  const size_t vertex = s->first_vertex[from];
  const size_t vertices = s->first_vertex[from + 1] - vertex;
  const size_t first = s->first_triangle[from];
  const size_t end = s->first_triangle[from + 1];
  uint32_t *first_vertex = (uint32_t *)nsvcd__writable(b, f.first_vertex + to);
  uint32_t *first_triangle = (uint32_t *)nsvcd__writable(b, f.first_triangle + to);
  uint32_t *first_byte = (uint32_t *)nsvcd__writable(b, f.first_byte + to);
  void *integers = nsvcd__writable(b, f.vertices + 3 * (size_t)first_vertex[0]);
  memcpy(integers, s->vertices + 3 * vertex, 6 * vertices);
  unsigned char *begin = (unsigned char *)nsvcd__writable(b, f.listings + first_byte[0]);
  unsigned char *at = begin;
  const size_t bytes = nsvcd__corner_bytes(vertices);
  for (size_t n = 3 * first; n < 3 * end; n++) {
    const uint16_t corner = s->corners[n];
    if (bytes == 1) at[0] = (unsigned char)corner;
    if (bytes == 2) memcpy(at, &corner, 2);
    at += bytes;
  }
  at += nsvcd__numbers_write(s, from, at);
  first_vertex[1] = first_vertex[0] + (uint32_t)vertices;
  first_triangle[1] = first_triangle[0] + (uint32_t)(end - first);
  first_byte[1] = first_byte[0] + (uint32_t)(at - begin);
}

// Writes the seeds of a body of triangles, group by group (counting sort). order: of the patches.
static void nsvcd__seeds_write(const nsvcd__surface *s, const uint16_t *order, nsvcd_body *b) {
  const nsvcd__facets f = nsvcd__facets_of(b);
  uint32_t *first_seed = (uint32_t *)nsvcd__writable(b, f.first_seed);
  float *seeds = (float *)nsvcd__writable(b, f.seeds);
  // Until the body is whole, the places of patches are kept where their first vertices will be.
  uint32_t *places = (uint32_t *)nsvcd__writable(b, f.first_vertex);
  const size_t groups = nsvcd__body_groups(b);
  for (size_t i = 0; i < b->patches; i++) places[order[i]] = (uint32_t)i;
  for (size_t n = 0; n < s->seed_count; n++) {
    const size_t g = places[s->seed_patches[n]] / NSVCD__GROUP;
    first_seed[g + 1]++;
  }
  for (size_t g = 0; g < groups; g++) first_seed[g + 1] += first_seed[g];
  for (size_t n = s->seed_count; n-- > 0;) {
    const size_t g = places[s->seed_patches[n]] / NSVCD__GROUP;
    const size_t to = --first_seed[g + 1];
    nsvcd__f3_store(s->seeds[n], seeds + 3 * to);
  }
  // Now first_seed[g + 1] is where group g begins.
  memmove(first_seed, first_seed + 1, groups * sizeof *first_seed);
  first_seed[groups] = (uint32_t)s->seed_count;
  memset(places, 0, b->patches * sizeof *places);
}

// Builds a body of triangles of `size` bytes in `memory`. triangles: of the mesh. order: (N) of the
// patches. NUMBER if it would be too large, EMPTY if it would be too small.
static nsvcd_result nsvcd__facets_build(const nsvcd__surface *s,
                                        const nsvcd__facet_counts *counts, size_t triangles,
                                        const uint16_t *order, int open, void *memory,
                                        size_t size) {
  nsvcd_body *b = nsvcd__body_begin(memory, size, s->count, open);
  b->triangles = (uint32_t)triangles;
  memcpy(nsvcd__writable(b, nsvcd__counts_of(b)), counts, sizeof *counts);
  nsvcd__seeds_write(s, order, b);
  const nsvcd__facets f = nsvcd__facets_of(b);
  for (size_t i = 0; i < s->count; i++) nsvcd__patch_write(s, order[i], b, f, i);
  if (!nsvcd__within(nsvcd__body_r(b), b->patches, 4 * NSVCD_MAX_COORDINATE))
    return NSVCD_ERROR_NUMBER;
  nsvcd__facets_finish(b);
  return b->radius + counts->round < NSVCD_MIN_RADIUS ? NSVCD_ERROR_EMPTY : NSVCD_OK;
}
#endif
#endif  // NSVCD_NO_PROOF

// Of a sphere about a body, with what it goes beyond its triangles.
static float nsvcd__whole_radius(const nsvcd_body *body) {
#ifndef NSVCD_NO_PROOF
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  if (triangles) return body->radius + nsvcd__counts_of(triangles)->round;
#endif
  return body->radius;
}
