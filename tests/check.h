// Tiny test macros. A test is a `static void name(void)`; RUN(name) runs it unless the filter
// argument excludes it; main.c names the files. With CHECK_ENDS_EARLY defined, the first test that fails is the last.
#ifndef NSVCD_TESTS_CHECK_H
#define NSVCD_TESTS_CHECK_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

// What became of a test. CPU seconds, not the wall clock's: another load does not change them much.
typedef struct check_result {
  char name[64];
  int is_done;   // 0: it has begun
  int failures;  // checks that failed in it
  double seconds;
} check_result;

typedef struct check_state {
  int passed, failed;    // tests
  int failures_in_test;  // checks that failed in the test that is running
  const char *filter;    // run only tests whose name contains this, NULL: all
  // Of main.c, where several processes share the tests; NULL: this process runs all of them.
  int (*is_mine)(void);                      // shall this process run the next test?
  void (*report)(const check_result *said);  // of the test that begins, and that has ended
} check_state;

extern check_state check;

#ifdef CHECK_ENDS_EARLY
#define CHECK_ENDS 1
#else
#define CHECK_ENDS 0
#endif

// How many random trials a test makes: `few` of them find each mistake of tests/mutants.sh, within
// seconds. TEST_MANY=5 in the environment: five times as many, for mistakes that are rarer.
static inline size_t check_many(size_t few) {
  const char *many = getenv("TEST_MANY");
  return few * (many && atoi(many) > 1 ? (size_t)atoi(many) : 1);
}

static inline void check_print(const check_result *said) {
  printf("%-60s %s\n", said->name, said->failures ? "FAILED" : "ok");
  fflush(stdout);
}

static inline void check_run(const char *name, void (*test)(void)) {
  if (check.filter && !strstr(name, check.filter)) return;
  if (check.is_mine && !check.is_mine()) return;
  check_result said = {{0}, 0, 0, 0};
  snprintf(said.name, sizeof said.name, "%s", name);
  if (check.report) check.report(&said);
  const clock_t begin = clock();
  check.failures_in_test = 0;
  test();
  said.is_done = 1;
  said.failures = check.failures_in_test;
  said.seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
  said.failures ? (void)check.failed++ : (void)check.passed++;
  if (check.report) {
    fflush(stdout);
    check.report(&said);
  } else {
    check_print(&said);
  }
  if (CHECK_ENDS && said.failures) exit(1);
}
#define RUN(test) check_run(#test, test)

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
