// question_of.h - a question about one body that moves and one that rests, as most tests and
// benchmarks have it. After the library, or the rooms of it.
#ifndef NSVCD_TESTS_QUESTION_OF_H
#define NSVCD_TESTS_QUESTION_OF_H

#include <string.h>

// fixed_pose: NULL for the origin; asked: what, its bodies left out; NULL for the defaults.
static inline nsvcd_question question_of(const nsvcd_body *moving, const nsvcd_pose *poses,
                                         size_t count, const nsvcd_body *fixed,
                                         const nsvcd_pose *fixed_pose,
                                         const nsvcd_question *asked) {
  nsvcd_question question;
  memset(&question, 0, sizeof question);
  if (asked) question = *asked;
  question.a.body = moving;
  question.a.poses = poses;
  question.a.count = count;
  question.b.body = fixed;
  question.b.poses = fixed_pose;
  question.b.count = fixed_pose ? 1 : 0;
  return question;
}

#endif  // NSVCD_TESTS_QUESTION_OF_H
