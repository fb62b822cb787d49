// ask.h - asks such a question. After the library, or the rooms of it.
#ifndef NSVCD_TESTS_ASK_H
#define NSVCD_TESTS_ASK_H

#include "question_of.h"

static inline nsvcd_result ask(const nsvcd_body *moving, const nsvcd_pose *poses, size_t count,
                               const nsvcd_body *fixed, const nsvcd_pose *fixed_pose,
                               const nsvcd_question *asked, void *workspace, size_t workspace_size,
                               nsvcd_answer *answer) {
  const nsvcd_question question = question_of(moving, poses, count, fixed, fixed_pose, asked);
  return nsvcd_sweep(&question, workspace, workspace_size, answer);
}

#endif  // NSVCD_TESTS_ASK_H
