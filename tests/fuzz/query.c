// Any question about ten bodies: refused with a code, or answered as nsvcd_answer says, the same
// again in memory that held other bytes, and the same verdict with a and b exchanged.
#define FUZZ_TARGET "query"
#define FUZZ_TOKENS
#include "main.h"

#include "scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz_input in = {data, size};
  scene_question asked;
  nsvcd_answer answer;
  const size_t a = fuzz_choice(&in, SCENE_BODIES);
  const size_t b = fuzz_choice(&in, SCENE_BODIES);
  scene_ask_about(&in, scene_body(a), scene_body(b), &asked);
  fuzz_taken += (unsigned)scene_ask(&asked.question, &answer);
  return 0;
}
