// The test binary. `build/tests`: all tests; `build/tests decoder`: those of test_decoder.c;
// `build/tests PART`: those whose name, or whose file's name, contains it.
#include "check.h"

check_state check;

void test_results(void);
void test_round(void);
void test_robot(void);
void test_postures(void);
void test_certificate(void);
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
void test_encoding(void);
void test_motion(void);
void test_broad_phase(void);
void test_proof(void);
void test_asks(void);
void test_winding_number(void);
void test_decoder(void);
void test_query(void);
void test_gradient(void);
void test_processor(void);
void test_spline(void);
void test_optimizer(void);
void test_level(void);
void test_cost(void);
void test_oracle(void);
void test_tasks(void);
void test_plan_spheres(void);

typedef struct test_file {
  const char *name;
  void (*run)(void);
} test_file;

#define OF(name) \
  { #name, test_##name }
static const test_file files[] = {
    // the sections of the header, in its order
    OF(results),
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
    OF(encoding),
    OF(motion),
    OF(broad_phase),
    OF(proof),
    OF(asks),
    OF(round),
    OF(robot),
    OF(postures),
    OF(certificate),
    OF(winding_number),
    OF(decoder),
    OF(query),
    OF(gradient),
    OF(processor),
    OF(spline),
    OF(optimizer),
    // what crosses them
    OF(level),
    OF(cost),
    // what judges the library, and what is measured against it
    OF(oracle),
    OF(tasks),
    OF(plan_spheres),
};
enum { FILES = sizeof files / sizeof *files };

int main(int argc, char **argv) {
  const char *filter = argc > 1 ? argv[1] : NULL;
  const test_file *only = NULL;
  for (int f = 0; f < FILES && filter; f++) {
    if (!strcmp(filter, files[f].name)) only = &files[f];
  }
  for (int f = 0; f < FILES; f++) {
    if (only && only != &files[f]) continue;
    check.filter = filter && !strstr(files[f].name, filter) ? filter : NULL;
    files[f].run();
  }
  if (check.passed + check.failed == 0) {
    fprintf(stderr, "'%s' is in no test's name, nor in that of a file:", filter);
    for (int f = 0; f < FILES; f++) fprintf(stderr, " %s", files[f].name);
    fprintf(stderr, "\n");
  }
  return check_end();
}
