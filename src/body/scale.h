// In: a body. Out: a copy that is scaled, by a factor for each axis.
//
// Factors that differ make of a patch's sphere an ellipsoid. All that bounds a patch is then found
// anew from its hull, whose vertices are stored points, and stay what they are.
#pragma once
#include "trust.h"

typedef struct nsvcd__factors {
  double axes[3];
  // of their absolute values
  double least, most;
  int are_equal, mirror;
} nsvcd__factors;

static nsvcd__factors nsvcd__factors_of(const float *scale) {
  nsvcd__factors out = {{0}, HUGE_VAL, 0, 0, 0};
  for (size_t k = 0; k < 3; k++) {
    out.axes[k] = (double)scale[k];
    out.least = nsvcd__min(out.least, fabs(out.axes[k]));
    out.most = nsvcd__max(out.most, fabs(out.axes[k]));
    out.mirror ^= scale[k] < 0;
  }
  out.are_equal = scale[0] == scale[1] && scale[0] == scale[2] && scale[0] > 0;
  return out;
}

// Would the scaled spheres still be within the limits of nsvcd_body_load? In double, for the
// products may overflow a float.
static int nsvcd__spheres_fit(const nsvcd_body *b, float radius, const nsvcd__factors *by) {
  const double most = (double)NSVCD_MAX_COORDINATE / by->most;
  if ((double)radius * by->least < (double)NSVCD_MIN_RADIUS) return 0;
  for (size_t i = 0; i < 3 * (size_t)b->padded; i++) {
    if (fabs((double)nsvcd__body_patches(b).x[i]) > most) return 0;
  }
  // no radius or centre of a group exceeds twice the extent
  return 2 * (double)b->extent <= (double)NSVCD__MAX_LENGTH / by->most;
}

static void nsvcd__scale_spheres(nsvcd_body *b, const nsvcd__factors *by) {
  float *spheres = (float *)(b + 1);
  for (size_t i = 0; i < 3 * (size_t)b->padded + b->patches; i++)
    spheres[i] *= (float)(i < 3 * (size_t)b->padded ? by->axes[i / b->padded] : by->most);
}

// Scales a body of latents, without the body of triangles in it.
static void nsvcd__scale_latents(nsvcd_body *b, const nsvcd__factors *by) {
  float *areas = (float *)nsvcd__writable(b, nsvcd__body_areas(b));
  nsvcd__scale_spheres(b, by);
  for (size_t i = 0; i < 3 * nsvcd__area_slots(b->padded); i++) {
    areas[i] *= (float)by->most;
    areas[i] *= (float)by->most;
  }
  nsvcd__cover_level(b, 0, nsvcd__body_patches(b), b->patches);
  nsvcd__body_finish(b);
  b->checksum = nsvcd__body_checksum(b);
}

// Scales the balls, which become larger by what rounding does to them and to the vertices. Where
// factors differ, a ball is still one, about what the ellipsoid was.
static void nsvcd__scale_balls(const nsvcd__geometry *f, const nsvcd__factors *by) {
  const nsvcd__covering all = nsvcd__covering_of(f->body);
  double rounding = 0;
  for (size_t n = 0; n < f->counts->balls; n++) {
    nsvcd__sphere ball = nsvcd__sphere_of(all.balls, n);
    const nsvcd__d3 centre =
        nsvcd__d3_of((double)ball.centre.x * by->axes[0], (double)ball.centre.y * by->axes[1],
                     (double)ball.centre.z * by->axes[2]);
    const double radius = (double)ball.radius * by->most;
    const double more = 5e-7 * (nsvcd__d3_norm(centre) + radius);
    const double beyond = (double)ball.radius * (by->most - by->least);
    rounding = nsvcd__max(rounding, 2 * more + beyond);
    ball.centre = nsvcd__f3_round(centre);
    ball.radius = nsvcd__above(radius + more);
    nsvcd__sphere_store(ball, f->balls, all.ball_slots, n);
  }
  if (f->counts->balls > 0)
    f->counts->ball_error = nsvcd__above((double)f->counts->ball_error * by->most + rounding);
  nsvcd__cover_balls(f);
}

// Stretches the stored points of a patch, whose step is scaled, to whole steps.
static void nsvcd__stretch_points(const nsvcd__geometry *f, size_t i,
                                  const nsvcd__factors *by) {
  const size_t first = f->first_vertex[i];
  const size_t count = f->first_vertex[i + 1] - first;
  for (size_t n = 0; n < 3 * count; n++) {
    int16_t *at = f->vertices + 3 * first + n;
    const double whole = floor((double)*at * (by->axes[n / count] / by->most) + 0.5);
    *at = (int16_t)nsvcd__min(nsvcd__max(whole, -32767), 32767);
  }
}

// The slab and the sphere of a patch whose points are stretched. A plane's normal n becomes n / s,
// axis by axis.
static void nsvcd__stretch_patch(const nsvcd__geometry *f, size_t i,
                                 const nsvcd__factors *by) {
  const nsvcd_body *b = f->body;
  nsvcd__slab slab = nsvcd__slab_at(f->slabs, b->padded, i);
  const nsvcd__d3 turned =
      nsvcd__d3_of((double)slab.normal.x / by->axes[0], (double)slab.normal.y / by->axes[1],
                   (double)slab.normal.z / by->axes[2]);
  const double length = nsvcd__d3_norm(turned);
  // as it is stored, and not longer than 1
  if (length > 0) slab.normal = nsvcd__f3_round(nsvcd__d3_scale(turned, 0.9999998 / length));
  const nsvcd__d3 normal = nsvcd__d3_widen(slab.normal);
  const nsvcd__vertices vertices = nsvcd__vertices_of(f, i);
  const double margin = (double)f->margins[i];
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  double across = 0;
  double farthest = 0;
  for (size_t k = 0; k < f->hull_counts[i]; k++) {
    const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, k);
    const nsvcd__d3 v = nsvcd__d3_scale(vertex, (double)f->steps[i]);
    const double height = nsvcd__d3_dot(normal, v);
    const double square = nsvcd__d3_dot(v, v);
    low = nsvcd__min(low, height);
    high = nsvcd__max(high, height);
    farthest = nsvcd__max(farthest, square);
    across = nsvcd__max(across, square - height * height);
  }
  if (f->hull_counts[i] == 0) return;
  // of what is computed here
  const double reach = (1 + 1e-6) * (sqrt(farthest) + margin);
  const double more = margin + 1e-6 * reach;
  slab.low = (float)(low - more);
  slab.high = (float)(high + more);
  slab.across = nsvcd__above(sqrt(across) + more);
  nsvcd__slab_store(slab, f->slabs, b->padded, i);
  float *radius = (float *)nsvcd__writable(f->body, nsvcd__body_r(b) + i);
  *radius = (float)nsvcd__min((double)*radius, (double)nsvcd__above(reach));
}

// Turns triangles round, which a mirror has turned inside out.
static void nsvcd__turn_triangles(const nsvcd__geometry *f) {
  for (size_t i = 0; i < f->body->patches; i++) {
    const size_t bytes = nsvcd__corner_bytes(nsvcd__points_of(f, i).all);
    unsigned char *at = f->entries + f->first_byte[i];
    for (uint32_t n = f->first_triangle[i]; n < f->first_triangle[i + 1]; n++) {
      unsigned char corner[2];
      memcpy(corner, at + bytes, bytes);
      memmove(at + bytes, at + 2 * bytes, bytes);
      memcpy(at + 2 * bytes, corner, bytes);
      at += 3 * bytes;
    }
  }
  for (size_t n = 0; n < f->counts->cut; n++) {
    uint32_t *corners = f->cut_corners + 3 * n;
    const uint32_t corner = corners[1];
    corners[1] = corners[2];
    corners[2] = corner;
  }
}

// Scales a body of triangles. What rounding does to vertices and to the convex radius widens the
// margins and errors, and is what vertices are off by.
static void nsvcd__scale_triangles(nsvcd_body *b, const nsvcd__factors *by) {
  const nsvcd__geometry f = nsvcd__geometry_of(b);
  float *radius = &f.counts->convex_radius;
  const double exact = (double)*radius * by->most;
  nsvcd__scale_spheres(b, by);
  *radius *= (float)by->most;
  const double off = fabs(exact - (double)*radius);
  if (f.counts->gap > 0) f.counts->gap = nsvcd__above((double)f.counts->gap * by->most);
  double worst = off;
  for (size_t i = 0; i < 3 * (size_t)f.counts->positions; i++) {
    const double whole = (double)f.positions[i] * by->axes[i % 3];
    f.positions[i] *= (float)by->axes[i % 3];
    worst = nsvcd__max(worst, 1.8 * fabs(whole - (double)f.positions[i]) + off);
  }
  const double off_mesh = worst + (double)nsvcd__off_mesh(&f) * by->most;
  for (size_t i = 0; i < b->patches; i++) {
    const double distance = (double)nsvcd__f3_norm(nsvcd__patch_centre(&f, i));
    nsvcd__slab slab = nsvcd__slab_at(f.slabs, b->padded, i);
    f.steps[i] *= (float)by->most;
    const double step = (double)f.steps[i];
    // half a step along each axis, where points are stretched
    const double rounding = 2e-7 * (distance + 6e4 * step) + off + (by->are_equal ? 0 : step);
    f.margins[i] = nsvcd__above((double)f.margins[i] * by->most + rounding);
    f.errors[i] = nsvcd__above((double)f.errors[i] * by->most + rounding + worst);
    slab.low = (float)((double)slab.low * by->most - rounding);
    slab.high = (float)((double)slab.high * by->most + rounding);
    slab.across = nsvcd__above((double)slab.across * by->most + rounding);
    nsvcd__slab_store(slab, f.slabs, b->padded, i);
    if (by->are_equal) continue;
    nsvcd__stretch_points(&f, i, by);
    nsvcd__stretch_patch(&f, i, by);
  }
  for (size_t i = 0; i < 3 * (size_t)f.counts->components; i++)
    f.seeds[i] *= (float)by->axes[i % 3];
  if (by->mirror) nsvcd__turn_triangles(&f);
  nsvcd__scale_balls(&f, by);
  nsvcd__geometry_finish(b, off_mesh > 0 ? nsvcd__above(off_mesh) : 0);
}

// May a body be scaled by these?
static nsvcd_result nsvcd__factors_check(const nsvcd_body *body, const nsvcd__factors *by) {
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  const int is_round = triangles && nsvcd__counts_of(triangles)->convex_radius > 0;
  // else the triangles would keep their size, and loading did not check them
  if (!NSVCD__PROOF && body->triangles) return NSVCD_ERROR_TRIANGLES;
  if (!by->are_equal && !triangles) return NSVCD_ERROR_TRIANGLES;
  if (is_round && by->least < by->most) return NSVCD_ERROR_SCALE;
  const float radius = nsvcd__whole_radius(body);
  if (!nsvcd__spheres_fit(body, radius, by)) return NSVCD_ERROR_SCALE;
  if (triangles && !nsvcd__spheres_fit(triangles, radius, by)) return NSVCD_ERROR_SCALE;
  const double most = (double)NSVCD__MAX_LENGTH / by->most;
  const size_t numbers = body->weights_id ? 3 * nsvcd__area_slots(body->padded) : 0;
  for (size_t i = 0; i < numbers; i++) {
    if (fabs((double)nsvcd__body_areas(body)[i]) > most * most) return NSVCD_ERROR_SCALE;
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_body_scale(const nsvcd_body *body, const float scale[3],
                                       void *memory, size_t capacity,
                                       const nsvcd_body **scaled) {
  if (!scale || !memory || !scaled) return NSVCD_ERROR_ARGUMENT;
  nsvcd_result result = nsvcd__body_check(body, SIZE_MAX);
  if (result) return result;
  for (size_t k = 0; k < 3; k++) {
    if (!nsvcd__is_finite(scale[k]) || !(fabsf(scale[k]) > 0)) return NSVCD_ERROR_SCALE;
  }
  if (capacity < body->size || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  const nsvcd__factors by = nsvcd__factors_of(scale);
  result = nsvcd__factors_check(body, &by);
  if (result) return result;
  // latents know no factors that differ, and are left behind
  const nsvcd_body *from = by.are_equal ? body : nsvcd__triangles_of(body);
  // may be in place
  memmove(memory, from, from->size);
  nsvcd_body *b = (nsvcd_body *)memory;
  if (nsvcd__triangles_of(b))
    nsvcd__scale_triangles((nsvcd_body *)(void *)((char *)memory + b->inner), &by);
  if (b->weights_id) nsvcd__scale_latents(b, &by);
  *scaled = b;
  return NSVCD_OK;
}
