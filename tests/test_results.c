// Codes, and what they say.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/ground/strings.h"
#include "../src/interface/robots.h"

#include "check.h"

void test_results(void);

// What is refused is told by the name that the field has in the interface, or its kind in English.
static void result_strings_name_the_field(void) {
  static const struct {
    nsvcd_result result;
    const char *words[3];
  } names[] = {
      {NSVCD_OK, {"ok"}},
      {NSVCD_ERROR_ARGUMENT, {"NULL", "body"}},
      {NSVCD_ERROR_MEMORY, {"out of memory"}},
      {NSVCD_ERROR_CANCELLED, {"cancelled"}},
      {NSVCD_ERROR_WORKSPACE, {"memory", "NULL", "misaligned"}},
      {NSVCD_ERROR_COUNT, {"joint_count", "part_count", "goal_count"}},
      {NSVCD_ERROR_FORMAT, {"format", "cut short"}},
      {NSVCD_ERROR_SIZES, {"sizes", "corner_count"}},
      {NSVCD_ERROR_BOX, {"low", "high"}},
      {NSVCD_ERROR_PATCHES, {"patches", "patch_radius"}},
      {NSVCD_ERROR_RADIUS, {"radius", "convex_radius", "half"}},
      {NSVCD_ERROR_BODY, {"not a body", "first bytes", "damaged"}},
      {NSVCD_ERROR_VERSION, {"version", "model", "byte order"}},
      {NSVCD_ERROR_TRIANGLES, {"triangles", "proof"}},
      {NSVCD_ERROR_LATENTS, {"latents", "network"}},
      {NSVCD_ERROR_POSES, {"poses", "count", "65536"}},
      {NSVCD_ERROR_TIMES, {"times"}},
      {NSVCD_ERROR_POSE, {"position", "pose"}},
      {NSVCD_ERROR_QUATERNION, {"quaternion", "1e-4"}},
      {NSVCD_ERROR_SCALE, {"scale"}},
      {NSVCD_ERROR_ASK, {"ask"}},
      {NSVCD_ERROR_METHOD, {"method", "network", "gradient"}},
      {NSVCD_ERROR_TO, {"to is", "HIT"}},
      {NSVCD_ERROR_TO_TIME, {"to_time"}},
      {NSVCD_ERROR_CLEARANCE, {"clearance"}},
      {NSVCD_ERROR_SLOP, {"slop"}},
      {NSVCD_ERROR_TOLERANCE, {"tolerance"}},
      {NSVCD_ERROR_MANIFOLD, {"manifold", "FIRST"}},
      {NSVCD_ERROR_SEGMENTS, {"segments", "16", "64"}},
      {NSVCD_ERROR_PAIRS, {"network.pairs", "256"}},
      {NSVCD_ERROR_MODEL, {"network.model"}},
      {NSVCD_ERROR_PRECISION, {"network.precision"}},
      {NSVCD_ERROR_RECALL, {"network.recall"}},
      {NSVCD_ERROR_INFLATE, {"network.inflate"}},
      {NSVCD_ERROR_JOINT, {"kind", "parent"}},
      {NSVCD_ERROR_AXIS, {"axis"}},
      {NSVCD_ERROR_LIMITS, {"low", "high"}},
      {NSVCD_ERROR_SPEED, {"speed", "acceleration"}},
      {NSVCD_ERROR_LINK, {"link"}},
      {NSVCD_ERROR_PAIR, {"pair"}},
      {NSVCD_ERROR_VALUE, {"start", "goal", "points"}},
      {NSVCD_ERROR_DEGREE, {"degree", "pieces"}},
      {NSVCD_ERROR_TURN, {"turn"}},
      {NSVCD_ERROR_FINEST, {"finest"}},
      {NSVCD_ERROR_DISTANCE, {"max_distance", "max_depth"}},
      {NSVCD_ERROR_FARTHEST, {"farthest"}},
      {NSVCD_ERROR_ROUTE, {"nodes", "shortcuts", "edge"}},
      {NSVCD_ERROR_STAGE, {"explore", "refine"}},
      {NSVCD_ERROR_PLAN, {"duration", "margin", "seeds"}},
      {NSVCD_ERROR_BUILD, {"this build"}},
  };
  for (size_t n = 0; n < sizeof names / sizeof names[0]; n++) {
    const char *text = nsvcd_result_string(names[n].result);
    for (size_t k = 0; k < 3 && names[n].words[k]; k++) {
      if (!strstr(text, names[n].words[k])) printf("  '%s' in '%s'\n", names[n].words[k], text);
      CHECK(strstr(text, names[n].words[k]) != NULL);
    }
  }
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
  CHECK_EQ(NSVCD_MAX_POSES, 65536);
  CHECK_EQ(NSVCD_MAX_PATCHES, 65536);
  CHECK_EQ(NSVCD_MAX_PAIRS, 256);
  CHECK_EQ(NSVCD_UNIT_TOLERANCE, 1e-4f);
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_DEGREE), "1 to 5") != NULL);
  CHECK_EQ(NSVCD_MAX_DEGREE, 5);
}

void test_results(void) {
  RUN(mesh_result_strings_name_limits);
  RUN(result_strings_name_the_field);
  RUN(status_strings);
}

CHECK_ALONE(test_results)
