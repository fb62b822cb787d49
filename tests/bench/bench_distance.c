// bench_distance.c - the network's distance and its gradient, against the exact margins of problem
// files. Of problems whose margin is within one patch's radius: by how much opinion.distance is off.
// Of hits of a known depth: how many are freed, by proof, where the moving body goes up the gradient
// of the distance, or of the logit, in twelve steps, by 1.2 times the depth in all.
//
//   build/bench_distance FILE ...
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#define PROGRAM "bench_distance"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/load.h"

#define PATCHES 256
#define STEPS 12
#define FURTHER 1.2  // times the depth
#define SWELL 0.25f  // of the search for a gradient, as a plan has it
#define MOST_POSES 129

static void *workspace;
static size_t workspace_size;

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a;
  const double y = *(const double *)b;
  return (x > y) - (x < y);
}

static nsvcd_answer ask(nsvcd_question q, nsvcd_method method, float swell) {
  nsvcd_answer answer;
  q.method = method;
  q.network.swell = swell;
  const nsvcd_result result = nsvcd_sweep(&q, workspace, workspace_size, &answer);
  if (result) exit(complain(nsvcd_result_string(result)) + REFUSED);
  return answer;
}

// Is the motion of a free once it has gone up the gradient?
static int is_freed(nsvcd_question q, double depth, int of_logit) {
  nsvcd_pose poses[MOST_POSES];
  float gradient[6 * MOST_POSES];
  memcpy(poses, q.a.poses, q.a.count * sizeof *poses);
  q.a.poses = poses;
  for (int step = 0; step < STEPS; step++) {
    nsvcd_answer answer;
    double force[3] = {0, 0, 0};
    q.method = NSVCD_METHOD_NETWORK;
    q.network.swell = SWELL;
    q.network.of_logit = of_logit;
    if (nsvcd_sweep_gradient(&q, workspace, workspace_size, &answer, gradient, NULL)) return 0;
    for (size_t n = 0; n < 6 * q.a.count; n++)
      if (n % 6 < 3) force[n % 6] += (double)gradient[n] * (of_logit ? -1 : 1);
    const double length = sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    if (!(length > 0)) return 0;
    for (size_t n = 0; n < q.a.count; n++) {
      for (size_t k = 0; k < 3; k++)
        poses[n].position[k] += (float)(FURTHER * depth / STEPS * force[k] / length);
    }
    if (ask(q, NSVCD_METHOD_PROOF, 0).verdict == NSVCD_FREE) return 1;
  }
  return 0;
}

static void measure(const char *path) {
  problem_file file;
  if (!read_problems(path, &file)) exit(REFUSED);
  const nsvcd_body **bodies = (const nsvcd_body **)calloc(file.mesh_count, sizeof *bodies);
  nsvcd_body_facts facts[2];
  nsvcd_encode_options options;
  double taken = 0;
  memset(&options, 0, sizeof options);
  options.latents = 1;
  options.patches = PATCHES;
  double *off = (double *)calloc(file.problem_count + 1, sizeof *off);
  if (!bodies || !off) exit(complain("out of memory") + REFUSED);
  size_t near_by = 0, told = 0, deep = 0, freed[2] = {0, 0};
  for (size_t n = 0; n < file.problem_count; n++) {
    const problem *p = &file.problems[n];
    nsvcd_question q = question_of_problem(&file, p);
    const size_t names[2] = {p->moving, p->fixed};
    for (size_t b = 0; b < 2; b++) {
      const char *name = file.meshes[names[b]].path;
      if (!bodies[names[b]]) bodies[names[b]] = encode_named(path, path, name, &options, &taken);
      if (!bodies[names[b]]) exit(REFUSED);
      facts[b] = nsvcd_body_describe(bodies[names[b]]);
    }
    q.a.body = bodies[names[0]];
    q.b.body = bodies[names[1]];
    if (p->margin != p->margin || q.a.count > MOST_POSES || q.a.count == 0) continue;
    const double radius = 0.5 * ((double)facts[0].mean_patch_radius * (double)p->moving_scale +
                                 (double)facts[1].mean_patch_radius * (double)p->fixed_scale);
    if (fabs(p->margin) < radius) {
      const nsvcd_answer answer = ask(q, NSVCD_METHOD_NETWORK, 1);
      const double distance = (double)answer.opinion.distance;
      near_by++;
      if (distance < HUGE_VAL) off[told++] = fabs(distance - p->margin) / radius;
    }
    if (p->label != 1) continue;
    deep++;
    for (int of_logit = 0; of_logit < 2; of_logit++)
      freed[of_logit] += (size_t)is_freed(q, -p->margin, of_logit);
  }
  qsort(off, told, sizeof *off, compare);
  printf(
      "%s: within a radius %zu, of these told %zu, off by %.1f %% of it in the median, %.1f in "
      "nine of ten\n",
      path, near_by, told, told ? 100 * off[told / 2] : 0, told ? 100 * off[told * 9 / 10] : 0);
  printf(
      "  of %zu hits freed by %.1f times the depth: %.1f %% up the distance, %.1f %% down the "
      "logit\n",
      deep, FURTHER, 100 * (double)freed[0] / (double)deep, 100 * (double)freed[1] / (double)deep);
  for (size_t n = 0; n < file.mesh_count; n++) nsvcd_body_free(bodies[n], NULL);
  free((void *)bodies);
  free(off);
  free_problems(&file);
}

int main(int argc, char **argv) {
  workspace_size = nsvcd_sweep_workspace_size(NULL);
  workspace = malloc(workspace_size);
  if (!workspace || argc < 2) return complain("bench_distance FILE ...") + USAGE;
  for (int i = 1; i < argc; i++) measure(argv[i]);
  free(workspace);
  return 0;
}
