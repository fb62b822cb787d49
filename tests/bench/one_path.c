// one_path.c - is what NSVCD_ONE_PATH says so? Encodes meshes, asks the proof all kinds of
// questions about them, and prints a number over the bits of what it has so far: the same in any
// build with that switch. With --time what each kind of question takes, in microseconds.
// tests/one_path.sh compares builds.
//
//   build/one_path [--time] A.obj B.obj ...
#define _POSIX_C_SOURCE 200112L
#define NSVCD_NO_NETWORK
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"

#include <inttypes.h>
#include <time.h>

enum { MESHES = 16, ROUND = 2, POSES = 3, QUESTIONS = 200 };
enum { PLAIN, FIRST, DISTANCE, SKIN, TIMES, KINDS };
static const char *const names[KINDS] = {"plain", "first", "distance", "skin", "times"};

// FNV-1a, of words, so that the order of bytes does not matter.
static void mix(uint64_t *sum, const void *words, size_t count) {
  for (size_t k = 0; k < count; k++) {
    uint32_t word;
    memcpy(&word, (const char *)words + 4 * k, 4);
    *sum = (*sum ^ word) * 1099511628211u;
  }
}

static uint32_t next(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return *seed >> 8;
}
// -1 to 1, exactly.
static float any(uint32_t *seed) {
  return (float)next(seed) / 8388608.0f - 1;
}

// Volatile: what this program computes may not be fused either.
static nsvcd_pose any_pose(uint32_t *seed, float reach) {
  nsvcd_pose pose;
  volatile float square = 0;
  for (int k = 0; k < 3; k++) pose.position[k] = reach * any(seed);
  for (int k = 0; k < 4; k++) {
    pose.rotation[k] = any(seed);
    volatile float one = pose.rotation[k] * pose.rotation[k];
    square = square + one;
  }
  const float length = sqrtf(square);
  for (int k = 0; k < 4; k++)
    pose.rotation[k] = length > 0.1f ? pose.rotation[k] / length : (float)(k == 3);
  return pose;
}

static void mix_answer(uint64_t *sum, const nsvcd_answer *a) {
  const uint32_t words[6] = {(uint32_t)a->verdict, (uint32_t)a->by,   (uint32_t)a->why,
                             (uint32_t)a->inside,  (uint32_t)a->work, (uint32_t)a->contact_count};
  mix(sum, words, 6);
  mix(sum, &a->time, 2);
  mix(sum, &a->distance, 2);
  mix(sum, &a->safe, sizeof a->safe / 4);
  mix(sum, &a->depth, 1);
  mix(sum, a->push_out, 3);
  mix(sum, a->contacts, a->contact_count * (sizeof a->contacts[0] / 4));
  mix(sum, &a->nearest, sizeof a->nearest / 4);
}

static nsvcd_question ask(int kind, const nsvcd_body *const *bodies, size_t count, uint32_t *seed,
                          nsvcd_pose *poses, float *times) {
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  const size_t a = next(seed) % count;
  const size_t b = (a + 1 + next(seed) % (count - 1)) % count;
  const float reach = nsvcd_body_describe(bodies[a]).radius + nsvcd_body_describe(bodies[b]).radius;
  for (size_t k = 0; k < 2 * POSES; k++) {
    poses[k] = any_pose(seed, 0.7f * reach);
    // small turns, and large ones
    if (k % POSES && next(seed) % 3) memcpy(poses[k].rotation, poses[k - 1].rotation, 16);
  }
  times[0] = 0;
  times[1] = 0.5f + 0.25f * any(seed);
  times[2] = 1;
  q.a.body = bodies[a];
  q.b.body = bodies[b];
  q.a.poses = poses;
  q.b.poses = poses + POSES;
  q.a.count = POSES;
  q.b.count = next(seed) % 3 ? 1 : POSES;
  if (kind == FIRST || kind == SKIN || kind == TIMES) q.ask = NSVCD_ASK_FIRST;
  if (kind == DISTANCE) q.ask = NSVCD_ASK_DISTANCE;
  if (kind == TIMES) q.a.times = times;
  q.manifold = kind == SKIN;
  if (kind == SKIN) q.slop = q.clearance = 0.01f * reach;
  q.to = q.ask == NSVCD_ASK_HIT ? 0 : 0.001f * reach;
  return q;
}

static int load(const char *path, const nsvcd_body **body, uint64_t *sum) {
  nsvcd_mesh mesh;
  nsvcd_result result = nsvcd_obj_load(path, NULL, &mesh, NULL);
  if (!result) result = nsvcd_encode(&mesh, NULL, NULL, NULL, 0, body);
  if (result) return fprintf(stderr, "%s: %s\n", path, nsvcd_result_string(result)), 0;
  mix(sum, *body, nsvcd_body_describe(*body).size / 4);
  nsvcd_mesh_free(&mesh, NULL);
  return 1;
}

// The header's own sines and angles, against libm's.
static int angles_are_right(void) {
  int right = 1;
#ifdef NSVCD_ONE_PATH
  for (int n = 0; n <= 1000; n++) {
    const double angle = 1.5707963267948966 * n / 1000;
    const double length = 1 + n % 7;
    right &= fabs(nsvcd__sin(angle) - sin(angle)) < 1e-15;
    right &= fabs(nsvcd__atan2(length * sin(angle), length * cos(angle)) - angle) < 1e-15;
    right &= fabsf(nsvcd__asinf((float)sin(0.9 * angle)) - asinf((float)sin(0.9 * angle))) < 3e-7f;
  }
#endif
  return right;
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(int argc, char **argv) {
  const nsvcd_body *bodies[MESHES + ROUND];
  const int timed = argc > 1 && strcmp(argv[1], "--time") == 0;
  const float ends[2][3] = {{0, 0, -0.1f}, {0.02f, 0, 0.1f}};
  void *workspace = malloc(nsvcd_sweep_workspace_size(NULL));
  uint64_t sum = 14695981039346656037u;
  size_t meshes = 0;
  const nsvcd_result sound = angles_are_right() ? nsvcd_self_test() : NSVCD_ERROR_BUILD;
  if (sound) return fprintf(stderr, "%s\n", nsvcd_result_string(sound)), 1;
  for (int k = 1 + timed; k < argc && meshes < MESHES; k++)
    if (!load(argv[k], &bodies[meshes++], &sum)) return 1;
  if (meshes < 2 || nsvcd_encode_capsule(ends[0], ends[1], 0.05f, NULL, &bodies[meshes]) ||
      nsvcd_encode_sphere(0.1f, NULL, &bodies[meshes + 1]))
    return 1;
  if (!timed) printf("bodies %016" PRIx64 "\n", sum);
  for (int kind = 0; kind < KINDS; kind++) {
    uint32_t seed = 7;
    size_t verdicts[3] = {0, 0, 0};
    const double start = seconds();
    for (int n = 0; n < QUESTIONS; n++) {
      nsvcd_pose poses[2 * POSES];
      float times[POSES];
      nsvcd_answer answer;
      const nsvcd_question q = ask(kind, bodies, meshes + ROUND, &seed, poses, times);
      if (nsvcd_sweep(&q, workspace, nsvcd_sweep_workspace_size(NULL), &answer)) return 1;
      verdicts[answer.verdict]++;
      mix_answer(&sum, &answer);
    }
    if (timed)
      printf("%s %.2f\n", names[kind], 1e6 * (seconds() - start) / QUESTIONS);
    else
      printf("%s %016" PRIx64 " undecided %zu, free %zu, hit %zu\n", names[kind], sum, verdicts[0],
             verdicts[1], verdicts[2]);
  }
  for (size_t k = 0; k < meshes + ROUND; k++) nsvcd_body_free(bodies[k], NULL);
  free(workspace);
  return 0;
}
