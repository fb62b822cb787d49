// robot_shapes.h - what a body or an obstacle of a planning file is: a mesh of a file, a simple shape,
// or a cloud of points. Include load.h first.
//
//   PATH | sphere: R | capsule: R LENGTH | box: SX SY SZ | cylinder: R LENGTH | cloud: PATH R
//
// examples/FORMATS.md says what they mean.
#ifndef NSVCD_SCENERY_ROBOT_SHAPES_H
#define NSVCD_SCENERY_ROBOT_SHAPES_H

typedef enum robot_kind {
  ROBOT_MESH = 0,
  ROBOT_SPHERE,
  ROBOT_CAPSULE,
  ROBOT_BOX,
  ROBOT_CYLINDER,
  ROBOT_CLOUD,
  ROBOT_KINDS
} robot_kind;

#define ROBOT_SIDES 32  // of a cylinder, and of what is round in a picture

typedef struct robot_shape {
  robot_kind kind;
  const char *path;  // of a mesh or a cloud, else ""
  double scale[3];   // of a mesh
  double sizes[3];   // metres, of a shape, as in the file; of a cloud the radius
} robot_shape;

// How a shape is written, and how many numbers it has.
static const struct robot_word {
  const char *word, *form;
  size_t numbers;
} robot_words[ROBOT_KINDS] = {{"", "PATH", 0},
                              {"sphere:", "sphere: R", 1},
                              {"capsule:", "capsule: R LENGTH", 2},
                              {"box:", "box: SX SY SZ", 3},
                              {"cylinder:", "cylinder: R LENGTH", 2},
                              {"cloud:", "cloud: PATH R", 1}};

// Reads a shape from a field on; *at becomes the field after it. Returns 0 after a complaint.
static int robot_read_shape(const reader *r, size_t *at, robot_shape *out) {
  size_t kind = ROBOT_MESH + 1;
  memset(out, 0, sizeof *out);
  out->path = "";
  while (kind < ROBOT_KINDS && strcmp(robot_words[kind].word, r->fields[*at]) != 0) kind++;
  if (kind == ROBOT_KINDS) kind = ROBOT_MESH;
  out->kind = (robot_kind)kind;
  const size_t numbers = robot_words[kind].numbers;
  const size_t paths = kind == ROBOT_MESH || kind == ROBOT_CLOUD;
  *at += kind != ROBOT_MESH;
  if (*at + paths + numbers > r->field_count) {
    char text[64];
    snprintf(text, sizeof text, "expected '%s'", robot_words[kind].form);
    return refuse(r, text);
  }
  if (paths) out->path = r->fields[(*at)++];
  for (size_t k = 0; k < numbers; k++, ++*at) {
    const char *field = r->fields[*at];
    if (!parse_number(field, &out->sizes[k]) || !(out->sizes[k] > 0) ||
        !(out->sizes[k] <= (double)NSVCD_MAX_COORDINATE))
      return refuse_field(r, "not a positive number of metres", field);
  }
  return 1;
}

static int robot_same_shape(const robot_shape *a, const robot_shape *b) {
  return a->kind == b->kind && strcmp(a->path, b->path) == 0 &&
         memcmp(a->scale, b->scale, sizeof a->scale) == 0 &&
         memcmp(a->sizes, b->sizes, sizeof a->sizes) == 0;
}

// ---- meshes of shapes

static void shape_room(nsvcd_mesh *mesh, size_t vertices, size_t triangles) {
  memset(mesh, 0, sizeof *mesh);
  mesh->positions = (float *)allocate(3 * vertices * sizeof *mesh->positions);
  mesh->indices = (uint32_t *)allocate(3 * triangles * sizeof *mesh->indices);
}
static void shape_vertex(nsvcd_mesh *mesh, double x, double y, double z) {
  float *at = mesh->positions + 3 * mesh->vertex_count++;
  at[0] = (float)x;
  at[1] = (float)y;
  at[2] = (float)z;
}
static void shape_triangle(nsvcd_mesh *mesh, uint32_t a, uint32_t b, uint32_t c) {
  uint32_t *at = mesh->indices + 3 * mesh->triangle_count++;
  at[0] = a;
  at[1] = b;
  at[2] = c;
}

// Turns rings (radius, z), from below to above, about z: closed by a corner below the first and one
// above the last. Half a side lies on either side of the x axis.
static void shape_turn(nsvcd_mesh *mesh, const double (*rings)[2], uint32_t count, double below,
                       double above, const double *centre, uint32_t sides) {
  const uint32_t first = (uint32_t)mesh->vertex_count;
  const uint32_t bottom = first + count * sides;
  for (uint32_t i = 0; i < count * sides; i++) {
    const double angle = 6.283185307179586 * (i % sides + 0.5) / sides;
    const double *ring = rings[i / sides];
    shape_vertex(mesh, centre[0] + ring[0] * cos(angle), centre[1] + ring[0] * sin(angle),
                 centre[2] + ring[1]);
  }
  shape_vertex(mesh, centre[0], centre[1], centre[2] + below);
  shape_vertex(mesh, centre[0], centre[1], centre[2] + above);
  for (uint32_t k = 0; k < sides; k++) {
    const uint32_t next = (k + 1) % sides;
    const uint32_t last = first + (count - 1) * sides;
    shape_triangle(mesh, bottom, first + next, first + k);
    for (uint32_t i = first; i < last; i += sides) {
      shape_triangle(mesh, i + k, i + next, i + sides + next);
      shape_triangle(mesh, i + k, i + sides + next, i + sides + k);
    }
    shape_triangle(mesh, bottom + 1, last + k, last + next);
  }
}

static void shape_box(nsvcd_mesh *mesh, const double *sizes) {
  static const uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                     2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  shape_room(mesh, 8, 12);
  for (int n = 0; n < 8; n++)
    shape_vertex(mesh, (n % 2 - 0.5) * sizes[0], (n / 2 % 2 - 0.5) * sizes[1],
                 (n / 4 - 0.5) * sizes[2]);
  for (int n = 0; n < 36; n += 3) shape_triangle(mesh, faces[n], faces[n + 1], faces[n + 2]);
}

// A prism that contains the cylinder, whose sides touch it.
static void shape_cylinder(nsvcd_mesh *mesh, double radius, double length) {
  const double centre[3] = {0, 0, 0};
  // the corners are rounded to float
  const double grown = radius * (1 + 1e-6) / cos(3.141592653589793 / ROBOT_SIDES);
  const double rings[2][2] = {{grown, -0.5 * length}, {grown, 0.5 * length}};
  shape_room(mesh, 2 * ROBOT_SIDES + 2, 4 * ROBOT_SIDES);
  shape_turn(mesh, rings, 2, -0.5 * length, 0.5 * length, centre, ROBOT_SIDES);
}

// For a picture: a capsule, a sphere if its length is 0, of flat sides.
static void shape_drawn_capsule(nsvcd_mesh *mesh, double radius, double length) {
  enum { ARC = ROBOT_SIDES / 4 };
  double rings[2 * ARC][2];
  const double centre[3] = {0, 0, 0};
  for (int k = 0; k < 2 * ARC; k++) {
    const double angle = 3.141592653589793 * (k + 0.5) / (2 * ARC) - 1.5707963267948966;
    rings[k][0] = radius * cos(angle);
    rings[k][1] = radius * sin(angle) + (k < ARC ? -0.5 : 0.5) * length;
  }
  shape_room(mesh, 2 * ARC * ROBOT_SIDES + 2, 4 * ARC * ROBOT_SIDES);
  shape_turn(mesh, rings, 2 * ARC, -radius - 0.5 * length, radius + 0.5 * length, centre,
             ROBOT_SIDES);
}

// For a picture: a double pyramid about each point.
static void shape_drawn_cloud(nsvcd_mesh *mesh, const float *points, size_t count, double radius) {
  const double rings[1][2] = {{radius, 0}};
  shape_room(mesh, 6 * count, 8 * count);
  for (size_t n = 0; n < count; n++) {
    const double centre[3] = {(double)points[3 * n], (double)points[3 * n + 1],
                              (double)points[3 * n + 2]};
    shape_turn(mesh, rings, 1, -radius, radius, centre, 4);
  }
}

// A shape as an encoder takes it: the mesh of what it is rounded about, by *radius.
static void shape_skeleton(const robot_shape *shape, nsvcd_mesh *mesh, float *radius) {
  const double *sizes = shape->sizes;
  *radius = 0;
  if (shape->kind == ROBOT_BOX) {
    shape_box(mesh, sizes);
  } else if (shape->kind == ROBOT_CYLINDER) {
    shape_cylinder(mesh, sizes[0], sizes[1]);
  } else {
    shape_room(mesh, 2, 1);
    shape_vertex(mesh, 0, 0, -0.5 * sizes[1]);
    if (shape->kind == ROBOT_CAPSULE) shape_vertex(mesh, 0, 0, 0.5 * sizes[1]);
    const uint32_t last = (uint32_t)mesh->vertex_count - 1;
    shape_triangle(mesh, 0, last, last);
    *radius = (float)sizes[0];
  }
}

// ---- clouds

// Reads points: of a PLY its vertices, of any other text the first three numbers of each line.
// Returns its format, or NULL after a complaint.
static const char *load_cloud(const char *from, const char *path, mesh_soup *soup) {
  size_t size;
  mesh_fault fault;
  char *bytes = read_file(from, path, &size, NULL);
  if (!bytes) return NULL;
  memset(soup, 0, sizeof *soup);
  memset(&fault, 0, sizeof fault);
  const int is_ply = size >= 4 && memcmp(bytes, "ply", 3) == 0;
  const char *at = bytes;
  const char *end = bytes + size;
  int good = is_ply ? ply_read(bytes, size, soup, &fault) : 1;
  for (size_t line = 1; at < end && good && !is_ply; line++) {
    const char *next = (const char *)memchr(at, '\n', (size_t)(end - at));
    const char *stop = next ? next : end;
    double point[3];
    int count = 0;
    while (count < 3) {
      while (at < stop && (*at == ' ' || *at == '\t' || *at == '\r')) at++;
      if (at == stop || *at == '#' || !mesh_number(&at, stop, &point[count])) break;
      count++;
    }
    // an empty line, or a comment
    const int is_none = count == 0 && (at == stop || *at == '#');
    good = is_none || (count == 3 && mesh_soup_vertex(soup, point));
    if (!good) mesh_refuse(&fault, count == 3 ? "out of memory" : "expected x y z, of a point");
    fault.line = good ? 0 : line;
    at = next ? next + 1 : end;
  }
  free(bytes);
  if (good && soup->vertices == 0) good = mesh_refuse(&fault, "no points");
  if (good) return is_ply ? "PLY" : "text";
  mesh_soup_free(soup);
  if (fault.line)
    complain("%s%s:%zu: %s", from, path, fault.line, fault.reason);
  else
    complain("%s%s: %s", from, path, fault.reason);
  return NULL;
}

// ---- shapes of all kinds

// Loads what a shape is, as triangles, for a picture. Returns 0 after a complaint.
static int load_shape(const char *file, const robot_shape *shape, nsvcd_mesh *mesh) {
  char path[4096];
  mesh_soup cloud;
  float radius;
  path_of(file, shape->path, path, sizeof path);
  if (shape->kind == ROBOT_MESH) {
    if (!load_mesh("", path, mesh)) return 0;
    scale_mesh(mesh, shape->scale);
  } else if (shape->kind == ROBOT_CLOUD) {
    if (!load_cloud("", path, &cloud)) return 0;
    shape_drawn_cloud(mesh, cloud.positions, cloud.vertices, shape->sizes[0]);
    mesh_soup_free(&cloud);
  } else if (shape->kind == ROBOT_BOX || shape->kind == ROBOT_CYLINDER) {
    shape_skeleton(shape, mesh, &radius);
  } else {
    shape_drawn_capsule(mesh, shape->sizes[0], shape->sizes[1]);
  }
  return 1;
}

// How far a shape goes beyond its skeleton, metres.
static double shape_radius(const robot_shape *shape) {
  const int is_round = shape->kind == ROBOT_SPHERE || shape->kind == ROBOT_CAPSULE;
  return is_round || shape->kind == ROBOT_CLOUD ? shape->sizes[0] : 0;
}

// Makes the tree of a mesh, or of a shape's skeleton. Returns 0 after a complaint.
static int load_shape_tree(const char *file, const robot_shape *shape, proof_mesh *out) {
  char path[4096];
  mesh_soup cloud;
  float radius;
  if (shape->kind == ROBOT_MESH) return load_tree(file, shape->path, shape->scale, out);
  if (shape->kind != ROBOT_CLOUD) {
    shape_skeleton(shape, &out->mesh, &radius);
    return build_tree(robot_words[shape->kind].word, out);
  }
  path_of(file, shape->path, path, sizeof path);
  const char *format = load_cloud("", path, &cloud);
  if (!format) return 0;
  if (strcmp(format, "PLY") == 0) {
    mesh_soup_free(&cloud);
    return complain("%s: a PLY: certificates are of clouds in text, as build/verify reads no other",
                    path);
  }
  shape_room(&out->mesh, cloud.vertices, cloud.vertices);
  for (uint32_t i = 0; i < cloud.vertices; i++) {
    const float *at = cloud.positions + 3 * (size_t)i;
    shape_vertex(&out->mesh, (double)at[0], (double)at[1], (double)at[2]);
    shape_triangle(&out->mesh, i, i, i);
  }
  mesh_soup_free(&cloud);
  return build_tree(path, out);
}

static const nsvcd_body *encode_cloud(const char *from, const char *path, double radius,
                                      double *taken) {
  const nsvcd_body *body = NULL;
  mesh_soup cloud;
  if (!load_cloud(from, path, &cloud)) return NULL;
  const double start = seconds();
  const nsvcd_result result =
      nsvcd_encode_cloud(cloud.positions, cloud.vertices, (float)radius, NULL, &body);
  *taken = seconds() - start;
  mesh_soup_free(&cloud);
  if (result) complain("%s%s: %s", from, path, reason_of(result));
  return body;
}

// Encodes a shape, whose paths are from a file's folder. from: what asks for it, for messages.
// Returns NULL after a complaint.
static const nsvcd_body *encode_shape(const char *from, const char *file, const robot_shape *shape,
                                      const nsvcd_encode_options *options, double *taken) {
  char path[4096];
  nsvcd_mesh mesh;
  nsvcd_encode_options asked = *options;
  path_of(file, shape->path, path, sizeof path);
  if (shape->kind == ROBOT_MESH)
    return encode_named(from, file, shape->path, shape->scale, options, taken);
  if (shape->kind == ROBOT_CLOUD) return encode_cloud(from, path, shape->sizes[0], taken);
  shape_skeleton(shape, &mesh, &asked.convex_radius);
  const nsvcd_body *body = encode_mesh(from, robot_words[shape->kind].word, &mesh, &asked, taken);
  nsvcd_mesh_free(&mesh, NULL);
  return body;
}
#endif  // NSVCD_SCENERY_ROBOT_SHAPES_H
