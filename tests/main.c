// The test binary. An argument runs only the tests whose name contains it.
#include "check.h"

check_state check;

void test_mesh(void);
void test_surface(void);
void test_proof(void);
void test_network(void);
void test_broad_phase(void);
void test_oracle(void);
void test_query(void);
void test_level(void);
void test_gradient(void);
void test_cost(void);
void test_tasks(void);
void test_plan_spheres(void);
void test_plan(void);

int main(int argc, char **argv) {
  check.filter = argc > 1 ? argv[1] : NULL;
  test_mesh();
  test_surface();
  test_proof();
  test_network();
  test_broad_phase();
  test_oracle();
  test_cost();
  test_query();
  test_level();
  test_gradient();
  test_tasks();
  test_plan_spheres();
  test_plan();
  printf("%d passed, %d failed\n", check.passed, check.failed);
  return check.failed > 0;
}
