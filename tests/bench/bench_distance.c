// bench_distance.c - the network's distance and its gradient, beside those of points in a distance
// grid of as many bytes, against the exact margins of problem files.
//
// Of problems whose margin is within one patch's radius: by how much the distance is off, in per
// cent of that radius. Of hits of a known depth: how many are freed, by proof, where the moving body
// goes up the gradient of the distance in twelve steps, by 1.2 times the depth in all; of the
// network down that of the logit too. Microseconds are of one distance, and of one gradient.
//
// The grid has a byte a node (its distances are not rounded to that here), six bytes a point, half
// of the network body's bytes each; the points, in a tree, are looked up at every pose of the motion.
//
//   build/bench_distance FILE ...
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#include "grid.h"
#define PROGRAM "bench_distance"
#include "../../extras/neuralsvcd_certify.h"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/load.h"
#include "meter.h"

#define STEPS 12
#define FURTHER 1.2  // times the depth
#define SWELL 0.25f  // of the search for a gradient, as a plan has it
#define MOST_POSES 129

typedef struct judge {
  const char *name;
  size_t patches;
  nsvcd_model model;
  nsvcd_precision precision;
  int is_grid;
} judge;

static const judge judges[] = {
    {"network, N = 256", 256, NSVCD_MODEL_BASE, NSVCD_PRECISION_FLOAT, 0},
    {"grid, its bytes", 256, NSVCD_MODEL_BASE, NSVCD_PRECISION_FLOAT, 1},
    {"network, N = 64, tiny, int8", 64, NSVCD_MODEL_TINY, NSVCD_PRECISION_INT8, 0},
    {"grid, its bytes", 64, NSVCD_MODEL_TINY, NSVCD_PRECISION_INT8, 1},
};
#define JUDGES (sizeof judges / sizeof *judges)

// A mesh as the judges know it; `body` has triangles too, for the verdicts.
typedef struct known {
  const nsvcd_body *body;
  size_t bytes;   // of the latents alone
  double radius;  // of a patch, in the mean
  grid_body *grid;
} known;

static void *workspace;
static size_t workspace_size;

static void *must(const void *made) {
  if (!made) exit(complain("out of memory, or a mesh that cannot be used") + REFUSED);
  return (void *)(uintptr_t)made;
}

// ---- by the network

static nsvcd_question told(const judge *j, nsvcd_question q, int of_logit) {
  q.method = NSVCD_METHOD_NETWORK;
  q.ask = of_logit ? NSVCD_ASK_HIT : NSVCD_ASK_DISTANCE;
  q.network.model = j->model;
  q.network.precision = j->precision;
  return q;
}

static double network_distance(const judge *j, const nsvcd_question *q) {
  nsvcd_answer answer;
  const nsvcd_question asked = told(j, *q, 0);
  if (nsvcd_sweep(&asked, workspace, workspace_size, &answer)) return HUGE_VAL;
  return (double)answer.opinion.distance;
}

// Where to go, not of unit length. 0: it does not know.
static int network_force(const judge *j, const nsvcd_question *q, int of_logit, double *force) {
  float gradient[6 * MOST_POSES];
  nsvcd_answer answer;
  nsvcd_question asked = told(j, *q, of_logit);
  asked.network.inflate = SWELL;
  if (nsvcd_sweep_gradient(&asked, workspace, workspace_size, &answer, gradient, NULL)) return 0;
  for (size_t n = 0; n < 6 * q->a.count; n++)
    if (n % 6 < 3) force[n % 6] += (double)gradient[n] * (of_logit ? -1 : 1);
  return 1;
}

// ---- by the grid

static float grid_at(const grid_body *g, const float *cells) {
  grid_lanes at;
  memset(&at, 0, sizeof at);
  for (int i = 0; i < 3; i++) {
    const float most = (float)(g->size[i] - 1);
    at.x[i][0] = fminf(fmaxf(cells[i], 0), most);
    at.beyond[0] += (cells[i] - at.x[i][0]) * (cells[i] - at.x[i][0]);
  }
  return grid_interpolate(g, &at, 0);
}

// The least distance of all points at all poses, and, unless it is NULL, where to go from there.
static double grid_distance(const known *moving, const known *fixed, const nsvcd_question *question,
                            double *force) {
  const grid_body *g = fixed->grid;
  const nsvcd_mover *a = &question->a;
  const nsvcd_mover *b = &question->b;
  const float ratio = a->scale / b->scale;
  float best[3] = {0, 0, 0};
  grid_query q;
  q.moving = moving->grid;
  q.fixed = g;
  q.activation = FLT_MAX;
  for (size_t n = 0; n < a->count; n++) {
    const nsvcd_pose seen = nsvcd__relative_pose(&a->poses[n], &b->poses[0]);
    const nsvcd__mat3 turn = nsvcd__mat3_of(nsvcd__quat_load(seen.rotation));
    transform at;
    nsvcd__f3_store(nsvcd__f3_scale(turn.x, ratio), at.rotation);
    nsvcd__f3_store(nsvcd__f3_scale(turn.y, ratio), at.rotation + 3);
    nsvcd__f3_store(nsvcd__f3_scale(turn.z, ratio), at.rotation + 6);
    for (int k = 0; k < 3; k++) at.position[k] = seen.position[k] / b->scale;
    q.inverse = 1 / g->cell;
    grid_place(&q, &at);
    q.inverse *= ratio;  // of the moving body's radii
    (void)grid_search(&q, best);
  }
  if (force) {
    float slope[3];
    for (int c = 0; c < 3; c++) {
      float to[3], from[3];
      memcpy(to, best, sizeof to);
      memcpy(from, best, sizeof from);
      to[c] += 0.5f;
      from[c] -= 0.5f;
      slope[c] = grid_at(g, to) - grid_at(g, from);
    }
    const nsvcd__mat3 axes = nsvcd__mat3_of(nsvcd__quat_load(b->poses[0].rotation));
    const nsvcd__f3 way = nsvcd__mat3_apply(&axes, nsvcd__f3_load(slope));
    force[0] = (double)way.x;
    force[1] = (double)way.y;
    force[2] = (double)way.z;
  }
  return (double)(q.activation * g->cell * b->scale);  // in metres
}

// The grid and the points that so many bytes hold: as many cells as do, and as many points.
static grid_body *grid_of_bytes(const nsvcd_mesh *mesh, size_t bytes) {
  preparation how = {2, bytes / 2 / 6};
  grid_body *out = NULL;
  for (float cells = 4; cells < 100; cells++) {
    how.detail = cells;
    grid_body *made = (grid_body *)must(grid_prepare(mesh, &how));
    if (out && grid_total(made) > bytes / 2) {
      grid_release(made);
      break;
    }
    grid_release(out);
    out = made;
  }
  return out;
}

// ---- all of it

// Is the motion of a free once it has gone where the judge says?
static int is_freed(const judge *j, const known *moving, const known *fixed, nsvcd_question q,
                    double depth, int of_logit, double *taken) {
  nsvcd_pose poses[MOST_POSES];
  memcpy(poses, q.a.poses, q.a.count * sizeof *poses);
  q.a.poses = poses;
  for (int step = 0; step < STEPS; step++) {
    nsvcd_answer answer;
    double force[3] = {0, 0, 0};
    const double start = seconds();
    if (j->is_grid)
      (void)grid_distance(moving, fixed, &q, force);
    else if (!network_force(j, &q, of_logit, force))
      return 0;
    if (step == 0) *taken += seconds() - start;
    const double length = sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    if (!(length > 0)) return 0;
    for (size_t n = 0; n < q.a.count; n++) {
      for (size_t k = 0; k < 3; k++)
        poses[n].position[k] += (float)(FURTHER * depth / STEPS * force[k] / length);
    }
    nsvcd_question proof = q;
    proof.method = NSVCD_METHOD_PROOF;
    if (nsvcd_sweep(&proof, workspace, workspace_size, &answer)) return 0;
    if (answer.verdict == NSVCD_FREE) return 1;
  }
  return 0;
}

static known know(const judge *j, const char *path, const char *name) {
  known out;
  char at[4096];
  nsvcd_mesh mesh;
  nsvcd_encode_options options;
  double taken;
  memset(&options, 0, sizeof options);
  options.latents = 1;
  options.patches = j->patches;
  out.grid = NULL;
  path_of(path, name, at, sizeof at);
  if (!load_mesh(path, at, &mesh)) exit(REFUSED);
  out.body = (const nsvcd_body *)must(encode_mesh(path, at, &mesh, &options, &taken));
  const nsvcd_body_facts facts = nsvcd_body_describe(out.body);
  out.radius = (double)facts.mean_patch_radius;
  out.bytes = nsvcd_body_size(facts.patches);
  if (j->is_grid) out.grid = grid_of_bytes(&mesh, out.bytes);
  nsvcd_mesh_free(&mesh, NULL);
  return out;
}

static void measure(const judge *j, const char *path) {
  problem_file file;
  if (!read_problems(path, &file)) exit(REFUSED);
  known *all = (known *)must(calloc(file.mesh_count, sizeof *all));
  double *off = (double *)must(calloc(file.problem_count + 1, sizeof *off));
  size_t near_by = 0, count = 0, deep = 0, freed[2] = {0, 0};
  double taken[3] = {0, 0, 0};
  for (size_t n = 0; n < file.problem_count; n++) {
    const problem *p = &file.problems[n];
    const size_t names[2] = {p->moving, p->fixed};
    nsvcd_question q = question_of_problem(&file, p);
    for (size_t b = 0; b < 2; b++) {
      known *one = &all[names[b]];
      if (!one->body) *one = know(j, path, file.meshes[names[b]].path);
    }
    const known *moving = &all[p->moving];
    const known *fixed = &all[p->fixed];
    q.a.body = moving->body;
    q.b.body = fixed->body;
    if (p->margin != p->margin || q.a.count > MOST_POSES || q.a.count == 0 || p->fixed_count)
      continue;
    const double radius =
        0.5 * (moving->radius * (double)p->moving_scale + fixed->radius * (double)p->fixed_scale);
    if (fabs(p->margin) < radius) {
      const double start = seconds();
      const double distance =
          j->is_grid ? grid_distance(moving, fixed, &q, NULL) : network_distance(j, &q);
      taken[0] += seconds() - start;
      near_by++;
      if (distance < HUGE_VAL) off[count++] = fabs(distance - p->margin) / radius;
    }
    if (p->label != 1) continue;
    deep++;
    for (int of_logit = 0; of_logit < (j->is_grid ? 1 : 2); of_logit++)
      freed[of_logit] +=
          (size_t)is_freed(j, moving, fixed, q, -p->margin, of_logit, &taken[1 + of_logit]);
  }
  meter_sort(off, count);
  size_t bytes = 0;
  size_t known_count = 0;
  for (size_t n = 0; n < file.mesh_count; n++) {
    bytes += all[n].bytes;
    known_count += all[n].body != NULL;
    nsvcd_body_free(all[n].body, NULL);
    grid_release(all[n].grid);
  }
  printf("  %-28s %5.1f KB  told %zu of %zu, off by %4.1f %% in the median, %5.1f in nine of ten",
         j->name, (double)bytes / (double)known_count / 1024, count, near_by,
         count ? 100 * off[count / 2] : 0, count ? 100 * off[count * 9 / 10] : 0);
  printf("; of %zu hits freed %4.1f %%", deep, 100 * (double)freed[0] / (double)deep);
  if (!j->is_grid) printf(", down the logit %4.1f", 100 * (double)freed[1] / (double)deep);
  printf("; %.1f and %.1f us\n", 1e6 * taken[0] / (double)near_by, 1e6 * taken[1] / (double)deep);
  fflush(stdout);
  free(all);
  free(off);
  free_problems(&file);
}

int main(int argc, char **argv) {
  workspace_size = nsvcd_sweep_workspace_size(NULL);
  workspace = malloc(workspace_size);
  if (!workspace || argc < 2) return complain("bench_distance FILE ...") + USAGE;
  for (int i = 1; i < argc; i++) {
    printf("%s\n", argv[i]);
    for (size_t j = 0; j < JUDGES; j++) measure(&judges[j], argv[i]);
  }
  free(workspace);
  return 0;
}
