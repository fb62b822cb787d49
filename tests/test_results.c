// Codes, and what they say.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "check.h"

void test_results(void);

static void mesh_result_strings(void) {
  for (int i = 0; i <= NSVCD_ERROR_CANCELLED; ++i) {
    CHECK(strlen(nsvcd_result_string((nsvcd_result)i)) > 0);
    for (int j = 0; j < i; ++j) {
      CHECK(strcmp(nsvcd_result_string((nsvcd_result)i), nsvcd_result_string((nsvcd_result)j)) !=
            0);
    }
  }
  CHECK(strcmp(nsvcd_result_string((nsvcd_result)(NSVCD_ERROR_CANCELLED + 1)), "unknown result") ==
        0);
}

void test_results(void) {
  RUN(mesh_result_strings);
}

CHECK_ALONE(test_results)
