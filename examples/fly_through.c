// fly_through.c - a level as one body: 20 m of hills, walls, arches and boulders, 200,000
// triangles, and a drone of 0.3 m that flies through it at 60 Hz. Every frame it looks a third of a
// second ahead: is that way free, with some room to spare? If not, it tries others, and takes the
// first that is proven free. Prints what that costs; draws build/fly_through.svg.
//
//   build/fly_through [TRIANGLES]
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define PROGRAM "fly_through"
#include "scenery/problem_file.h"

#include "scenery/draw.h"
#include "scenery/level.h"
#include "scenery/poses.h"

#define SIDE 20.0         // metres
#define SEED 1            // seed of the level
#define FRAMES 1800       // half a minute
#define STEP (1.0f / 60)  // seconds
#define SPEED 3.0f        // metres a second
#define AHEAD 1.0f        // metres that must be free
#define ROOM 0.03f        // metres by which it keeps off everything
#define WAYS 17           // directions to try: straight on, then ever farther off
#define GHOSTS 60         // frames between those drawn

static const float corners[4][3] = {{-8, 8, 0.9f}, {8, 8, 1.2f}, {-8, -8, 0.9f}, {8, -8, 1.2f}};

typedef struct flight {
  nsvcd_pose at;
  size_t corner;  // the corner that it is going to
  nsvcd_pose path[FRAMES];
  size_t frames, questions, turned, stuck;
  double microseconds, worst;
} flight;

static void to_mesh(const shapes_mesh *shape, nsvcd_mesh *mesh) {
  mesh->vertex_count = shape->vertices;
  mesh->triangle_count = shape->triangles;
  mesh->indices = shape->indices;
  mesh->positions = (float *)allocate(3 * shape->vertices * sizeof(float));
  for (size_t i = 0; i < 3 * shape->vertices; i++) mesh->positions[i] = (float)shape->positions[i];
}

// Makes the drone: four rings about a box.
static void make_drone(shapes_mesh *mesh) {
  shapes_box(mesh, 0.12, 0.12, 0.05, 3);
  for (int k = 0; k < 4; k++) {
    double ring[17][3];
    for (int i = 0; i < 16; i++) {
      const double angle = 2 * SHAPES_PI * i / 16;
      ring[i][0] = 0.1 * (k % 2 ? 1 : -1) + 0.045 * cos(angle);
      ring[i][1] = 0.1 * (k / 2 ? 1 : -1) + 0.045 * sin(angle);
      ring[i][2] = 0;
    }
    shapes_tube(mesh, (const double(*)[3])ring, 16, 0.008, 8, 1);
  }
}

// The pose after a way of `metres` along a direction, turned towards it about the vertical, by no
// more than a little.
static nsvcd_pose pose_after(const nsvcd_pose *from, const float *direction, float metres) {
  nsvcd_pose to = *from;
  for (int k = 0; k < 3; k++) to.position[k] += metres * direction[k];
  const float half = 0.05f * metres;
  const float z = from->rotation[2];
  const float w = from->rotation[3];
  to.rotation[2] = z * cosf(half) + w * sinf(half);
  to.rotation[3] = w * cosf(half) - z * sinf(half);
  const float length = sqrtf(to.rotation[2] * to.rotation[2] + to.rotation[3] * to.rotation[3]);
  to.rotation[2] /= length;
  to.rotation[3] /= length;
  return to;
}

// The n-th way to try: to the sides and upwards or down, by ever more.
static void turned_way(const float *towards, int n, float *out) {
  const float off = 0.35f * (float)((n + 3) / 4);
  const float side = n == 0 ? 0 : n % 4 == 1 ? off : n % 4 == 2 ? -off : 0;
  const float rise = n == 0 ? 0 : n % 4 == 3 ? off : n % 4 == 0 ? -off : 0;
  const float flat = sqrtf(towards[0] * towards[0] + towards[1] * towards[1]);
  const float across[2] = {flat > 0 ? -towards[1] / flat : 1, flat > 0 ? towards[0] / flat : 0};
  out[0] = cosf(off) * towards[0] + sinf(side) * across[0];
  out[1] = cosf(off) * towards[1] + sinf(side) * across[1];
  out[2] = cosf(off) * towards[2] + sinf(rise);
  const float length = sqrtf(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
  for (int k = 0; k < 3; k++) out[k] /= length;
}

// Flies one frame. 0 if a question was refused.
static int fly(flight *f, const nsvcd_body *drone, const nsvcd_body *level, void *workspace,
               size_t size) {
  float towards[3];
  float length = 0;
  for (int k = 0; k < 3; k++) towards[k] = corners[f->corner][k] - f->at.position[k];
  for (int k = 0; k < 3; k++) length += towards[k] * towards[k];
  length = sqrtf(length);
  if (length < 1) f->corner = (f->corner + 1) % 4;
  for (int k = 0; k < 3; k++) towards[k] /= length > 0 ? length : 1;
  for (int n = 0; n < WAYS; n++) {
    float way[3];
    turned_way(towards, n, way);
    const nsvcd_pose ahead[2] = {f->at, pose_after(&f->at, way, AHEAD)};
    nsvcd_question question;
    nsvcd_answer answer;
    memset(&question, 0, sizeof question);
    question.a.body = drone;
    question.a.poses = ahead;
    question.a.count = 2;
    question.b.body = level;
    question.clearance = ROOM;
    const double start = seconds();
    if (nsvcd_sweep(&question, workspace, size, &answer)) return 0;
    const double took = 1e6 * (seconds() - start);
    f->questions++;
    f->microseconds += took;
    f->worst = fmax(f->worst, took);
    if (answer.verdict != NSVCD_FREE) continue;
    f->turned += n > 0;
    f->at = pose_after(&f->at, way, SPEED * STEP);
    f->path[f->frames++] = f->at;
    return 1;
  }
  f->stuck++;
  f->path[f->frames++] = f->at;
  return 1;
}

// How near to the level the flight came, all of it, by the exact oracle: metres; negative without
// memory.
static double oracle_says(const flight *f, const shapes_mesh *drone, const shapes_mesh *level) {
  oracle_mesh moving, fixed;
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  const oracle_options options = {1e-3, 0, 0, 1};
  oracle_pose *poses = (oracle_pose *)allocate(f->frames * sizeof *poses);
  for (size_t n = 0; n < f->frames; n++) {
    poses[n] = pose_widened(&f->path[n]);
  }
  if (!oracle_mesh_init(&moving, drone->positions, drone->vertices, drone->indices,
                        drone->triangles, 1))
    return -1;
  if (!oracle_mesh_init(&fixed, level->positions, level->vertices, level->indices, level->triangles,
                        1))
    return -1;
  const oracle_result result = oracle_sweep(&moving, poses, f->frames, &fixed, &origin, &options);
  oracle_mesh_free(&moving);
  oracle_mesh_free(&fixed);
  free(poses);
  return result.status == ORACLE_NO_MEMORY ? -1 : result.distance;
}

// The level is drawn with fewer triangles: the same things in the same places.
static int draw(const flight *f, const shapes_mesh *drone) {
  const draw_view view = {-0.9, 0.75, {0, 0, 0.3}, 33, 860, 620};
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  shapes_mesh ground, things;
  FILE *svg = draw_open("build/fly_through.svg", 900, 740, "A level as one body",
                        "200,000 triangles; what lies ahead is proven free, frame by frame");
  if (!svg) return 0;
  memset(&ground, 0, sizeof ground);
  memset(&things, 0, sizeof things);
  level_ground(&ground, SIDE, 40);
  level_things(&things, SIDE, 10000, SEED);
  draw_panel(svg, 20, 84, &view);
  draw_list list = {&view, NULL, 0, 0, 0};
  draw_shape(&list, &ground, 1, &origin, &draw_cream);
  draw_flush(svg, &list);
  draw_shape(&list, &things, 1, &origin, &draw_steel);
  for (size_t n = 0; n < f->frames; n += GHOSTS) {
    const oracle_pose pose = pose_widened(&f->path[n]);
    draw_shape(&list, drone, 1, &pose, &draw_orange);
  }
  draw_flush(svg, &list);
  fprintf(svg, "<path fill=\"none\" stroke=\"#1454a0\" stroke-width=\"2\" d=\"");
  for (size_t n = 0; n < f->frames; n++) {
    const oracle_pose pose = pose_widened(&f->path[n]);
    draw_to(svg, &view, n == 0, pose.position);
  }
  fprintf(svg, "\"/>\n");
  draw_panel_end(svg, &view, "half a minute of flight");
  shapes_free(&ground);
  shapes_free(&things);
  return draw_close(svg);
}

int main(int argc, char **argv) {
  size_t triangles = 200000;
  if (argc > 2 || (argc == 2 && !parse_count(argv[1], 1000, 4000000, &triangles))) {
    return complain("usage: fly_through [TRIANGLES]"), USAGE;
  }
  static flight f;
  shapes_mesh level_shape, drone_shape;
  nsvcd_mesh level_mesh, drone_mesh;
  nsvcd_encode_options options;
  const nsvcd_body *level, *drone;
  memset(&level_shape, 0, sizeof level_shape);
  memset(&drone_shape, 0, sizeof drone_shape);
  memset(&options, 0, sizeof options);
  level_make(&level_shape, SIDE, triangles, SEED);
  make_drone(&drone_shape);
  if (level_shape.failed || drone_shape.failed) return complain("no memory"), REFUSED;
  to_mesh(&level_shape, &level_mesh);
  to_mesh(&drone_shape, &drone_mesh);

  options.patch_radius = 0.15f;  // half the drone
  const double start = seconds();
  if (nsvcd_encode(&level_mesh, &options, NULL, NULL, 0, &level))
    return complain("the level was refused"), REFUSED;
  const double took = seconds() - start;
  if (nsvcd_encode(&drone_mesh, NULL, NULL, NULL, 0, &drone))
    return complain("the drone was refused"), REFUSED;
  const nsvcd_body_facts facts = nsvcd_body_describe(level);
  printf("a level of %zu triangles: %zu patches, %.1f MB, encoded in %.1f s\n", facts.triangles,
         facts.patches, 1e-6 * (double)facts.size, took);

  const size_t size = nsvcd_sweep_workspace_size(NULL);
  void *workspace = allocate(size);
  const nsvcd_pose first = {{8, -8, 0.9f}, {0, 0, 0, 1}};
  f.at = first;
  while (f.frames < FRAMES) {
    if (!fly(&f, drone, level, workspace, size)) return complain("a question was refused"), REFUSED;
  }
  printf(
      "%zu frames, %zu questions: %.1f us each, at most %.0f us; in %zu frames it turned aside, in "
      "%zu it waited\n",
      f.frames, f.questions, f.microseconds / (double)f.questions, f.worst, f.turned, f.stuck);
  const double distance = oracle_says(&f, &drone_shape, &level_shape);
  const int kept = distance > (double)ROOM - 1e-4;
  printf("the oracle: never nearer than %.1f mm%s\n", 1e3 * distance,
         kept ? "" : ", which is too near");
  if (!draw(&f, &drone_shape)) return complain("build/fly_through.svg cannot be written"), REFUSED;
  printf("see build/fly_through.svg\n");
  free(workspace);
  nsvcd_body_free(level, NULL);
  nsvcd_body_free(drone, NULL);
  free(level_mesh.positions);
  free(drone_mesh.positions);
  shapes_free(&level_shape);
  shapes_free(&drone_shape);
  return kept ? DONE : REFUSED;
}
