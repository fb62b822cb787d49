// In: a scene. Out: which joints drive others, and configurations in which these follow.
//
// A joint that mimics has a value in each configuration, as all joints have, so all that is proven
// of a motion is proven of it as well. A line or a curve keeps the relation between its control
// points. Where values are drawn, clamped or turned, those that mimic are computed anew.
#pragma once
#include "chain.h"

// of 1 and the numbers that its leader makes it of: by how much a joint's value may be another
#define NSVCD__MIMIC_ERROR 1e-9
// the least multiplier
#define NSVCD__LEAST_MULTIPLIER 1e-6

// The joint that drives one: its leader, or itself.
static size_t nsvcd__driver(const nsvcd_scene *scene, size_t joint) {
  const uint32_t mimic = scene->joints[joint].mimic;
  return mimic ? mimic - 1 : joint;
}

// How far a joint goes as its driver goes by 1.
static double nsvcd__rate(const nsvcd_scene *scene, size_t joint) {
  return scene->joints[joint].mimic ? scene->joints[joint].multiplier : 1;
}

// The value that a joint's driver gives it in a configuration.
static double nsvcd__driven(const nsvcd_scene *scene, size_t joint, const double *at) {
  const nsvcd_joint *j = &scene->joints[joint];
  return j->mimic ? j->multiplier * at[j->mimic - 1] + j->offset : at[joint];
}

// Does a joint drive others?
static int nsvcd__leads(const nsvcd_scene *scene, size_t joint) {
  for (size_t k = 0; k < scene->joint_count; k++)
    if (scene->joints[k].mimic == joint + 1) return 1;
  return 0;
}

// Puts the joints that mimic where their leaders have them, in so many configurations.
static void nsvcd__follow(const nsvcd_scene *scene, size_t count, double *rows) {
  for (double *at = rows; count > 0; count--, at += scene->joint_count)
    for (size_t j = 0; j < scene->joint_count; j++) at[j] = nsvcd__driven(scene, j, at);
}

// Are they there, but for rounding?
static int nsvcd__follows(const nsvcd_scene *scene, size_t count, const double *rows) {
  for (const double *at = rows; count > 0; count--, at += scene->joint_count) {
    for (size_t j = 0; j < scene->joint_count; j++) {
      if (!scene->joints[j].mimic) continue;
      const double value = nsvcd__driven(scene, j, at);
      const double offset = scene->joints[j].offset;
      const double most = 1 + fabs(offset) + fabs(value - offset);
      if (!(fabs(at[j] - value) <= NSVCD__MIMIC_ERROR * most)) return 0;
    }
  }
  return 1;
}

static double nsvcd__speed_of(const nsvcd_joint *joint) {
  return joint->speed > 0 ? joint->speed : 1;
}
static double nsvcd__acceleration_of(const nsvcd_joint *joint) {
  return joint->acceleration > 0 ? joint->acceleration : 1;
}

// A joint of a scene, with limits that those which mimic it keep theirs in.
static nsvcd_joint nsvcd__narrowed(const nsvcd_scene *scene, size_t joint) {
  nsvcd_joint out = scene->joints[joint];
  for (size_t k = 0; k < scene->joint_count; k++) {
    const nsvcd_joint *other = &scene->joints[k];
    if (other->mimic != joint + 1) continue;
    const double rate = fabs(other->multiplier);
    out.speed = nsvcd__min(nsvcd__speed_of(&out), nsvcd__speed_of(other) / rate);
    out.acceleration =
        nsvcd__min(nsvcd__acceleration_of(&out), nsvcd__acceleration_of(other) / rate);
    if (other->kind == NSVCD_JOINT_CONTINUOUS) continue;
    const double a = (other->low - other->offset) / other->multiplier;
    const double b = (other->high - other->offset) / other->multiplier;
    const int is_endless = out.kind == NSVCD_JOINT_CONTINUOUS;
    out.low = is_endless ? nsvcd__min(a, b) : nsvcd__max(out.low, nsvcd__min(a, b));
    out.high = is_endless ? nsvcd__max(a, b) : nsvcd__min(out.high, nsvcd__max(a, b));
    if (is_endless) out.kind = NSVCD_JOINT_REVOLUTE;
  }
  return out;
}
