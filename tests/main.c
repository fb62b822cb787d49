// The test binary. `build/tests`: all tests, on all processors, and at the end which took longest;
// `build/tests decoder`: those of test_decoder.c; `build/tests PART`: those whose name, or whose
// file's name, contains it, in one process, for a debugger. TEST_JOBS=1: all tests in one process.
#define _DEFAULT_SOURCE 1  // of POSIX: fork, pipe, sysconf
#include "check.h"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/wait.h>
#include <unistd.h>
#define HAVE_PROCESSES 1
#else
#define HAVE_PROCESSES 0
#endif

check_state check;

void test_round(void);
void test_exact(void);
void test_floor(void);
void test_robot(void);
void test_many_joints(void);
void test_reach(void);
void test_allowances(void);
void test_mimics(void);
void test_merge(void);
void test_cones(void);
void test_route_looks(void);
void test_postures(void);
void test_ranges(void);
void test_certificate(void);
void test_checker(void);
void test_claims(void);
void test_math(void);
void test_vectors(void);
void test_memory(void);
void test_mesh(void);
void test_mesh_files(void);
void test_patches(void);
void test_regions(void);
void test_surface(void);
void test_weights(void);
void test_encoder(void);
void test_latent_rotation(void);
void test_body(void);
void test_facets(void);
void test_motion(void);
void test_long(void);
void test_broad_phase(void);
void test_looks(void);
void test_contacts(void);
void test_shapes(void);
void test_world(void);
void test_slide(void);
void test_step(void);
void test_proof(void);
void test_fits(void);
void test_asks(void);
void test_normals(void);
void test_solids(void);
void test_winding_number(void);
void test_decoder(void);
void test_query(void);
void test_gradient(void);
void test_spline(void);
void test_optimizer(void);
void test_level(void);
void test_cost(void);

void promises_reaches(void);
void promises_ranges(void);
void promises_results(void);
void promises_meshes(void);
void promises_bodies(void);
void promises_looks(void);
void promises_queries(void);
void promises_certificates(void);
void promises_robots(void);
void promises_postures(void);
void promises_routes(void);
void promises_plans(void);
void promises_worlds(void);

typedef struct test_file {
  const char *name;
  void (*run)(void);
} test_file;

#define OF(name) \
  { #name, test_##name }
#define PROMISES_OF(name) \
  { "promises_" #name, promises_##name }
static const test_file files[] = {
    // the public contracts, one after another
    PROMISES_OF(reaches),
    PROMISES_OF(ranges),
    PROMISES_OF(results),
    PROMISES_OF(meshes),
    PROMISES_OF(bodies),
    PROMISES_OF(looks),
    PROMISES_OF(queries),
    PROMISES_OF(certificates),
    PROMISES_OF(robots),
    PROMISES_OF(postures),
    PROMISES_OF(routes),
    PROMISES_OF(plans),
    PROMISES_OF(worlds),
    // the sections of the header, in its order
    OF(math),
    OF(vectors),
    OF(memory),
    OF(mesh),
    OF(mesh_files),
    OF(patches),
    OF(regions),
    OF(surface),
    OF(weights),
    OF(encoder),
    OF(latent_rotation),
    OF(body),
    OF(facets),
    OF(motion),
    OF(broad_phase),
    OF(looks),
    OF(contacts),
    OF(shapes),
    OF(world),
    OF(slide),
    OF(step),
    OF(proof),
    OF(fits),
    OF(asks),
    OF(long),
    OF(normals),
    OF(solids),
    OF(round),
    OF(exact),
    OF(floor),
    OF(robot),
    OF(many_joints),
    OF(reach),
    OF(allowances),
    OF(mimics),
    OF(merge),
    OF(cones),
    OF(route_looks),
    OF(postures),
    OF(ranges),
    OF(certificate),
    OF(checker),
    OF(claims),
    OF(winding_number),
    OF(decoder),
    OF(query),
    OF(gradient),
    OF(spline),
    OF(optimizer),
    // what crosses them
    OF(level),
    OF(cost),
};
enum { FILES = sizeof files / sizeof *files };

enum { MOST_TESTS = 4096, SLOWEST = 10 };
static struct {
  check_result said[MOST_TESTS];
  size_t count;
} results;

static void hear(const check_result *said) {
  size_t k = 0;
  while (k < results.count && strcmp(results.said[k].name, said->name)) k++;
  if (k == MOST_TESTS) return;
  results.said[k] = *said;
  results.count += k == results.count;
  if (said->is_done) check_print(said);
}

static void run_files(const test_file *only) {
  const char *filter = check.filter;
  for (int f = 0; f < FILES; f++) {
    if (only && only != &files[f]) continue;
    check.filter = !only && filter && !strstr(files[f].name, filter) ? filter : NULL;
    files[f].run();
  }
  check.filter = filter;
}

#if HAVE_PROCESSES
// Every process goes through all tests in the same order. Which of them are its own is decided by
// numbers, of which it takes the next from a pipe whenever it has done the last.
static struct {
  int numbers, reports;  // ends of pipes
  int index, mine;
} worker;

static void take_number(void) {
  if (read(worker.numbers, &worker.mine, sizeof worker.mine) != sizeof worker.mine) _exit(0);
}

static int is_mine(void) {
  return worker.index++ == worker.mine;
}

// At most PIPE_BUF bytes: written in one piece.
static void report(const check_result *said) {
  if (write(worker.reports, said, sizeof *said) != sizeof *said) _exit(3);
  if (said->is_done) take_number();
}

static void work(const test_file *only) {
  check.is_mine = is_mine;
  check.report = report;
  setvbuf(stdout, NULL, _IOLBF, 1 << 12);  // what it has said stays when it crashes
  take_number();
  run_files(only);
  fflush(stdout);
  _exit(0);
}

// All tests in `jobs` processes. A test that has begun but did not end has failed: its process has.
static int run_in_processes(int jobs) {
  int numbers[2], reports[2];
  if (pipe(numbers) || pipe(reports)) return 0;
  for (int j = 0; j < jobs; j++) {
    const pid_t pid = fork();
    if (pid < 0 && j == 0) return 0;
    if (pid != 0) continue;
    close(numbers[1]);
    close(reports[0]);
    worker.numbers = numbers[0];
    worker.reports = reports[1];
    work(NULL);
  }
  close(numbers[0]);
  close(reports[1]);
  for (int n = 0; n < MOST_TESTS; n++) {
    if (write(numbers[1], &n, sizeof n) != sizeof n) return 0;
  }
  close(numbers[1]);
  check_result said;
  while (read(reports[0], &said, sizeof said) == sizeof said) hear(&said);
  while (wait(NULL) > 0) {
  }
  for (size_t k = 0; k < results.count; k++) {
    const check_result *test = &results.said[k];
    if (!test->is_done) printf("%s: its process ended\n", test->name);
    test->is_done && !test->failures ? (void)check.passed++ : (void)check.failed++;
  }
  return 1;
}

static int job_count(void) {
  const char *asked = getenv("TEST_JOBS");
  const long jobs = asked ? atol(asked) : sysconf(_SC_NPROCESSORS_ONLN);
  return jobs < 1 ? 1 : jobs > 64 ? 64 : (int)jobs;
}
#endif

static int by_seconds(const void *a, const void *b) {
  const double x = ((const check_result *)a)->seconds;
  const double y = ((const check_result *)b)->seconds;
  return (x < y) - (x > y);
}

static void print_slowest(void) {
  double all = 0;
  qsort(results.said, results.count, sizeof *results.said, by_seconds);
  for (size_t k = 0; k < results.count; k++) all += results.said[k].seconds;
  printf("%.1f CPU seconds. The slowest:", all);
  for (size_t k = 0; k < results.count && k < SLOWEST; k++) {
    printf("%s %s %.1f", k ? "," : "", results.said[k].name, results.said[k].seconds);
  }
  printf("\n");
}

int main(int argc, char **argv) {
  check.filter = argc > 1 ? argv[1] : NULL;
#if HAVE_PROCESSES
  if (!check.filter && job_count() > 1 && run_in_processes(job_count())) {
    print_slowest();
    return check_end();
  }
#endif
  check.report = hear;
  const test_file *only = NULL;
  for (int f = 0; f < FILES && check.filter; f++) {
    if (!strcmp(check.filter, files[f].name)) only = &files[f];
  }
  run_files(only);
  print_slowest();
  if (check.passed + check.failed == 0) {
    fprintf(stderr, "'%s' is in no test's name, nor in that of a file:", check.filter);
    for (int f = 0; f < FILES; f++) fprintf(stderr, " %s", files[f].name);
    fprintf(stderr, "\n");
  }
  return check_end();
}
