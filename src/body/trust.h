// In: bytes of any origin. Out: a body, if nsvcd_encode could have written them.
#pragma once
#include "geometry.h"

// ---- spheres: both kinds of bodies begin with them

// Does a sphere contain `count` spheres?
static int nsvcd__covers(nsvcd__sphere sphere, nsvcd__spheres all, size_t count) {
  size_t farthest = 0;
  return nsvcd__radius_about(all, count, sphere.centre, &farthest) <= sphere.radius;
}

// Are the first `count` of (4, slots) spheres finite and in range, with no negative radius, and the
// others padding? most: of the coordinates.
static int nsvcd__are_spheres(nsvcd__spheres all, size_t count, size_t slots, float most) {
  int ok = nsvcd__in_range(all.x, 3 * slots, most) &&
           nsvcd__in_range(all.r, count, NSVCD__MAX_LENGTH) &&
           nsvcd__in_range(all.r, slots, -NSVCD__NOWHERE);
  for (size_t i = 0; ok && i < count; i++) ok = all.r[i] >= 0;
  for (size_t i = count; ok && i < slots; i++) {
    ok = all.r[i] == NSVCD__NOWHERE;
    ok &= all.x[i] == 0 && all.y[i] == 0 && all.z[i] == 0;
  }
  return ok;
}

// Does each of a level's spheres contain its 16 of `members` spheres below?
static int nsvcd__level_covers(nsvcd__spheres level, nsvcd__spheres below, size_t members) {
  int ok = 1;
  for (size_t i = 0; ok && i < members; i += NSVCD__GROUP) {
    const size_t count = nsvcd__group_members(members, i);
    const nsvcd__sphere sphere = nsvcd__sphere_of(level, i / NSVCD__GROUP);
    ok = nsvcd__covers(sphere, nsvcd__spheres_from(below, i), count);
  }
  return ok;
}

// Are the spheres of a blob with a sound header in range, and does each one above the groups
// contain what is below it? The checksum catches accidents; this catches blobs made to harm: a
// wrong sphere would hide collisions.
static int nsvcd__spheres_are_sound(const nsvcd_body *b) {
  const float most = NSVCD__MAX_LENGTH;
  const nsvcd__spheres patches = nsvcd__body_patches(b);
  const nsvcd__spheres groups = nsvcd__groups_of(b);
  nsvcd__spheres below = groups;
  size_t members = 0;
  int ok = nsvcd__are_spheres(patches, b->patches, b->padded, NSVCD_MAX_COORDINATE) &&
           nsvcd__in_range(b->centre, 3, most) && nsvcd__in_range(&b->radius, 1, most) &&
           nsvcd__in_range(&b->extent, 1, most) && b->radius >= 0;
  for (size_t k = 0; ok && k < nsvcd__level_count(b->padded); k++) {
    const nsvcd__level level = nsvcd__level_of(b->padded, k);
    const nsvcd__spheres above = nsvcd__level_spheres(b, level);
    ok = nsvcd__are_spheres(above, level.count, level.slots, most) &&
         nsvcd__level_covers(above, below, members);
    below = above;
    members = level.count;
  }
  const nsvcd__sphere whole = nsvcd__body_sphere(b);
  const nsvcd__sphere about_origin = {{0, 0, 0}, b->extent};
  return ok && nsvcd__covers(about_origin, patches, b->patches) &&
         (nsvcd__covers(whole, patches, b->patches) ||
          nsvcd__covers(whole, groups, nsvcd__body_groups(b)));
}

#ifndef NSVCD_NO_NETWORK
// Are the extremes in range, and is their padding zero?
static int nsvcd__extremes_are_sound(const nsvcd_body *b) {
  const int8_t *extremes = nsvcd__group_extremes(b, 0);
  for (size_t n = 0; n < (size_t)3 * NSVCD__EXTREMES * b->padded; n++) {
    const size_t group = n / (3 * NSVCD__EXTREMES * NSVCD__GROUP);
    const int exists = NSVCD__GROUP * group + n % NSVCD__GROUP < b->patches;
    if (extremes[n] == -128 || (!exists && extremes[n] != 0)) return 0;
  }
  return 1;
}
#endif

// ---- the triangles

// Do `count` + 1 numbers rise from 0 to `last`?
static int nsvcd__rise(const uint32_t *first, size_t count, size_t last) {
  int rise = first[0] == 0 && first[count] == last;
  for (size_t i = 0; i < count; i++) rise &= first[i] <= first[i + 1];
  return rise;
}

// Do all arrays of patches, groups and numbers of vertices stay within each other?
static int nsvcd__are_laid_out(const nsvcd__geometry *f) {
  const nsvcd__counts *n = f->counts;
  const nsvcd_body *b = f->body;
  const size_t patches = b->patches;
  const size_t own = f->first_own[patches];
  int ok = own <= n->positions && nsvcd__rise(f->first_own, patches, own) &&
           nsvcd__rise(f->first_vertex, patches, n->vertices) &&
           nsvcd__rise(f->first_reference, patches, n->references) &&
           nsvcd__rise(f->first_triangle, patches, n->listed) &&
           nsvcd__rise(f->first_byte, patches, n->entry_bytes) &&
           nsvcd__rise(f->first_seed, nsvcd__body_groups(b), n->components);
  for (size_t i = 0; ok && i < n->references; i++)
    ok = nsvcd__reference_at(f, i) < n->positions;
  for (size_t i = 0; ok && i < n->cut; i++)
    ok = f->cut[i] < b->triangles && (i == 0 || f->cut[i] > f->cut[i - 1]);
  for (size_t i = 0; ok && i < 3 * (size_t)n->cut; i++) ok = f->cut_corners[i] < n->positions;
  return ok;
}

// Are the entries of patch i sound?
static int nsvcd__patch_is_sound(const nsvcd__geometry *f, size_t i) {
  const nsvcd__patch_points points = nsvcd__points_of(f, i);
  const size_t triangle = f->first_triangle[i];
  const size_t triangles = f->first_triangle[i + 1] - triangle;
  const size_t hull_count = f->hull_counts[i];
  if (hull_count > NSVCD__HULL || hull_count > points.stored) return 0;
  if ((hull_count == 0) != (triangles == 0)) return 0;
  if ((hull_count == 0) != (points.all == 0)) return 0;

  const uint64_t corners = (uint64_t)3 * triangles * nsvcd__corner_bytes(points.all);
  const uint64_t corners_end = f->first_byte[i] + corners;
  if (corners_end > f->first_byte[i + 1]) return 0;
  for (size_t n = 0; n < 3 * triangles; n++) {
    if (nsvcd__triangle_corner(f, i, triangle + n / 3, n % 3) >= points.all) return 0;
  }
  // as many codes follow, of triangles that exist, and nothing else
  const unsigned char *at = f->entries + (size_t)corners_end;
  const unsigned char *end = f->entries + f->first_byte[i + 1];
  uint32_t number = 0;
  for (size_t n = 0; n < triangles; n++) {
    const size_t left = (size_t)(end - at);
    size_t bytes = 1;
    while (bytes < 5 && bytes < left && at[bytes - 1] & 0x80) bytes++;
    if (at >= end || at[bytes - 1] & 0x80) return 0;
    number = (number + (nsvcd__read_code(&at) >> f->kind_bits)) & NSVCD__NUMBER;
    if (number >= f->body->triangles) return 0;
  }
  return at == end;
}

// ---- whole bodies

// Are the sizes in a blob's header right, and is it at most `size` bytes long?
static int nsvcd__header_is_sound(const nsvcd_body *b, size_t size) {
  return size >= sizeof *b && b->magic == NSVCD__BODY_MAGIC &&
         b->version == NSVCD__BODY_VERSION && b->patches >= 1 &&
         b->patches <= NSVCD_MAX_PATCHES && b->open <= 1 && b->size <= size &&
         b->padded == nsvcd__round_up(b->patches, NSVCD__GROUP) &&
         b->size >= nsvcd__spheres_size(b->padded) && b->size % NSVCD_ALIGNMENT == 0;
}

// Are the numbers of a body of triangles in range?
static int nsvcd__are_in_range(const nsvcd__geometry *f) {
  const nsvcd__counts *n = f->counts;
  const size_t padded = f->body->padded;
  const size_t slots = nsvcd__group_slots(padded);
  const float most = NSVCD__MAX_LENGTH;
  int ok = nsvcd__in_range(f->box, NSVCD__GEOMETRY_BOX, most) &&
           nsvcd__in_range(f->slabs, 3 * padded, 1.000001f) &&
           nsvcd__in_range(f->slabs + 3 * padded, 3 * padded, most) &&
           nsvcd__in_range(f->group_slabs, 3 * slots, 1.000001f) &&
           nsvcd__in_range(f->group_slabs + 3 * slots, 3 * slots, most) &&
           nsvcd__in_range(f->steps, padded, most / 32768) &&
           nsvcd__in_range(f->margins, padded, most) &&
           nsvcd__in_range(f->errors, padded, nsvcd__widest_error(f)) &&
           nsvcd__in_range(f->seeds, 3 * (size_t)n->components, most) &&
           nsvcd__in_range(f->positions, 3 * (size_t)n->positions, most) &&
           nsvcd__off_mesh(f) >= 0;
  for (size_t i = 0; ok && i < padded; i++) {
    const nsvcd__slab slab = nsvcd__slab_at(f->slabs, padded, i);
    ok = slab.across >= 0 && f->steps[i] >= 0 && f->margins[i] >= 0 && f->errors[i] >= 0;
  }
  return ok;
}

// Are the balls spheres, and is each 16 in the sphere over them? Whether they cover the surface is
// not checked: looks prove nothing.
static int nsvcd__balls_are_sound(const nsvcd_body *body) {
  const nsvcd__covering all = nsvcd__covering_of(body);
  const size_t count = all.counts->balls;
  const size_t clusters = all.ball_slots / NSVCD__GROUP;
  const float most = NSVCD__MAX_LENGTH;
  return nsvcd__are_spheres(all.balls, count, all.ball_slots, most) &&
         nsvcd__are_spheres(all.clusters, clusters, all.cluster_slots, most) &&
         nsvcd__level_covers(all.clusters, all.balls, count);
}

// Is a body of triangles sound, if its header is? Checks the spheres, the layout (sizes, counts and
// indices), and that numbers are in range: they may misstate the surface, but nothing computed from
// them overflows. size: bytes, at most.
static int nsvcd__triangles_are_sound(const nsvcd_body *b, size_t size) {
  const nsvcd__counts *n = nsvcd__counts_of(b);
  const uint64_t counted = nsvcd__spheres_size(b->padded) + sizeof *n;
  nsvcd__geometry f;
  if (b->inner != 0 || b->triangles == 0 || !nsvcd__spheres_are_sound(b)) return 0;
  if (counted > size || n->open_solids > n->solids || n->is_mixed > 1) return 0;
  if (n->balls > NSVCD_MAX_BALLS || n->is_box > 1 || !nsvcd__is_length(n->ball_error))
    return 0;
  if (!nsvcd__is_length(n->gap) || !nsvcd__is_length(n->convex_radius)) return 0;
  if (b->radius + n->convex_radius < NSVCD_MIN_RADIUS) return 0;
  const size_t needed = nsvcd__geometry_layout(NULL, b->patches, n, &f);
  if (b->size != needed || b->size > size) return 0;
  f = nsvcd__geometry_of(b);
  int ok = nsvcd__are_laid_out(&f) && nsvcd__are_in_range(&f) && nsvcd__balls_are_sound(b);
  for (size_t i = 0; ok && i < b->patches; i++) ok = nsvcd__patch_is_sound(&f, i);
  for (size_t g = 0; ok && g < nsvcd__body_groups(b); g++) {
    nsvcd__hulls hulls;
    nsvcd__collect_hulls(&f, g, &hulls);
    const nsvcd__spheres all = nsvcd__hull_spheres(&hulls);
    const nsvcd__sphere over = nsvcd__sphere_of(nsvcd__groups_of(b), g);
    ok = nsvcd__covers(over, all, hulls.count);
  }
  return ok;
}

// Is a body sound, if its header and its checksum are?
static int nsvcd__body_is_sound(const nsvcd_body *b) {
  if (b->weights_id == 0) return NSVCD__PROOF && nsvcd__triangles_are_sound(b, b->size);
  if (b->size < nsvcd__latents_begin(b->padded)) return 0;
  if (!nsvcd__spheres_are_sound(b) || !nsvcd__areas_are_sound(b)) return 0;
  if (b->radius < NSVCD_MIN_RADIUS) return 0;
  if (!nsvcd__level_covers(nsvcd__groups_of(b), nsvcd__body_patches(b), b->patches)) return 0;
#ifndef NSVCD_NO_NETWORK
  if (b->weights_id != NSVCD_WEIGHTS_ID) return 0;
  const size_t latents = nsvcd_body_size(b->patches);
  if (b->size < latents || !nsvcd__extremes_are_sound(b)) return 0;
  if (b->inner == 0) return b->size == latents && b->triangles == 0;
  if (b->inner != latents) return 0;
#else
  if (b->inner % NSVCD_ALIGNMENT || b->inner >= b->size) return 0;
  if (b->inner < nsvcd__latents_begin(b->padded)) return 0;
#endif
  const char *at = (const char *)b + b->inner;
  const nsvcd_body *inner = (const nsvcd_body *)(const void *)at;
  const size_t left = b->size - b->inner;
  return nsvcd__header_is_sound(inner, left) && inner->size == left &&
         inner->weights_id == 0 && inner->open == b->open && inner->patches == b->patches &&
         inner->triangles == b->triangles &&
         (!NSVCD__PROOF || nsvcd__triangles_are_sound(inner, left));
}

// Is this a body, by its header? If it does not begin as one (a text, a nsvcd_mesh), no more than
// its first eight bytes are read.
static nsvcd_result nsvcd__body_check(const nsvcd_body *b, size_t size) {
  if (!b) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__is_aligned(b) || size < sizeof b->magic + sizeof b->version)
    return NSVCD_ERROR_BODY;
  if (b->magic == NSVCD__OTHER_MAGIC) return NSVCD_ERROR_VERSION;
  if (b->magic != NSVCD__BODY_MAGIC) return NSVCD_ERROR_BODY;
  if (b->version != NSVCD__BODY_VERSION) return NSVCD_ERROR_VERSION;
  if (!nsvcd__header_is_sound(b, size)) return NSVCD_ERROR_BODY;
#ifndef NSVCD_NO_NETWORK
  if (b->weights_id && b->weights_id != NSVCD_WEIGHTS_ID) return NSVCD_ERROR_VERSION;
#endif
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_body_trust(const void *memory, size_t size,
                                       const nsvcd_body **body) {
  const nsvcd_body *b = (const nsvcd_body *)memory;
  if (!body) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_result result = nsvcd__body_check(b, size);
  if (!result) *body = b;
  return result;
}

NSVCDDEF nsvcd_result nsvcd_body_load(const void *memory, size_t size,
                                      const nsvcd_body **body) {
  const nsvcd_body *b = NULL;
  const nsvcd_result result = nsvcd_body_trust(memory, size, body ? &b : NULL);
  if (result) return result;
  if (b->checksum != nsvcd__body_checksum(b) || !nsvcd__body_is_sound(b))
    return NSVCD_ERROR_BODY;
  *body = b;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_body_facts nsvcd_body_describe(const nsvcd_body *body) {
  nsvcd_body_facts facts;
  memset(&facts, 0, sizeof facts);
  if (nsvcd__body_check(body, SIZE_MAX)) return facts;
  facts.size = body->size;
  facts.patches = body->patches;
  memcpy(facts.centre, body->centre, sizeof facts.centre);
  facts.radius = nsvcd__whole_radius(body);
  facts.extent = body->extent;
  facts.latents = body->weights_id != 0;
  facts.open = (int)body->open;
  for (size_t i = 0; i < body->patches; i++)
    facts.mean_patch_radius += nsvcd__body_r(body)[i] / (float)body->patches;
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  if (triangles) {
    const nsvcd__geometry f = nsvcd__geometry_of(triangles);
    facts.triangles = triangles->triangles;
    facts.stored_triangles = f.counts->listed;
    memcpy(facts.low, f.box, sizeof facts.low);
    memcpy(facts.high, f.box + 3, sizeof facts.high);
    facts.quantization_error = nsvcd__off_mesh(&f);
    facts.convex_radius = f.counts->convex_radius;
    facts.balls = f.counts->balls;
    facts.ball_error = f.counts->ball_error;
    facts.components = f.counts->solids;
    facts.open_components = f.counts->open_solids;
    facts.open_edges = f.counts->open_edges;
  }
  return facts;
}

NSVCDDEF int nsvcd_body_patch(const nsvcd_body *body, uint32_t patch, float centre[3],
                              float *radius) {
  if (nsvcd__body_check(body, SIZE_MAX) || patch >= body->patches) return 0;
  const nsvcd__sphere sphere = nsvcd__sphere_of(nsvcd__body_patches(body), patch);
  nsvcd__f3_store(sphere.centre, centre);
  *radius = sphere.radius + nsvcd__whole_radius(body) - body->radius;
  return 1;
}
