// SPDX-License-Identifier: MIT
// verify.c - checks a folder of certificates against a problem file. It shares no code with
// neuralsvcd.h. To be believed are nsvcd_verify.h and its files, and of what is read, which mesh,
// motion and pair it is, verify_files.h, verify_shapes.h, verify_plans.h and
// verify_pairs.h.
//
//   verify FILE.txt FOLDER [--clearance METRES] [--only ID,ID] [--claims]
//   verify --pairs FILE.txt FOLDER [--only A-B,A-B] [--claims]
//
// FILE.txt is a problem file or a planning file (examples/FORMATS.md); FOLDER holds a certificate
// ID.cert for each problem or plan, as `svcd check --certificates FOLDER` and `svcd plan
// --certificates FOLDER` write them. A line each, separated by tabs:
//   ID accepted|refused REASON BYTES MICROSECONDS
// REASON: what is proven (free, hit, near, inside), or why it is refused and at which byte.
// With --pairs A-B.cert of each two bodies of a robot that no line `pair` names, as `svcd pairs
// --certificates FOLDER` writes them: what is proven is that they never meet.
// MICROSECONDS: of one check; meshes are read, and their trees built, before. With --claims a sixth
// field: the claim that is proven (nsvcd_verify_claim.h), or the SHA-256 of several, one after the
// other. Exit status: 0 each proves what its line says, which may be a hit; 1 one is refused; 2 a
// file cannot be read, or usage.
#include <time.h>

#include "verify_pairs.h"

#define REPEAT 20  // checks, by a clock that may know no less than a microsecond

typedef struct named {
  char *name;
  const nsvcd_verify_mesh *mesh;
} named;

typedef struct side {
  nsvcd_verify_path path;
  nsvcd_verify_mover mover;
} side;

// The next line of a problem file, of so many words.
static char **expect(const char *path, char **text, char **words, size_t least) {
  if (next_words(text, words, MOST_WORDS) < least) fail(path, "a line has too few words");
  return words;
}

static void read_poses(const char *path, char **text, size_t count, float *poses) {
  char *words[MOST_WORDS];
  for (size_t k = 0; k < count; k++) read_pose(path, expect(path, text, words, 7), poses + 7 * k);
}

static const nsvcd_verify_mesh *mesh_named(const char *path, const list *meshes, const char *name) {
  const named *all = (const named *)meshes->items;
  for (size_t i = 0; i < meshes->count; i++)
    if (strcmp(all[i].name, name) == 0) return all[i].mesh;
  fail(path, "a problem names a mesh that is not above it");
  return NULL;
}

static size_t poses_of(const char *path, const char *word) {
  const size_t count = strtoul(word, NULL, 10);
  if (word[strspn(word, "0123456789")] || count < 1 || count > 65536)
    fail(path, "a COUNT is out of range");
  return count;
}

// Checks one certificate, and writes its line. 1: it is accepted.
static int check(request *asked, const char *id, const side *a, const side *b) {
  static const char *const kinds[] = {"", "free", "hit", "near", "inside"};
  char path[4096];
  nsvcd_verify_report report;
  size_t size;
  snprintf(path, sizeof path, "%s/%s.cert", asked->folder, id);
  uint8_t *bytes = (uint8_t *)read_file(path, &size);
  if (!bytes) return print_line(asked, id, "there is no certificate", NULL, 0, 0, 0), 0;
  const size_t room = NSVCD_VERIFY_WORKSPACE_BYTES(a->path.count + b->path.count + 2);
  void *workspace = allocate(room);
  int accepted = 0;
  const clock_t start = clock();
  for (int k = 0; k < REPEAT; k++)
    accepted =
        nsvcd_verify(&a->mover, &b->mover, asked->clearance, bytes, size, workspace, room, &report);
  const double taken = 1e6 * (double)(clock() - start) / (double)CLOCKS_PER_SEC / REPEAT;
  if (accepted) note_claim(asked, &a->mover, &b->mover, asked->clearance);
  print_line(asked, id, report.reason, kinds[report.kind], size, report.position, taken);
  free(workspace);
  free(bytes);
  return accepted;
}

// problem ID MOVING SCALE FIXED SCALE  x y z qx qy qz qw  LABEL MARGIN COUNT [FIXED_COUNT]
static int check_problem(const char *path, char **text, char **words, size_t count,
                         const list *meshes, request *asked) {
  side a, b;
  const size_t poses_a = poses_of(path, words[15]);
  const size_t poses_b = count > 16 ? poses_of(path, words[16]) : 0;
  float *poses = (float *)allocate(7 * (poses_a + poses_b + 1) * sizeof *poses);
  read_poses(path, text, poses_a + poses_b, poses);
  read_pose(path, words + 6, poses + 7 * (poses_a + poses_b));
  a.path.poses = poses;
  a.path.count = poses_a;
  b.path.poses = poses + 7 * poses_a;  // for one that rests, the line's own pose is behind
  b.path.count = poses_b > 0 ? poses_b : 1;
  a.path.times = b.path.times = NULL;
  const float scales[2] = {(float)number_of(path, words[3]), (float)number_of(path, words[5])};
  const char *why =
      nsvcd_verify_path_init(mesh_named(path, meshes, words[2]), scales[0], &a.path, &a.mover);
  if (!why)
    why = nsvcd_verify_path_init(mesh_named(path, meshes, words[4]), scales[1], &b.path, &b.mover);
  const int wanted = is_wanted(asked, words[1]);
  if (wanted && why) print_line(asked, words[1], why, NULL, 0, 0, 0);
  const int accepted = !wanted || (!why && check(asked, words[1], &a, &b));
  free(poses);
  return accepted;
}

static int check_problems(const char *path, char *text, request *asked) {
  list meshes = {NULL, 0, 0};
  char *words[MOST_WORDS];
  int all = 1;
  for (size_t n = next_words(&text, words, MOST_WORDS); n > 0;
       n = next_words(&text, words, MOST_WORDS)) {
    if (n == 3 && strcmp(words[0], "mesh") == 0) {
      for (size_t i = 0; i < meshes.count; i++) {
        if (strcmp(((const named *)meshes.items)[i].name, words[1]) == 0)
          fail(path, "a mesh has the name of another");
      }
      named *mesh = (named *)add(&meshes, sizeof *mesh);
      mesh->name = words[1];
      mesh->mesh = mesh_of_file(path, words[2], NULL);
    } else if (n >= 16 && strcmp(words[0], "problem") == 0) {
      all &= check_problem(path, &text, words, n, &meshes, asked);
    } else {
      fail(path, "a line is neither a mesh nor a problem");
    }
  }
  return all;
}

static int explain(void) {
  fprintf(stderr,
          "verify [--pairs] FILE.txt FOLDER [--clearance METRES] [--only ID,ID] [--claims]\n"
          "FILE.txt says what is proven: svcd sweep writes OUT.txt beside its certificate, "
          "OUT.cert; or "
          "it is the file that svcd check or svcd plan read.\n"
          "FOLDER holds the proofs, ID.cert: of OUT.txt the one where OUT.cert is, as in 'verify "
          "OUT.txt .'.\n");
  return 2;
}

int main(int argc, char **argv) {
  const int pairs = argc > 1 && strcmp(argv[1], "--pairs") == 0;
  argc -= pairs;
  argv += pairs;
  request asked;
  robot r;
  int known = argc > 2;
  memset(&asked, 0, sizeof asked);
  asked.folder = known ? argv[2] : NULL;
  asked.pairs = pairs;
  nsvcd_verify_sha_begin(&asked.claimed);
  for (int i = 3; i < argc && known; i++) {
    const int is_claims = strcmp(argv[i], "--claims") == 0;
    const int is_only = strcmp(argv[i], "--only") == 0;
    const int is_clearance = strcmp(argv[i], "--clearance") == 0;
    asked.claims |= is_claims;
    known = is_claims || ((is_only || is_clearance) && i + 1 < argc);
    if (known && is_only) asked.only = argv[++i];
    if (known && is_clearance) asked.clearance = (float)number_of("--clearance", argv[++i]);
  }
  if (!known) return explain();
  const char *path = argv[1];
  char *words[MOST_WORDS];
  size_t size;
  char *text = read_file(path, &size);
  if (!text) {
    fprintf(stderr, "verify: %s: %s\n", path, strerror(errno));
    return explain();
  }
  char *next = text;
  const int is_text =
      !memchr(text, 0, size) && strlen(text) == size && next_words(&next, words, MOST_WORDS) >= 2;
  const int is_plans = is_text && strcmp(words[0], "nsvcd-plans") == 0;
  if (!is_text || (!is_plans && (pairs || strcmp(words[0], "nsvcd-problems") != 0))) {
    fprintf(stderr, "verify: %s: its first line is not %s\n", path,
            pairs ? "nsvcd-plans 1" : "nsvcd-problems 1 or nsvcd-plans 1");
    return explain();
  }
  if (strcmp(words[1], "1") != 0) fail(path, "only version 1 is known");
  int all = 0;
  if (is_plans) all = check_plans(path, next, &asked, &r);
  if (!is_plans) all = check_problems(path, next, &asked);
  if (pairs) all = check_pairs(&r, &asked);
  if (asked.only && !asked.found) fail("--only", "the file has none of these");
  return all ? 0 : 1;
}
