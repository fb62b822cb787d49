// In: a mesh. Out: its volume, centre of mass and moments of inertia, as a solid of one density.
#pragma once
#include "../interface/worlds.h"
#include "../ground/valid.h"
#include "../ground/points.h"

// relative: how far what a closed mesh adds up to is off, for rounding and pinholes
#define NSVCD__CLOSED 1e-5

// Of the volume between a point and each triangle, in coordinates from there.
typedef struct nsvcd__moments {
  double volume;
  // of x, y and z; of their squares
  nsvcd__d3 first, second;
  // the sum of areas, of areas as vectors, and of x, y and z times these. Of a closed surface the
  // second is 0, and each of the third is the volume along its axis
  double area;
  nsvcd__d3 areas, by[3];
} nsvcd__moments;

static void nsvcd__moments_add(nsvcd__moments *m, nsvcd__d3 a, nsvcd__d3 b, nsvcd__d3 c) {
  const nsvcd__d3 area =
      nsvcd__d3_scale(nsvcd__d3_cross(nsvcd__d3_sub(b, a), nsvcd__d3_sub(c, a)), 0.5);
  const nsvcd__d3 sum = nsvcd__d3_add(nsvcd__d3_add(a, b), c);
  const double volume = nsvcd__d3_dot(a, area) / 3;
  m->volume += volume;
  m->first = nsvcd__d3_fma(volume / 4, sum, m->first);
  m->area += nsvcd__d3_norm(area);
  m->areas = nsvcd__d3_add(m->areas, area);
  for (size_t k = 0; k < 3; k++) {
    const double x = nsvcd__d3_axis(a, k);
    const double y = nsvcd__d3_axis(b, k);
    const double z = nsvcd__d3_axis(c, k);
    const double all = x + y + z;
    const double squares = (x * x + y * y + z * z + all * all) / 20;
    nsvcd__d3_set_axis(&m->second, k, nsvcd__d3_axis(m->second, k) + volume * squares);
    m->by[k] = nsvcd__d3_fma(all / 3, area, m->by[k]);
  }
}

// Do areas add up as those of a closed surface do? size: of its box.
static int nsvcd__adds_up(const nsvcd__moments *m, double size) {
  const double most = NSVCD__CLOSED * m->area;
  if (!(m->volume > most * size) || nsvcd__d3_norm(m->areas) > most) return 0;
  for (size_t k = 0; k < 3; k++) {
    nsvcd__d3 off = m->by[k];
    nsvcd__d3_set_axis(&off, k, nsvcd__d3_axis(off, k) - m->volume);
    if (nsvcd__d3_norm(off) > most * size) return 0;
  }
  return 1;
}

static nsvcd_result nsvcd__box_of_mesh(const nsvcd_mesh *mesh, nsvcd__box *box) {
  if (!mesh || !mesh->positions || !mesh->indices) return NSVCD_ERROR_ARGUMENT;
  if (mesh->vertex_count == 0 || mesh->triangle_count == 0) return NSVCD_ERROR_EMPTY;
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    for (size_t k = 0; k < 3; k++) {
      const size_t n = mesh->indices[3 * i + k];
      if (n >= mesh->vertex_count) return NSVCD_ERROR_INDEX;
      if (!nsvcd__in_range(mesh->positions + 3 * n, 3, NSVCD_MAX_COORDINATE))
        return NSVCD_ERROR_NUMBER;
      const nsvcd__f3 at = nsvcd__f3_row(mesh->positions, n);
      box->low = i + k ? nsvcd__f3_min(box->low, at) : at;
      box->high = i + k ? nsvcd__f3_max(box->high, at) : at;
    }
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_mesh_mass(const nsvcd_mesh *mesh, nsvcd_mass *mass) {
  nsvcd__moments m;
  nsvcd__box box = {{0, 0, 0}, {0, 0, 0}};
  if (!mass) return NSVCD_ERROR_ARGUMENT;
  memset(&m, 0, sizeof m);
  const nsvcd_result result = nsvcd__box_of_mesh(mesh, &box);
  if (result) return result;
  const nsvcd__d3 low = nsvcd__d3_widen(box.low);
  const nsvcd__d3 high = nsvcd__d3_widen(box.high);
  const nsvcd__d3 middle = nsvcd__d3_mix(low, high, 0.5);
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    nsvcd__d3 corners[3];
    for (size_t k = 0; k < 3; k++)
      corners[k] =
          nsvcd__d3_sub(nsvcd__d3_row(mesh->positions, mesh->indices[3 * i + k]), middle);
    nsvcd__moments_add(&m, corners[0], corners[1], corners[2]);
  }
  const nsvcd__d3 size = nsvcd__d3_sub(high, low);
  mass->is_of_box = !nsvcd__adds_up(&m, nsvcd__d3_norm(size));
  if (mass->is_of_box) {
    m.volume = size.x * size.y * size.z;
    m.first = nsvcd__d3_of(0, 0, 0);
    m.second = nsvcd__d3_of(size.x * size.x / 12, size.y * size.y / 12, size.z * size.z / 12);
  } else {
    m.first = nsvcd__d3_over(m.first, m.volume);
    m.second = nsvcd__d3_over(m.second, m.volume);
  }
  // of squares about the centre of mass
  const nsvcd__d3 c = m.first;
  const nsvcd__d3 s =
      nsvcd__d3_of(m.second.x - c.x * c.x, m.second.y - c.y * c.y, m.second.z - c.z * c.z);
  mass->volume = (float)m.volume;
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_add(middle, c)), mass->centre);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_of(s.y + s.z, s.z + s.x, s.x + s.y)),
                  mass->inertia);
  return NSVCD_OK;
}
