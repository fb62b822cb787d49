// In: a code or a verdict. Out: what it says, in English.
#pragma once
#include "../interface/plans.h"
#include "compiler.h"

// Number n of texts that follow each other, in the order of enumerators; the last where there is
// none. No table of pointers: a loader would write into that.
static const char *nsvcd__text_of(const char *texts, size_t n) {
  for (; n > 0 && texts[strlen(texts) + 1]; n--) texts += strlen(texts) + 1;
  return texts;
}

NSVCDDEF const char *nsvcd_result_string(nsvcd_result result) {
  return nsvcd__text_of(
      "ok\0"
      "an argument is NULL or out of its range\0"
      "the file is missing or cannot be read\0"
      "out of memory\0"
      "a line cannot be understood, or a face has fewer than three corners\0"
      "an index is zero or refers to no vertex\0"
      "a coordinate is not finite, or beyond a million metres\0"
      "there is no triangle, or no area, or the mesh is smaller than 1e-12 metres\0"
      "more vertices, triangles or bytes than can be counted\0"
      "a pose is not finite, or its quaternion is not of unit length\0"
      "a scale is not finite, negative or out of range, or makes a body too small or too "
      "large\0"
      "a tolerance or a clearance is negative, not finite or beyond the scene\0"
      "both sides are the same body in the same motion\0"
      "the body is damaged, cut short, misaligned, of another version, model or byte "
      "order, or lacks what the method needs\0"
      "the memory given is too small or misaligned\0"
      "cancelled\0"
      "this build reckons wrongly: see the compiler, and its flags\0"
      "unknown result\0",
      (size_t)result);
}

NSVCDDEF const char *nsvcd_verdict_string(nsvcd_verdict verdict) {
  return nsvcd__text_of(
      "undecided\0"
      "free\0"
      "hit\0"
      "unknown verdict\0",
      (size_t)verdict);
}

#ifndef NSVCD_NO_OPTIMIZER
NSVCDDEF const char *nsvcd_plan_status_string(nsvcd_plan_status status) {
  return nsvcd__text_of(
      "converged\0"
      "limit\0"
      "cancelled\0"
      "infeasible start\0"
      "infeasible goal\0"
      "unknown status\0",
      (size_t)status);
}
#endif
