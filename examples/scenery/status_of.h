// status_of.h - an answer in a word, as tables of answers have it. After the library, or its rooms.
#ifndef NSVCD_SCENERY_STATUS_OF_H
#define NSVCD_SCENERY_STATUS_OF_H

typedef enum status {
  STATUS_OK = 0,
  STATUS_CERTIFIED_FREE,
  STATUS_INSIDE,
  STATUS_LIMIT,
  STATUS_WITNESS,
  STATUS_UNDECIDED
} status;

static inline status status_of(const nsvcd_answer *a) {
  if (a->verdict == NSVCD_UNDECIDED) return STATUS_UNDECIDED;
  if (a->inside) return STATUS_INSIDE;
  if (a->by == NSVCD_BY_NETWORK) return a->opinion.limited ? STATUS_LIMIT : STATUS_OK;
  return a->verdict == NSVCD_FREE ? STATUS_CERTIFIED_FREE : STATUS_WITNESS;
}

static inline const char *status_string(status s) {
  static const char *const words[] = {"ok",    "certified-free", "inside",
                                      "limit", "witness",        "undecided"};
  return words[s];
}

// The logit of a collision: the network's if it was asked.
static inline float logit_of(const nsvcd_answer *a) {
  if (a->opinion.asked) return a->opinion.logit;
  return a->verdict == NSVCD_FREE ? -NSVCD_LOGIT_CERTAIN : NSVCD_LOGIT_CERTAIN;
}
static inline int collides_of(const nsvcd_answer *a) {
  return logit_of(a) > 0;
}

// Are the patches that an answer names those of triangles? Else they are the network's pair.
static inline int names_triangles(const nsvcd_answer *a) {
  return a->nearest.triangle_a != NSVCD_NO_TRIANGLE || !a->opinion.asked;
}
static inline float contact_time_of(const nsvcd_answer *a) {
  return names_triangles(a) ? a->nearest.time : a->opinion.time;
}
static inline void patches_of(const nsvcd_answer *a, uint32_t *patch_a, uint32_t *patch_b) {
  *patch_a = names_triangles(a) ? a->nearest.patch_a : a->opinion.patch_a;
  *patch_b = names_triangles(a) ? a->nearest.patch_b : a->opinion.patch_b;
}

#endif  // NSVCD_SCENERY_STATUS_OF_H
