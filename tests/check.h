// Tiny test macros. A test is a `static void name(void)`; RUN(name) runs it unless the filter
// argument excludes it; main.c names the files. With CHECK_ENDS_EARLY defined, the first test that fails is the last.
#ifndef NSVCD_TESTS_CHECK_H
#define NSVCD_TESTS_CHECK_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct check_state {
  int passed, failed;    // tests
  int failures_in_test;  // checks that failed in the test that is running
  const char *filter;    // run only tests whose name contains this, NULL: all
} check_state;

extern check_state check;

#ifdef CHECK_ENDS_EARLY
#define CHECK_ENDS 1
#else
#define CHECK_ENDS 0
#endif

#define RUN(test)                                                          \
  do {                                                                     \
    if (check.filter && !strstr(#test, check.filter)) break;               \
    check.failures_in_test = 0;                                            \
    test();                                                                \
    check.failures_in_test ? (void)check.failed++ : (void)check.passed++;  \
    printf("%-60s %s\n", #test, check.failures_in_test ? "FAILED" : "ok"); \
    fflush(stdout);                                                        \
    if (CHECK_ENDS && check.failures_in_test) exit(1);                     \
  } while (0)

#define CHECK(condition)                                                   \
  do {                                                                     \
    if (!(condition)) {                                                    \
      printf("%s:%d: CHECK(%s) failed\n", __FILE__, __LINE__, #condition); \
      check.failures_in_test++;                                            \
    }                                                                      \
  } while (0)

// Compares two values through double, prints both on failure.
#define CHECK_OP(a, op, b)                                                                       \
  do {                                                                                           \
    double check_a = (double)(a), check_b = (double)(b);                                         \
    if (!(check_a op check_b)) {                                                                 \
      printf("%s:%d: %s (%.9g) " #op " %s (%.9g) failed\n", __FILE__, __LINE__, #a, check_a, #b, \
             check_b);                                                                           \
      check.failures_in_test++;                                                                  \
    }                                                                                            \
  } while (0)
#define CHECK_EQ(a, b) CHECK_OP(a, ==, b)
#define CHECK_LE(a, b) CHECK_OP(a, <=, b)
#define CHECK_GE(a, b) CHECK_OP(a, >=, b)
#define CHECK_NEAR(a, b, tolerance) CHECK_LE(fabs((double)(a) - (double)(b)), (tolerance))

// The closing line. Returns the exit status: 0, 1 if a test failed, 2 if none was run.
static inline int check_end(void) {
  printf("%d passed, %d failed\n", check.passed, check.failed);
  return check.failed > 0 ? 1 : check.passed == 0 ? 2 : 0;
}

// At the end of a test file: with TEST_ALONE defined, a main of its own.
#ifdef TEST_ALONE
#define CHECK_ALONE(tests)                    \
  check_state check;                          \
  int main(int argc, char **argv) {           \
    check.filter = argc > 1 ? argv[1] : NULL; \
    tests();                                  \
    return check_end();                       \
  }
#else
#define CHECK_ALONE(tests)
#endif

#endif
