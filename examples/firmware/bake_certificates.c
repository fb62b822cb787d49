// bake_certificates.c - certifies on the host what questions.h asks of two meshes, and writes
// meshes, poses and certificates as C arrays for verify.c.
//
//   bake_certificates OUT.h MUG.obj RACK.obj
//
// What cannot be certified is left out. Exit status: 0 done, 1 a file was refused, 2 usage.
#include <stdio.h>

#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../../neuralsvcd.h"
#include "../../extras/neuralsvcd_certify.h"
#include "../../extras/neuralsvcd_robot.h"

#include "questions.h"

#define SCENES (QUESTIONS + 4)
#define ROOM 65536  // bytes for all certificates

typedef struct baker {
  nsvcd_mesh meshes[2];
  const nsvcd_tree *trees[2];
  uint8_t bytes[ROOM];
  nsvcd_pose poses[SCENES * 2 * POSES];
  size_t byte_count, pose_count, largest;
} baker;

static nsvcd_result load(const char *path, nsvcd_mesh *mesh, const nsvcd_tree **tree) {
  const nsvcd_result result = nsvcd_obj_load(path, NULL, mesh, NULL);
  if (result) return result;
  const size_t size = nsvcd_tree_size(mesh);
  return nsvcd_tree_build(mesh, malloc(size), size, tree);
}

// The 32 ways, and what they do not show.
static void pose_scene(uint32_t number, nsvcd_pose *poses, nsvcd_pose *b_poses,
                       nsvcd_question *question) {
  b_poses[0] = upright(0, 0, 0);
  question->a.scale = question->b.scale = 1;
  question->b.poses = b_poses;
  question->b.count = 1;
  switch (number) {
    case QUESTIONS:      // along the front of the rack, 1.5 mm off: a clearance that is kept
    case QUESTIONS + 1:  // and one that is not
      pose_question(24, poses, b_poses, question);
      question->clearance = number == QUESTIONS ? 0.001f : 0.002f;
      break;
    case QUESTIONS + 2:  // a mug of 2 mm rests within a bar
      pose_question(4, poses, b_poses, question);
      question->a.count = 1;
      break;
    case QUESTIONS + 3:  // one of 3 cm rests between the bars
      poses[0] = upright(-0.15f, -0.1f, 0.01f);
      question->a.scale = 0.3f;
      question->a.poses = poses;
      question->a.count = 1;
      break;
    default:
      pose_question(number, poses, b_poses, question);
  }
}

// Certifies one question, and writes it as verify.c has a scene.
static nsvcd_result certify(FILE *file, baker *b, uint32_t number) {
  nsvcd_question q = {0};
  nsvcd_certificate made;
  nsvcd_pose b_poses[B_POSES];
  nsvcd_pose *poses = b->poses + b->pose_count;
  const size_t room = ROOM - b->byte_count;
  pose_scene(number, poses, b_poses, &q);
  memcpy(poses + q.a.count, b_poses, q.b.count * sizeof *b_poses);
  const size_t size = nsvcd_certify_workspace_size(&q, b->trees[0], b->trees[1]);
  void *workspace = malloc(size);
  const nsvcd_result result = nsvcd_certify(&q, b->trees[0], b->trees[1], NULL, workspace, size,
                                            b->bytes + b->byte_count, room, &made);
  free(workspace);
  if (result || made.verdict == NSVCD_UNDECIDED) return result;
  if (made.size > room) return NSVCD_ERROR_TOO_LARGE;
  fprintf(file, "    {%u, %d, %.8ef, %.8ef, %u, %u, %u, %u, %u},\n", (unsigned)number,
          made.verdict == NSVCD_FREE, (double)q.a.scale, (double)q.clearance,
          (unsigned)b->pose_count, (unsigned)q.a.count, (unsigned)q.b.count,
          (unsigned)b->byte_count, (unsigned)made.size);
  b->byte_count += made.size;
  b->pose_count += q.a.count + q.b.count;
  if (made.size > b->largest) b->largest = made.size;
  return NSVCD_OK;
}

static void write_floats(FILE *file, const char *name, const float *values, size_t count) {
  fprintf(file, "static const float %s_body[%u] = {", name, (unsigned)count);
  for (size_t i = 0; i < count; i++)
    fprintf(file, "%s%.8ef,", i % 5 ? " " : "\n    ", (double)values[i]);
  fprintf(file, "\n};\n");
}

static void write_mesh(FILE *file, const char *name, const nsvcd_mesh *mesh) {
  char positions[64];
  snprintf(positions, sizeof positions, "%s_positions", name);
  write_floats(file, positions, mesh->positions, 3 * mesh->vertex_count);
  fprintf(file, "static const uint32_t %s_indices_body[%u] = {", name,
          (unsigned)(3 * mesh->triangle_count));
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
    fprintf(file, "%s%u,", i % 15 ? " " : "\n    ", (unsigned)mesh->indices[i]);
  fprintf(file, "\n};\n");
}

static nsvcd_result bake(FILE *file, baker *b) {
  fprintf(file, "// Written by bake_certificates.c.\n");
  write_mesh(file, "mug", &b->meshes[0]);
  write_mesh(file, "rack", &b->meshes[1]);
  fprintf(file, "static const scene scenes_body[] = {\n");
  nsvcd_result result = NSVCD_OK;
  for (uint32_t i = 0; i < SCENES && !result; i++) result = certify(file, b, i);
  fprintf(file, "};\n");
  write_floats(file, "poses", b->poses->position, 7 * b->pose_count);
  fprintf(file, "static const uint8_t certificates_body[%u] = {", (unsigned)b->byte_count);
  for (size_t i = 0; i < b->byte_count; i++)
    fprintf(file, "%s%u,", i % 18 ? " " : "\n    ", (unsigned)b->bytes[i]);
  fprintf(file, "\n};\n#define POSES %d\n#define LARGEST %u\n", POSES, (unsigned)b->largest);
  return result;
}

int main(int argc, char **argv) {
  static baker b;
  if (argc != 4) {
    fprintf(stderr, "bake_certificates OUT.h MUG.obj RACK.obj\n");
    return 2;
  }
  nsvcd_result result = load(argv[2], &b.meshes[0], &b.trees[0]);
  if (!result) result = load(argv[3], &b.meshes[1], &b.trees[1]);
  FILE *file = result ? NULL : fopen(argv[1], "w");
  if (file) result = bake(file, &b);
  const int good = file && !result && !ferror(file) && fclose(file) == 0;
  if (!good) {
    fprintf(stderr, "bake_certificates: %s\n", result ? nsvcd_result_string(result) : argv[1]);
    remove(argv[1]);
  }
  return good ? 0 : 1;
}
