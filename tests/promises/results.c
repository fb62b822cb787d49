// What src/interface/results.h promises, a test each: what is refused, and what answers say, has a
// text that a person understands.
#include "scene.h"

void promises_results(void);

static void every_code_has_a_text_of_its_own(void) {
  for (int i = 0; i <= NSVCD_ERROR_BUILD; i++) {
    const char *text = nsvcd_result_string((nsvcd_result)i);
    CHECK(text && strlen(text) > 0);
    for (int k = 0; k < i; k++) CHECK(strcmp(text, nsvcd_result_string((nsvcd_result)k)) != 0);
  }
  CHECK(nsvcd_result_string((nsvcd_result)9999) != NULL);
}

// By the name that the field has in the interface, or its kind in English.
static void a_text_names_the_field_at_fault(void) {
  static const struct {
    nsvcd_result result;
    const char *words[6];
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
      {NSVCD_ERROR_PIVOT, {"pivot", "certificate"}},
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
      {NSVCD_ERROR_AXIS, {"axis", "up is"}},
      {NSVCD_ERROR_LIMITS, {"low", "high"}},
      {NSVCD_ERROR_SPEED, {"speed", "acceleration"}},
      {NSVCD_ERROR_LINK, {"link"}},
      {NSVCD_ERROR_PAIR, {"pair"}},
      {NSVCD_ERROR_CONE, {"cone", "angle"}},
      {NSVCD_ERROR_VALUE, {"start", "goal", "points", "mass", "friction"}},
      {NSVCD_ERROR_DEGREE, {"degree", "pieces"}},
      {NSVCD_ERROR_TURN, {"turn"}},
      {NSVCD_ERROR_FINEST, {"finest"}},
      {NSVCD_ERROR_DISTANCE, {"max_distance", "max_depth", "step"}},
      {NSVCD_ERROR_FARTHEST, {"farthest"}},
      {NSVCD_ERROR_ROUTE, {"nodes", "shortcuts", "edge"}},
      {NSVCD_ERROR_HELD, {"held", "goal", "start"}},
      {NSVCD_ERROR_MIMIC, {"mimic", "multiplier", "offset"}},
      {NSVCD_ERROR_STAGE, {"explore", "refine"}},
      {NSVCD_ERROR_PLAN, {"duration", "margin", "seeds"}},
      {NSVCD_ERROR_BUILD, {"this build"}},
  };
  for (size_t n = 0; n < sizeof names / sizeof names[0]; n++) {
    const char *text = nsvcd_result_string(names[n].result);
    for (size_t k = 0; k < 6 && names[n].words[k]; k++) {
      if (!strstr(text, names[n].words[k])) printf("  '%s' in '%s'\n", names[n].words[k], text);
      CHECK(strstr(text, names[n].words[k]) != NULL);
    }
  }
}

static const char *text_of(int kind, int value) {
  return kind == 0   ? nsvcd_verdict_string((nsvcd_verdict)value)
         : kind == 1 ? nsvcd_plan_status_string((nsvcd_plan_status)value)
                     : nsvcd_route_status_string((nsvcd_route_status)value);
}
static void every_verdict_and_status_has_a_text_of_its_own(void) {
  static const int last[3] = {NSVCD_HIT, NSVCD_PLAN_GOAL, NSVCD_ROUTE_GOAL};
  for (int kind = 0; kind < 3; kind++) {
    for (int i = 0; i <= last[kind] + 1; i++) {  // one that there is not has one, too
      CHECK(strlen(text_of(kind, i)) > 2);
      for (int k = 0; k < i; k++) CHECK(strcmp(text_of(kind, i), text_of(kind, k)) != 0);
    }
  }
  CHECK(!strcmp(nsvcd_verdict_string(NSVCD_FREE), "free"));
  CHECK(!strcmp(nsvcd_plan_status_string(NSVCD_PLAN_GOAL), "infeasible goal"));
}

static void a_text_tells_the_limit(void) {
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_NUMBER), "a million metres") != NULL);
  CHECK_EQ(NSVCD_MAX_COORDINATE, 1e6f);
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_EMPTY), "1e-12 metres") != NULL);
  CHECK_EQ(NSVCD_MIN_RADIUS, 1e-12f);
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_DEGREE), "1 to 5") != NULL);
  CHECK_EQ(NSVCD_MAX_DEGREE, 5);
  CHECK_EQ(NSVCD_MAX_POSES, 65536);  // this and what follows is in the texts above
  CHECK_EQ(NSVCD_MAX_PAIRS, 256);
  CHECK_EQ(NSVCD_UNIT_TOLERANCE, 1e-4f);
}

void promises_results(void) {
  RUN(every_code_has_a_text_of_its_own);
  RUN(a_text_names_the_field_at_fault);
  RUN(every_verdict_and_status_has_a_text_of_its_own);
  RUN(a_text_tells_the_limit);
}

CHECK_ALONE(promises_results)
