// Codes, and what they say.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/ground/strings.h"

#include "check.h"

void test_results(void);

static void mesh_result_strings(void) {
  for (int i = 0; i <= NSVCD_ERROR_BUILD; ++i) {
    CHECK(strlen(nsvcd_result_string((nsvcd_result)i)) > 0);
    for (int j = 0; j < i; ++j) {
      CHECK(strcmp(nsvcd_result_string((nsvcd_result)i), nsvcd_result_string((nsvcd_result)j)) !=
            0);
    }
  }
  CHECK(strcmp(nsvcd_result_string((nsvcd_result)(NSVCD_ERROR_BUILD + 1)), "unknown result") == 0);
  // each at its place
  CHECK(strcmp(nsvcd_result_string(NSVCD_OK), "ok") == 0);
  CHECK(strcmp(nsvcd_result_string(NSVCD_ERROR_MEMORY), "out of memory") == 0);
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_POSE), "a pose") != NULL);
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_BODY), "the body is damaged") != NULL);
  CHECK(strcmp(nsvcd_result_string(NSVCD_ERROR_CANCELLED), "cancelled") == 0);
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_BUILD), "this build") != NULL);
}

// What answers say of themselves: each has a text of its own.
static void status_strings(void) {
  for (int i = 0; i <= NSVCD_HIT + 1; i++) {
    const char *text = nsvcd_verdict_string((nsvcd_verdict)i);
    for (int j = 0; j < i; j++) CHECK(strcmp(text, nsvcd_verdict_string((nsvcd_verdict)j)) != 0);
  }
  for (int i = 0; i <= NSVCD_PLAN_GOAL + 1; i++) {
    const char *text = nsvcd_plan_status_string((nsvcd_plan_status)i);
    for (int j = 0; j < i; j++)
      CHECK(strcmp(text, nsvcd_plan_status_string((nsvcd_plan_status)j)) != 0);
  }
  CHECK(strcmp(nsvcd_verdict_string(NSVCD_FREE), "free") == 0);
  CHECK(strcmp(nsvcd_plan_status_string(NSVCD_PLAN_GOAL), "infeasible goal") == 0);
}

// A person is told the limits themselves.
static void mesh_result_strings_name_limits(void) {
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_NUMBER), "a million metres") != NULL);
  CHECK_EQ(NSVCD_MAX_COORDINATE, 1e6f);
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_EMPTY), "1e-12 metres") != NULL);
  CHECK_EQ(NSVCD_MIN_RADIUS, 1e-12f);
}

void test_results(void) {
  RUN(mesh_result_strings);
  RUN(mesh_result_strings_name_limits);
  RUN(status_strings);
}

CHECK_ALONE(test_results)
