// In: two bodies in 16 places. Out: nsvcd_look.
#pragma once
#include "../entry/processor.h"
#include "../body/trust.h"

#ifndef NSVCD_NO_PROOF
static nsvcd_result nsvcd__looked_check(const nsvcd_looked *looked) {
  const float scale = looked->scale;
  const nsvcd_result result = nsvcd__body_check(looked->body, SIZE_MAX);
  if (result) return result;
  if (!looked->places) return NSVCD_ERROR_ARGUMENT;
  if (!looked->body->triangles) return NSVCD_ERROR_TRIANGLES;
  const int fits = scale >= NSVCD_MIN_SCALE && scale <= NSVCD_MAX_SCALE;
  return fits || (scale <= 0 && scale >= 0) ? NSVCD_OK : NSVCD_ERROR_SCALE;
}

NSVCDDEF nsvcd_result nsvcd_look(const nsvcd_looked *a, const nsvcd_looked *b,
                                 const nsvcd_look_options *options, uint32_t *met) {
  if (!a || !b || !met) return NSVCD_ERROR_ARGUMENT;
  nsvcd_result result = nsvcd__looked_check(a);
  if (!result) result = nsvcd__looked_check(b);
  if (result) return result;
  const float margin = options ? options->margin : 0;
  if (!nsvcd__is_length(margin < 0 ? -margin : margin)) return NSVCD_ERROR_CLEARANCE;
  const nsvcd__isa isa = nsvcd__isa_at_hand();
  *met = NSVCD__KERNEL(isa, look_all)(a, b, margin, options ? options->any : 0);
  return NSVCD_OK;
}
#endif
