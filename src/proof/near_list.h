// In: nothing. Out: a list of triangle pairs that are near each other.
#pragma once
#include "../ground/points.h"

#ifndef NSVCD_NO_PROOF
// Two triangles that come within the clearance, of bodies at rest, in the fixed body's frame.
typedef struct nsvcd__near_pair {
  float distance;
  nsvcd__f3 normal;  // unit: out of the fixed body
  uint32_t moving_entry, fixed_entry;
  // the caller's
  uint32_t moving_triangle, fixed_triangle;
  uint16_t moving_patch, fixed_patch;
  // 1: it has its side, or is none
  uint32_t is_resolved;
} nsvcd__near_pair;

// A list of these, in the caller's memory; is_full: there were more.
typedef struct nsvcd__near_list {
  nsvcd__near_pair *items;
  uint32_t count, room, is_full;
} nsvcd__near_list;
#endif  // NSVCD_NO_PROOF
