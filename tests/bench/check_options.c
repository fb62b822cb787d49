// check_options.c - asks every option against every other. Scenes as users have them, each asked
// with all pairs of options, both ways round, and with all amounts of work; the answers are judged
// against each other and against distances in double.
//
//   build/check_options [COUNT [SEED [NAME.obj...]]]     scenes; the first one's seed; more bodies
//
// One scene alone, COUNT 1, is told in full: a line that this prints says which. Exit status 1 if
// an answer is wrong, or a verdict is lost. Other findings, of how much is said, are counted.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#define PROGRAM "check_options"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/oracle.h"
#include "../../examples/scenery/poses.h"
#include "../../examples/scenery/status_of.h"
#include "../body_of.h"

#define MOST_POSES 200
#define MOST_ASKS 1200
#define MOST_MOMENTS 2500
#define MOST_WORLDS 8
#define MOST_FILES 100
#define EXAMPLES 3

// -------------------------------------------------------------------------------------------------
// findings

// What can be found, what must not be first: KIND(name, text).
// clang-format off
#define FINDINGS(KIND) \
  KIND(FREE_BUT_NEAR, "certified free, but nearer than the clearance") \
  KIND(FREE_BUT_INSIDE, "certified free, but one is inside") \
  KIND(UNTIL_BUT_NEAR, "nearer than the clearance before time.low") \
  KIND(LOW_TOO_HIGH, "nearer than distance.low") \
  KIND(HIGH_TOO_LOW, "farther than distance.high at nearest.time") \
  KIND(WITNESS_APART, "a witness whose triangles are apart") \
  KIND(INSIDE_FALSE, "INSIDE, but nothing is") \
  KIND(INSIDE_POINT, "INSIDE, at a point that is not") \
  KIND(SKIN_DEEP, "deeper than the skin at the start, but no collision") \
  KIND(CONTRADICTION, "two answers contradict each other") \
  KIND(BAD_ANSWER, "an answer that breaks its description") \
  KIND(BAD_PLACE, "a point or a normal that is not of the triangles named") \
  KIND(LOST_BY_FIRST, "FIRST loses a verdict") \
  KIND(LOST_BY_MEASURE, "DISTANCE loses a verdict") \
  KIND(LOST_BY_BOTH, "DISTANCE with `clearance` loses a verdict") \
  KIND(LOST_BY_SKIN, "`skin` loses a verdict") \
  KIND(LOST_BY_SEGMENTS, "16 segments lose a verdict") \
  KIND(LOST_BY_CLEARANCE, "a verdict that another clearance implies is lost") \
  KIND(LOST_BY_TOLERANCE, "`tolerance` loses a verdict") \
  KIND(LOST_IN_HASTE, "FIRST loses a verdict for which it has 16 times the work") \
  KIND(MEASURE_IN_HASTE, "DISTANCE loses a verdict for which it has 16 times the work") \
  KIND(LOST_FOR_GOOD, "a lost verdict that 16 times the work does not bring back") \
  KIND(FINER_LATER, "finer `to_time`: time.low earlier") \
  KIND(FINER_EARLIER, "finer `to_time`: contact later") \
  KIND(WIDE, "bracket wider than its description allows") \
  KIND(LADDER_LOST, "more work loses a verdict") \
  KIND(SWAP_DIFFERS, "a and b swapped: another answer") \
  KIND(SKIN_RESTS, "within the skin at the start, but not lifted") \
  KIND(SKIN_SHORT, "lifted, but touches still") \
  KIND(SKIN_LONG, "lifted by more than 4 skins") \
  KIND(SKIN_DIFFERS, "the lift depends on first, measure, segments or tolerance") \
  KIND(GAVE_UP, "undecided with work left and nothing near") \
  KIND(CLEAR_UNDECIDED, "undecided, and nothing comes within 1 mm of the clearance") \
  KIND(START_UNDECIDED, "cross at the start, but undecided") \
  KIND(INSIDE_MEETS, "INSIDE where surfaces meet at the start") \
  KIND(OVER_WORK, "work beyond the limit by 10,000 and more") \
  KIND(COARSER_LOW, "finer `to`: distance.low lower") \
  KIND(LADDER_UNTIL, "more work: time.low earlier") \
  KIND(LADDER_LATER, "more work: first contact later") \
  KIND(LADDER_LOW, "more work: distance.low lower") \
  KIND(LADDER_HIGH, "more work: distance.high higher") \
  KIND(PART_FARTHER, "triangles named are nearer than distance.high by 4 hairs and more") \
  KIND(LATE, "witness later than first, and nothing near at time.low") \
  KIND(LATE_IN_DOUBT, "the same, but an eighth of the work was spent")
// clang-format on
#define KIND_NAME(name, text) name,
#define KIND_TEXT(name, text) {.what = text},
typedef enum kind { FINDINGS(KIND_NAME) KINDS } kind;
#define FAILURES COARSER_LOW  // before this

static struct {
  const char *what;
  size_t count, scenes;
  uint64_t last;  // scene
  char examples[EXAMPLES][1400];
} findings[KINDS] = {FINDINGS(KIND_TEXT)};
static size_t questions, verdicts[6];
static int telling;  // all findings
static double widest;

// -------------------------------------------------------------------------------------------------
// bodies

// clang-format off
enum { BOX, FINE_BOX, CONE, FRUSTUM, PYRAMID, WEDGE, CYLINDER, CUP, PEG, SCREW, PRISM, GEAR,
       BOXES, STANDING = BOXES + 16, SLAB = STANDING, FINE_SLAB, BLOCK, WALLS, PLATE, NEEDLE, LINK,
       RING, SHELL, BALL, CRUMB, SOLIDS, HOLLOWS = SOLIDS + 10, FILES = HOLLOWS + SHAPES_HOLLOWS };
// clang-format on

typedef struct solid {
  shapes_mesh shape;  // metres, rounded to float
  const nsvcd_body *body;
  double low[3], high[3], reach;
  int closed;
} solid;
// clang-format off
static const char *const names[SOLIDS] = {
  "box", "fine box", "cone", "frustum", "pyramid", "wedge", "cylinder", "cup", "peg", "screw",
  "prism", "gear", [SLAB] = "slab", "fine slab", "block", "walls", "plate", "needle", "link",
  "ring", "shell", "ball", "crumb"};
// clang-format on
static solid solids[FILES + MOST_FILES];
static char **file_names;
static int file_count;

static void shape_screw(shapes_mesh *m) {
  double path[97][3];
  shapes_cylinder(m, 0.008, 0.08, 16);
  for (int i = 0; i < 97; i++) {
    path[i][0] = 0.009 * cos(i * SHAPES_PI / 8);
    path[i][1] = 0.009 * sin(i * SHAPES_PI / 8);
    path[i][2] = 0.0007 * (i - 48);
  }
  shapes_tube(m, (const double(*)[3])path, 97, 0.0015, 6, 0);
}

static void make_shape(int n, shapes_mesh *m) {
  const double wedge[3][2] = {{0, 0}, {0.1, 0}, {0, 0.06}};
  shapes_rng rng = {(uint64_t)n};
  // clang-format off
  switch (n) {
    case BOX: shapes_box(m, 0.1, 0.1, 0.1, 1); return;
    case FINE_BOX: shapes_box(m, 0.12, 0.09, 0.06, 5); return;
    case CONE: shapes_cone(m, 0.05, 0, 0.1, 24); return;
    case FRUSTUM: shapes_cone(m, 0.05, 0.03, 0.06, 16); return;
    case PYRAMID: shapes_cone(m, 0.06, 0, 0.08, 4); return;
    case WEDGE: shapes_extrude(m, wedge, 3, 0.05); return;
    case CYLINDER: shapes_cylinder(m, 0.04, 0.1, 24); return;
    case CUP: shapes_cup(m, 0.04, 0.09, 0.003, 1.2, 24); return;
    case PEG: shapes_peg(m, 0.02, 0.1, 16); return;
    case SCREW: shape_screw(m); return;
    case PRISM: shapes_prism(m, 0.04, 0.08, 6); return;
    case GEAR: shapes_gear(m, 0.05, 0.008, 0.01, 12); return;
    case SLAB: shapes_box(m, 1, 1, 0.05, 1); return;
    case FINE_SLAB: shapes_box(m, 1, 1, 0.05, 12); return;
    case BLOCK: shapes_box(m, 0.3, 0.3, 0.2, 2); return;
    case WALLS: shapes_box_at(m, 0.25, 0.25, -0.05, 0.7, 0.7, 0.1);
      shapes_box_at(m, -0.05, 0.25, 0.2, 0.1, 0.7, 0.6);
      shapes_box_at(m, 0.25, -0.05, 0.2, 0.7, 0.1, 0.6); return;
    case PLATE: shapes_box(m, 0.3, 0.3, 0.001, 3); return;
    case NEEDLE: shapes_box(m, 0.1, 2e-4, 2e-4, 1); return;
    case LINK: shapes_torus(m, 0.05, 0.008, 24, 10); return;
    case RING: shapes_ring(m, 0.03, 0.0115, 0.02, 24); return;
    case SHELL: shapes_shell(m, 0.3, 0.25, 0.2, 0.01, 0, 8); return;
    case BALL: shapes_ellipsoid(m, 0.1, 0.1, 0.1, 20); return;
    case CRUMB: shapes_ellipsoid(m, 0.012, 0.01, 0.008, 12); return;
    default: break;
  }
  // clang-format on
  if (n < STANDING) {
    const double x = shapes_uniform(&rng, 0.02, 0.3);
    const double y = shapes_uniform(&rng, 0.02, 0.3);
    shapes_box(m, x, y, shapes_uniform(&rng, 0.02, 0.3), 1 + n % 3);
  } else if (n < HOLLOWS)
    shapes_random_solid(m, &rng, shapes_uniform(&rng, 0.05, 0.4));
  else
    shapes_random_hollow(m, &rng, n - HOLLOWS, 0.3);
}

// From a file, at a size of 0.15 m.
static void read_shape(const char *path, shapes_mesh *m) {
  nsvcd_mesh mesh;
  size_t line;
  if (nsvcd_obj_load(path, NULL, &mesh, &line)) {
    complain("%s: cannot be read: a box", path);
    shapes_box(m, 0.15, 0.1, 0.05, 1);
    return;
  }
  for (size_t i = 0; i < mesh.vertex_count; i++) {
    const float *p = mesh.positions + 3 * i;
    shapes_vertex(m, (double)p[0], (double)p[1], (double)p[2]);
  }
  for (size_t i = 0; i < mesh.triangle_count; i++) {
    const uint32_t *t = mesh.indices + 3 * i;
    shapes_triangle(m, t[0], t[1], t[2]);
  }
  nsvcd_mesh_free(&mesh, NULL);
  shapes_fit(m, 0.15);
}

static const solid *solid_of(int n) {
  solid *s = &solids[n];
  if (s->body) return s;
  if (n < FILES)
    make_shape(n, &s->shape);
  else
    read_shape(file_names[n - FILES], &s->shape);
  s->body = body_of(&s->shape, NULL);
  for (size_t i = 0; i < s->shape.vertices; i++)
    s->reach = fmax(s->reach, oracle_length(s->shape.positions + 3 * i));
  shapes_bounds(&s->shape, s->low, s->high);
  s->closed =
      oracle_is_closed(s->shape.positions, s->shape.vertices, s->shape.indices, s->shape.triangles);
  return s;
}

// -------------------------------------------------------------------------------------------------
// scenes

typedef struct part {
  const solid *of;
  float scale;
  oracle_mesh mesh;
  nsvcd_pose raw[MOST_POSES];
  oracle_pose poses[MOST_POSES];
  float times[MOST_POSES];
  int timed;  // else they are uniform
  size_t count;
} part;

// How a part goes: from a place along a way, turned about an axis, higher in the middle.
typedef struct travel {
  int solid;
  double place[3], q[4], way[3], axis[3], angle, bump, wander;
  size_t count;
} travel;

typedef struct scene {
  const char *name;
  uint64_t seed;
  part parts[2];
  double scale, clearance, skin, first, measure, tolerance;
  size_t work;
  int deep;        // pressed in deeper than the skin, at the start
  int rests;       // on flat faces, or within the skin of them
  double pressed;  // by so much into them
  double size, speed, turn;
  // what is told in float is off by, metres
  double epsilon;
  int lifted_with;  // the part with which a lift turns
} scene;

static int pick_body(shapes_rng *rng) {
  const int k = shapes_pick(rng, file_count ? 4 : 3);
  return k == 0   ? shapes_pick(rng, STANDING)
         : k == 1 ? SOLIDS + shapes_pick(rng, FILES - SOLIDS)
         : k == 2 ? LINK + shapes_pick(rng, SOLIDS - LINK)
                  : FILES + shapes_pick(rng, file_count);
}
static int pick_standing(shapes_rng *rng) {
  if (file_count && shapes_pick(rng, 4) == 0) return FILES + shapes_pick(rng, file_count);
  return shapes_pick(rng, 4) ? shapes_pick(rng, BOXES) : BOXES + shapes_pick(rng, 16);
}
static double top_of(const scene *s, int n) {
  return s->scale * solid_of(n)->high[2];
}
static double foot_of(const scene *s, int n) {
  return s->scale * solid_of(n)->low[2];
}
static double log_uniform(shapes_rng *rng, double low, double high) {
  return low * pow(high / low, shapes_uniform(rng, 0, 1));
}

// What a thing that stands does: nothing, slides, is lifted off, set down, turned.
static void move_standing(scene *s, shapes_rng *rng, travel *a) {
  const int what = shapes_pick(rng, 6);
  const double far = s->scale * shapes_uniform(rng, 0.02, 0.4);
  const double angle = shapes_uniform(rng, 0, 2 * SHAPES_PI);
  if (what == 0) a->count = 1 + (size_t)shapes_pick(rng, 2);
  if (what == 1 || what == 2) {
    a->way[0] = far * cos(angle);
    a->way[1] = far * sin(angle);
  }
  if (what == 2 || what == 3) a->way[2] = far;
  if (what == 4) {
    a->place[2] += far;
    a->way[2] = -far;
    s->rests = s->deep = 0;
  }
  if (what == 5) a->angle = angle / 4;
  a->axis[0] = 0;
  a->axis[2] = 1;
}
static void draw_pressed(scene *s, shapes_rng *rng) {
  const int how = shapes_pick(rng, 5);
  s->pressed = how < 2    ? 0
               : how == 2 ? s->skin * shapes_uniform(rng, 0.01, 0.5)
               : how == 3 ? log_uniform(rng, 5e-5, 5e-4)
                          : -s->skin * shapes_uniform(rng, 0, 0.9);
  s->rests = s->pressed < 0.9 * s->skin;
  s->deep = s->pressed > 1.1 * s->skin + 2e-5;
}
static void scene_stands(scene *s, shapes_rng *rng, travel *a, travel *b) {
  static const int floors[5] = {SLAB, SLAB, FINE_SLAB, BLOCK, BOXES};
  a->solid = pick_standing(rng);
  b->solid = floors[shapes_pick(rng, 5)];
  if (b->solid == BOXES) b->solid += shapes_pick(rng, 16);
  draw_pressed(s, rng);
  const double room = b->solid < STANDING ? 0.01 : b->solid == BLOCK ? 0.1 : 0.4;
  for (int k = 0; k < 2; k++)
    a->place[k] = s->scale * room * (shapes_pick(rng, 3) ? shapes_uniform(rng, -1, 1) : 0);
  a->place[2] = top_of(s, b->solid) - foot_of(s, a->solid) - s->pressed;
  move_standing(s, rng, a);
}
static void scene_corner(scene *s, shapes_rng *rng, travel *a, travel *b) {
  a->solid = shapes_pick(rng, 3) ? BOXES + shapes_pick(rng, 16) : shapes_pick(rng, 2);  // boxes
  b->solid = WALLS;
  draw_pressed(s, rng);
  for (int k = 0; k < 3; k++) a->place[k] = -s->scale * solid_of(a->solid)->low[k] - s->pressed;
  a->way[shapes_pick(rng, 3)] = 0.2 * s->scale;
  if (shapes_pick(rng, 3) == 0) a->count = 1;
}
static void scene_stacked(scene *s, shapes_rng *rng, travel *a, travel *b) {
  static const int twins[4] = {BOX, FINE_BOX, BLOCK, CYLINDER};
  a->solid = twins[shapes_pick(rng, 4)];
  if (shapes_pick(rng, 2)) a->solid = BOXES + shapes_pick(rng, 16);
  b->solid = a->solid;
  draw_pressed(s, rng);
  if (shapes_pick(rng, 2)) a->place[0] = 0.03 * s->scale;
  a->place[2] = top_of(s, b->solid) - foot_of(s, a->solid) - s->pressed;
  move_standing(s, rng, a);
}
static void scene_glides(scene *s, shapes_rng *rng, travel *a, travel *b) {
  const double gap = pow(10, -2 - shapes_pick(rng, 5));
  a->solid = pick_standing(rng);
  b->solid = shapes_pick(rng, 2) ? SLAB : BLOCK;
  a->place[0] = -0.4 * s->scale;
  a->place[2] = top_of(s, b->solid) - foot_of(s, a->solid) + gap;
  a->way[0] = 0.8 * s->scale;
  a->axis[0] = 0;
  a->axis[2] = 1;
  a->angle = shapes_pick(rng, 2) ? 0 : shapes_uniform(rng, 0, 3);
}
// Any two, placed by their distance to a gap of 1 um to 10 mm halfway.
static void scene_passes(scene *s, shapes_rng *rng, travel *a, travel *b) {
  const double gap = pow(10, -2 - shapes_pick(rng, 5));
  oracle_mesh meshes[2];
  oracle_pose poses[2];
  double on_a[3], on_b[3];
  a->solid = pick_body(rng);
  b->solid = pick_body(rng);
  shapes_quaternion(rng, a->q);
  shapes_direction(rng, a->place);
  for (int k = 0; k < 2; k++) {
    const shapes_mesh *m = &solid_of((k ? b : a)->solid)->shape;
    if (!oracle_mesh_init(&meshes[k], m->positions, m->vertices, m->indices, m->triangles,
                          s->scale))
      exit(REFUSED);
    memcpy(poses[k].rotation, (k ? b : a)->q, sizeof poses[k].rotation);
    memcpy(poses[k].position, (k ? b : a)->place, sizeof poses[k].position);
  }
  const double apart = oracle_distance(&meshes[0], &poses[0], &meshes[1], &poses[1], on_a, on_b);
  shapes_direction(rng, a->way);
  for (int k = 0; k < 3 && apart > 0; k++) on_a[k] = (on_a[k] - on_b[k]) / apart;
  const double along = oracle_dot(on_a, a->way);
  for (int k = 0; k < 3 && apart > 0; k++) {
    a->way[k] = 0.4 * (a->way[k] - along * on_a[k]);
    a->place[k] -= (apart - gap) * on_a[k] + a->way[k] / 2;
  }
  oracle_mesh_free(&meshes[0]);
  oracle_mesh_free(&meshes[1]);
}
static void scene_far(scene *s, shapes_rng *rng, travel *a, travel *b) {
  (void)s;
  a->solid = pick_body(rng);
  b->solid = pick_body(rng);
  a->place[0] = 10;
  a->way[1] = shapes_uniform(rng, 0, 5);
  a->angle = shapes_uniform(rng, 0, 3);
}
static void scene_crosses(scene *s, shapes_rng *rng, travel *a, travel *b) {
  a->solid = pick_body(rng);
  b->solid = shapes_pick(rng, 3) ? pick_body(rng) : a->solid;
  if (shapes_pick(rng, 2)) shapes_quaternion(rng, a->q);
  a->wander = s->scale * 0.001 * shapes_pick(rng, 2) * pow(8, shapes_pick(rng, 3));
  a->angle = shapes_pick(rng, 3) ? 0 : shapes_uniform(rng, 0, 3);
  if (shapes_pick(rng, 3) == 0) {  // both turn
    b->angle = shapes_uniform(rng, 0, 2);
    b->count = a->count;
  }
  shapes_direction(rng, a->way);
  if (shapes_pick(rng, 3) == 0) {  // faces in one plane
    memset(a->way, 0, sizeof a->way);
    a->way[shapes_pick(rng, 3)] = 1;
  }
  const double reach = s->scale * fmin(solid_of(a->solid)->reach, solid_of(b->solid)->reach);
  const double off = a->solid == b->solid && shapes_pick(rng, 3) == 0 ? 0 : 0.3;
  const int how = shapes_pick(rng, 3);  // at the start, at the end, both
  for (int k = 0; k < 3; k++) {
    a->place[k] = off * reach * a->way[(k + 1) % 3] - (how == 1 ? 0.7 * a->way[k] : 0);
    a->way[k] *= how == 2 ? 0.02 : 0.7;
  }
}
static void scene_hollow(scene *s, shapes_rng *rng, travel *a, travel *b) {
  static const int hulls[4] = {CUP, SHELL, HOLLOWS, HOLLOWS + 3};
  a->solid = CRUMB;
  b->solid = hulls[shapes_pick(rng, 4)];
  const solid *hull = solid_of(b->solid);
  for (int k = 0; k < 3; k++) a->place[k] = s->scale * (hull->low[k] + hull->high[k]) / 2;
  a->way[shapes_pick(rng, 3)] = s->scale * shapes_uniform(rng, 0, 0.2);
  if (shapes_pick(rng, 3) == 0) a->count = 1;
}
static void scene_within(scene *s, shapes_rng *rng, travel *a, travel *b) {
  static const int outer[4] = {BLOCK, BALL, CYLINDER, BOX};
  const int swap = shapes_pick(rng, 2);
  a->solid = swap ? outer[shapes_pick(rng, 4)] : CRUMB;
  b->solid = swap ? CRUMB : outer[shapes_pick(rng, 4)];
  a->place[0] = 0.01 * s->scale;
  a->way[1] = shapes_pick(rng, 2) * 0.3 * s->scale;
  a->angle = shapes_pick(rng, 2);
}
static void scene_needle(scene *s, shapes_rng *rng, travel *a, travel *b) {
  a->solid = NEEDLE;
  b->solid = PLATE;
  oracle_axis_angle(b->axis, 0, b->q);
  for (int k = 0; k < 2; k++) a->place[k] = s->scale * shapes_uniform(rng, -0.17, 0.17);
  a->q[1] = a->q[3] = sqrt(0.5);  // its length along z
  a->place[2] = s->scale * shapes_uniform(rng, 0.1, 1);
  a->way[2] = -10 * s->scale;
}
static void scene_chain(scene *s, shapes_rng *rng, travel *a, travel *b) {
  a->solid = b->solid = LINK;
  a->q[0] = a->q[3] = sqrt(0.5);
  a->place[0] = s->scale * shapes_uniform(rng, 0.02, 0.07);
  a->way[shapes_pick(rng, 3)] = s->scale * shapes_uniform(rng, 0, 0.1);
  a->angle = shapes_uniform(rng, 0, 1);
}
static void scene_gears(scene *s, shapes_rng *rng, travel *a, travel *b) {
  a->solid = b->solid = GEAR;
  a->place[0] = s->scale * shapes_uniform(rng, 0.091, 0.101);
  a->axis[0] = b->axis[0] = 0;
  a->axis[2] = b->axis[2] = 1;
  a->angle = shapes_uniform(rng, 0, 2);
  b->angle = -a->angle;
  b->count = a->count;
}
static void scene_screws(scene *s, shapes_rng *rng, travel *a, travel *b) {
  a->solid = SCREW;
  b->solid = RING;
  a->place[2] = s->scale * shapes_uniform(rng, 0.03, 0.08);
  a->place[0] = s->scale * shapes_uniform(rng, 0, 0.0015);
  a->way[2] = -0.06 * s->scale;
  a->axis[0] = 0;
  a->axis[2] = 1;
  a->angle = shapes_uniform(rng, 0, 12);
  if (a->count < 17) a->count = 17;
}
static void scene_wanders(scene *s, shapes_rng *rng, travel *a, travel *b) {
  static const size_t counts[4] = {2, 5, 33, 200};
  a->solid = pick_body(rng);
  b->solid = pick_body(rng);
  shapes_quaternion(rng, a->q);
  shapes_quaternion(rng, b->q);
  shapes_direction(rng, b->axis);
  for (int k = 0; k < 3; k++) {
    a->place[k] = s->scale * shapes_uniform(rng, -0.4, 0.4);
    a->way[k] = s->scale * shapes_uniform(rng, -0.4, 0.4);
    b->way[k] = s->scale * shapes_uniform(rng, -0.4, 0.4);
  }
  a->angle = shapes_uniform(rng, 0, 2);
  b->angle = shapes_uniform(rng, 0, 2);
  a->wander = b->wander = 0.01 * s->scale;
  b->count = counts[shapes_pick(rng, 4)];
}

static const struct {
  const char *name;
  void (*draw)(scene *s, shapes_rng *rng, travel *a, travel *b);
  int fraction;
} makers[] = {
    {"stands", scene_stands, 5},   {"corner", scene_corner, 2},  {"stacked", scene_stacked, 2},
    {"glides", scene_glides, 2},   {"passes", scene_passes, 3},  {"far", scene_far, 2},
    {"crosses", scene_crosses, 3}, {"hollow", scene_hollow, 1},  {"within", scene_within, 1},
    {"needle", scene_needle, 1},   {"chain", scene_chain, 1},    {"gears", scene_gears, 1},
    {"screws", scene_screws, 1},   {"wanders", scene_wanders, 3}};
#define MAKERS (sizeof makers / sizeof makers[0])

static oracle_pose part_at(const part *p, double t) {
  size_t k = 0;
  if (!p->timed) return oracle_pose_at(p->poses, p->count, t);
  while (k + 2 < p->count && (double)p->times[k + 1] <= t) k++;
  const double from = (double)p->times[k];
  const double fraction = (t - from) / ((double)p->times[k + 1] - from);
  return oracle_pose_between(&p->poses[k], &p->poses[k + 1], fraction);
}

// Of every third part the poses are at times of their own, of 20 bits. rng: a copy.
static void set_times(shapes_rng rng, part *p) {
  double sums[MOST_POSES] = {0};
  p->timed = p->count > 1 && shapes_next(&rng) % 3 == 0;
  for (size_t n = 1; n < p->count; n++) sums[n] = sums[n - 1] + shapes_uniform(&rng, 0.1, 1);
  for (size_t n = 0; n < p->count; n++) {
    const double t = p->count > 1 ? sums[n] / sums[p->count - 1] : 0;
    p->times[n] = (float)(rint(t * 1048576) / 1048576);
  }
}

// The poses of a part: its travel, seen from a frame that itself goes along a way.
static void set_part(scene *s, shapes_rng *rng, part *p, const travel *go, const oracle_pose *frame,
                     const double *along) {
  p->of = solid_of(go->solid);
  p->scale = (float)s->scale;
  p->count = go->count;
  const shapes_mesh *m = &p->of->shape;
  if (!oracle_mesh_init(&p->mesh, m->positions, m->vertices, m->indices, m->triangles,
                        (double)p->scale))
    exit(REFUSED);
  set_times(*rng, p);
  for (size_t n = 0; n < p->count; n++) {
    const double uniform = p->count > 1 ? (double)n / (double)(p->count - 1) : 0;
    const double t = p->timed ? (double)p->times[n] : uniform;
    oracle_pose own;
    double turn[4];
    oracle_axis_angle(go->axis, go->angle * t, turn);
    oracle_quat_mul(turn, go->q, own.rotation);
    for (int k = 0; k < 3; k++)
      own.position[k] = go->place[k] + t * go->way[k] + go->wander * shapes_uniform(rng, -1, 1);
    own = oracle_compose(frame, &own);
    for (int k = 0; k < 3; k++) own.position[k] += t * along[k];
    p->raw[n] = pose_rounded(&own);
    p->poses[n] = pose_widened(&p->raw[n]);
    if (!n) continue;
    double moved[3], axis[3];
    oracle_sub(p->poses[n].position, p->poses[n - 1].position, moved);
    const double angle = oracle_quat_arc(p->poses[n - 1].rotation, p->poses[n].rotation, axis);
    const double way = oracle_length(moved) + s->scale * p->of->reach * angle;
    s->turn += angle;
    const double late = (double)p->times[n] - (double)p->times[n - 1];
    s->speed = fmax(s->speed, p->timed ? way / late : way * (double)(p->count - 1));
  }
}

static nsvcd_question question_of(const scene *s, const nsvcd_question *options, int swapped) {
  nsvcd_question q = *options;
  nsvcd_mover movers[2];
  for (int k = 0; k < 2; k++) {
    const part *p = &s->parts[k];
    movers[k] = (nsvcd_mover){.body = p->of->body, .poses = p->raw, .count = p->count};
    movers[k].times = p->timed ? p->times : NULL;
    movers[k].scale = p->scale;
  }
  q.a = movers[swapped];
  q.b = movers[!swapped];
  return q;
}

static void draw_scene(scene *s, uint64_t seed) {
  static const size_t counts[8] = {2, 2, 3, 17, 33, 65, 200, 200};
  static const double scales[6] = {1, 1, 1, 1, 0.3, 2};
  shapes_rng rng = {seed * 7919};
  travel go[2];
  const double origin[3] = {0, 0, 0};
  double along[3];
  oracle_pose frame = {{0, 0, 0}, {0, 0, 0, 1}};
  int total = 0;
  size_t maker = 0;
  memset(s, 0, sizeof *s);
  memset(go, 0, sizeof go);
  for (size_t k = 0; k < MAKERS; k++) total += makers[k].fraction;
  for (int n = shapes_pick(&rng, total); n >= makers[maker].fraction; maker++)
    n -= makers[maker].fraction;
  s->seed = seed;
  s->name = makers[maker].name;
  s->scale = scales[shapes_pick(&rng, 6)];
  s->skin = (double)(float)(1e-4 * pow(10, shapes_pick(&rng, 5) * 0.5));
  s->clearance = pow(10, -5 + shapes_pick(&rng, 4));
  s->first = pow(10, -1 - shapes_pick(&rng, 3));
  s->measure = pow(10, -5 + shapes_pick(&rng, 5));
  s->tolerance = pow(10, -5 + shapes_pick(&rng, 3));
  s->work = shapes_pick(&rng, 3) ? 20000 : NSVCD_DEFAULT_WORK;
  for (int k = 0; k < 2; k++) {
    go[k].q[3] = go[k].axis[0] = 1;
    go[k].count = k ? 1 : counts[shapes_pick(&rng, 8)];
  }
  makers[maker].draw(s, &rng, &go[0], &go[1]);
  if (shapes_pick(&rng, 2)) {
    shapes_quaternion(&rng, frame.rotation);
    for (int k = 0; k < 3; k++)
      frame.position[k] = shapes_uniform(&rng, -1, 1) * (shapes_pick(&rng, 4) ? 1 : 10);
  }
  shapes_direction(&rng, along);
  const int carried = go[0].count > 1 && shapes_pick(&rng, 4) == 0;
  if (carried && go[1].count == 1) go[1].count = shapes_pick(&rng, 2) ? go[0].count : 2;
  for (int k = 0; k < 2; k++)
    set_part(s, &rng, &s->parts[k], &go[k], &frame, carried ? along : origin);
  s->size = s->scale * (s->parts[0].of->reach + s->parts[1].of->reach);
  double away = 0;
  for (int k = 0; k < 2; k++)
    for (size_t i = 0; i < s->parts[k].count; i++)
      away = fmax(away, oracle_length(s->parts[k].poses[i].position));
  s->epsilon = 1.2e-7 * (s->size + away);
  nsvcd_question none;
  memset(&none, 0, sizeof none);
  const nsvcd_question q = question_of(s, &none, 0);
  s->lifted_with = !nsvcd__is_swapped(&q.a, &q.b);
}

// -------------------------------------------------------------------------------------------------
// distances, of a lifted off b by this or that

typedef struct moment {
  double t, d;
} moment;
typedef struct world {
  double lift[3];
  moment moments[MOST_MOMENTS];
  size_t count;
  oracle_search search;
  double least, at_start;
  int inside;  // of what is closed, at the start
} world;
static world worlds[MOST_WORLDS];
static size_t world_count;

static oracle_pose pose_in(const scene *s, const world *w, int k, double t) {
  oracle_pose pose = part_at(&s->parts[k], t);
  const part *fixed = &s->parts[s->lifted_with];
  double m[9], seen[3], turned[3];
  if (k == 1) return pose;
  const oracle_pose now = part_at(fixed, t);
  oracle_matrix(fixed->poses[0].rotation, m);
  oracle_rotate_back(m, w->lift, seen);
  oracle_matrix(now.rotation, m);
  oracle_rotate(m, seen, turned);
  for (int i = 0; i < 3; i++) pose.position[i] += turned[i];
  return pose;
}
// Remembered.
static double distance_at(const scene *s, world *w, double t) {
  for (size_t i = w->count; i-- > 0 && w->count - i < 400;) {
    if (w->moments[i].t >= t && w->moments[i].t <= t) return w->moments[i].d;
  }
  const oracle_pose a = pose_in(s, w, 0, t);
  const oracle_pose b = pose_in(s, w, 1, t);
  const double d = oracle_search_run(&w->search, &a, &b, DBL_MAX);
  w->least = fmin(w->least, d);
  if (w->count < MOST_MOMENTS) w->moments[w->count++] = (moment){t, d};
  return d;
}
// Golden section between the neighbours of the n lowest of some samples.
static void refine(const scene *s, world *w, size_t samples) {
  const double step = 1.0 / (double)(samples - 1);
  for (size_t i = 0; i < samples; i++) {
    const double here = w->moments[i].d;
    const int lowest =
        (i == 0 || here <= w->moments[i - 1].d) && (i + 1 == samples || here < w->moments[i + 1].d);
    if (!lowest || here > w->least + s->speed * step || !(here > 0) || w->count > 1500) continue;
    double low = fmax(w->moments[i].t - step, 0);
    double high = fmin(w->moments[i].t + step, 1);
    for (int k = 0; k < 22; k++) {
      const double x = low + 0.382 * (high - low);
      const double y = low + 0.618 * (high - low);
      if (distance_at(s, w, x) < distance_at(s, w, y))
        high = y;
      else
        low = x;
    }
  }
}
static int is_inside(const scene *s, const world *w) {
  for (int k = 0; k < 2; k++) {
    const oracle_pose outer = pose_in(s, w, k, 0);
    const oracle_pose inner = pose_in(s, w, !k, 0);
    if (s->parts[k].of->closed &&
        oracle_inside(&s->parts[!k].mesh, &inner, &s->parts[k].mesh, &outer) > 0.5)
      return 1;
  }
  return 0;
}
static world *world_of(const scene *s, const float *lift) {
  for (size_t i = 0; i < world_count; i++) {
    double off = 0;
    for (int k = 0; k < 3; k++) off += fabs(worlds[i].lift[k] - (double)lift[k]);
    if (off < 1e-12) return &worlds[i];
  }
  if (world_count == MOST_WORLDS) return NULL;
  world *w = &worlds[world_count++];
  w->count = 0;
  w->least = DBL_MAX;
  for (int k = 0; k < 3; k++) w->lift[k] = (double)lift[k];
  oracle_search_begin(&w->search, &s->parts[0].mesh, &s->parts[1].mesh);
  const size_t arcs = s->parts[0].count > s->parts[1].count ? s->parts[0].count : s->parts[1].count;
  const size_t samples = arcs < 2 ? 2 : arcs < 100 ? 129 : 2 * arcs - 1;
  for (size_t i = 0; i < samples; i++) distance_at(s, w, (double)i / (double)(samples - 1));
  w->at_start = w->moments[0].d;
  refine(s, w, samples);
  w->inside = is_inside(s, w);
  return w;
}

// -------------------------------------------------------------------------------------------------
// questions

typedef struct ask {
  nsvcd_question options;  // a and b left out
  int swapped;
  int ladder;           // of growing limits of work: which; 0: none
  nsvcd_answer answer;  // as if not swapped
  world *world;
} ask;
static ask asks[MOST_ASKS];
static size_t ask_count;
static void *workspace;

// How exactly the first contact is asked for, a share of the motion, or the least distance, metres;
// 0: it is not.
static float first_of(const nsvcd_question *o) {
  return o->ask == NSVCD_ASK_FIRST ? o->to_time : 0;
}
static float measure_of(const nsvcd_question *o) {
  return o->ask == NSVCD_ASK_DISTANCE ? o->to : 0;
}

static void describe(const ask *k, char *out, size_t size) {
  const nsvcd_question *o = &k->options;
  const nsvcd_answer *w = &k->answer;
  snprintf(out, size,
           "[clearance %g first %g measure %g skin %g tolerance %g segments %zu work %zu%s] %s "
           "t %.7g until %.7g low %.6g high %.6g work %zu lift %.4g %.4g %.4g",
           (double)o->clearance, (double)first_of(o), (double)measure_of(o), (double)o->slop,
           (double)o->tolerance, o->segments, o->work, k->swapped ? " swapped" : "",
           status_string(status_of(w)), (double)w->nearest.time, (double)w->time.low,
           (double)w->distance.low, (double)w->distance.high, w->work, (double)w->push_out[0],
           (double)w->push_out[1], (double)w->push_out[2]);
}

static const char *name_of(const solid *of) {
  const size_t n = (size_t)(of - solids);
  return n >= BOXES && n < STANDING ? "some box"
         : n < SOLIDS               ? names[n]
         : n < HOLLOWS              ? "solid"
         : n < FILES                ? "hollow"
                                    : "mesh";
}

// other: NULL, or the answer that this one is held against.
static void find(const scene *s, kind what, const ask *k, const ask *other, double by) {
  char text[1400], one[500], two[500] = "";
  describe(k, one, sizeof one);
  if (other) describe(other, two, sizeof two);
  snprintf(text, sizeof text,
           "%llu %s, %s on %s: %s%s%s (%g; hair %g, least %g, at start %g, pressed %g)",
           (unsigned long long)s->seed, s->name, name_of(s->parts[0].of), name_of(s->parts[1].of),
           one, other ? "\n      and " : "", two, by, s->epsilon, k->world ? k->world->least : -1,
           k->world ? k->world->at_start : -1, s->pressed);
  findings[what].count++;
  if (findings[what].last != s->seed) {
    if (findings[what].scenes < EXAMPLES)
      strcpy(findings[what].examples[findings[what].scenes], text);
    findings[what].scenes++;
  }
  findings[what].last = s->seed;
  if (telling) printf("  ! %s: %s\n", findings[what].what, text);
}

// Of b and a, as of a and b.
static void turn_contact(nsvcd_contact *c) {
  const uint32_t triangle = c->triangle_a;
  const uint32_t patch = c->patch_a;
  c->triangle_a = c->triangle_b;
  c->triangle_b = triangle;
  c->patch_a = c->patch_b;
  c->patch_b = patch;
  for (int i = 0; i < 3; i++) c->normal[i] = 0 - c->normal[i];
}

static const ask *put(const scene *s, const nsvcd_question *options, int swapped, int ladder) {
  ask *k = &asks[ask_count];
  nsvcd_answer *w = &k->answer;
  if (ask_count == MOST_ASKS) exit((complain("too many questions"), REFUSED));
  ask_count++;
  memset(k, 0, sizeof *k);
  memset(w, 0x55, sizeof *w);
  k->options = *options;
  k->swapped = swapped;
  k->ladder = ladder;
  const nsvcd_question q = question_of(s, options, swapped);
  const nsvcd_result result = nsvcd_sweep(&q, workspace, nsvcd_sweep_workspace_size(NULL), w);
  if (result)
    exit((complain("scene %llu: %s", (unsigned long long)s->seed, nsvcd_result_string(result)),
          REFUSED));
  if (swapped) {
    turn_contact(&w->nearest);
    for (size_t i = 0; i < w->contact_count; i++) turn_contact(&w->contacts[i]);
    for (int i = 0; i < 3; i++) w->push_out[i] = 0 - w->push_out[i];
  }
  k->world = world_of(s, w->push_out);
  questions++;
  verdicts[(unsigned)status_of(w) % 6]++;
  if (telling) {
    char text[600];
    describe(k, text, sizeof text);
    printf("  %s\n", text);
  }
  return k;
}

// All pairs of options and more, and of some all limits of work.
static void put_all(const scene *s) {
  static const double orders[5][2] = {{0, 0}, {1, 0}, {0.1, 0}, {0, 1}, {0, 0.1}};
  const double clearances[3] = {0, s->clearance, 10 * s->clearance};
  ask_count = 0;
  for (int n = 0; n < 5 * 3 * 2 * 4; n++) {
    nsvcd_question o;
    const int other = n / 30;  // nothing, tolerance, segments, swapped
    memset(&o, 0, sizeof o);
    o.to_time = (float)(orders[n % 5][0] * s->first);
    o.to = (float)(orders[n % 5][1] * s->measure);
    if (o.to_time > 0) o.ask = NSVCD_ASK_FIRST;
    if (o.to > 0) o.ask = NSVCD_ASK_DISTANCE;
    o.clearance = (float)clearances[n / 5 % 3];
    o.slop = n / 15 % 2 ? (float)s->skin : 0;
    o.tolerance = other == 1 ? (float)s->tolerance : 0;
    o.segments = other == 2 ? 16 : 0;
    o.work = s->work;
    put(s, &o, other == 3, 0);
  }
  const size_t base = 5 * (s->seed % 2) + 15 * (s->seed / 2 % 2);
  size_t enough = 0;  // that decides it where no order is asked for
  for (size_t n = 0; n < 5; n++) {
    nsvcd_question o = asks[base + n].options;
    size_t ends = 0;
    for (o.work = 1; o.work <= s->work && ends < 3; o.work *= 2) {
      const ask *k = put(s, &o, 0, (int)n + 1);
      const int is_open = k->answer.verdict == NSVCD_UNDECIDED;
      ends += !is_open;
      if (n == 0 && ends == 1) enough = o.work;
      if (is_open && n > 0 && enough > 0 && o.work >= 16 * enough && o.work > 500)
        find(s, n < 3 ? LOST_IN_HASTE : MEASURE_IN_HASTE, k, &asks[base], (double)enough);
    }
  }
}

// -------------------------------------------------------------------------------------------------
// one answer

static int is_within(float x, double low, double high) {
  return (double)x >= low && (double)x <= high;
}
static oracle_triangle triangle_of(const scene *s, const world *w, int k, uint32_t triangle,
                                   double t) {
  const part *p = &s->parts[k];
  const oracle_pose pose = pose_in(s, w, k, t);
  oracle_triangle out;
  for (int i = 0; i < 3; i++) {
    double v[3];
    const double *at = p->of->shape.positions + 3 * p->of->shape.indices[3 * triangle + i];
    for (int j = 0; j < 3; j++) v[j] = (double)p->scale * at[j];
    oracle_transform(&pose, v, out.v[i]);
  }
  oracle_triangle_normal(&out);
  return out;
}

static oracle_triangle point_of(const float *point) {
  oracle_triangle out;
  memset(&out, 0, sizeof out);
  for (int k = 0; k < 9; k++) out.v[k / 3][k % 3] = (double)point[k % 3];
  return out;
}

static const char *broken(const scene *s, const ask *k) {
  const nsvcd_answer *w = &k->answer;
  const nsvcd_question *o = &k->options;
  const int is_free = w->verdict == NSVCD_FREE;
  const int is_inside = w->inside;
  const int names = w->nearest.triangle_a != NSVCD_NO_TRIANGLE;
  const double normal[3] = {(double)w->nearest.normal[0], (double)w->nearest.normal[1],
                            (double)w->nearest.normal[2]};
  if (status_of(w) != STATUS_WITNESS && w->verdict != NSVCD_UNDECIDED && !is_free && !is_inside)
    return "status";
  if (!is_within(w->nearest.time, 0, 1) || !is_within(w->time.low, 0, 1)) return "time";
  if (!(w->distance.low >= 0) || !(w->distance.high >= w->distance.low)) return "distance";
  if (!is_within(logit_of(w), -100, 100)) return "logit";
  for (int i = 0; i < 3; i++) {
    if (!is_within(w->nearest.point[i], -1e6, 1e6) || !is_within(w->nearest.normal[i], -1.1, 1.1) ||
        !is_within(w->push_out[i], -10, 10))
      return "point, normal or lift";
  }
  if (is_free ? collides_of(w) || w->time.low < 1 : 0) return "FREE, but collides, or not until 1";
  if (status_of(w) == STATUS_WITNESS && (!names || !collides_of(w)))
    return "HIT without triangles, or that does not collide";
  if (is_inside && (w->nearest.time > 0 || !collides_of(w) || w->time.low > 0))
    return "inside at another time than 0";
  if (!is_free && !(first_of(o) > 0) && w->time.low > 0) return "time.low without FIRST";
  if (names && (w->nearest.triangle_a >= s->parts[0].of->shape.triangles ||
                w->nearest.triangle_b >= s->parts[1].of->shape.triangles))
    return "triangles";
  if (names != (w->nearest.triangle_b != NSVCD_NO_TRIANGLE) || (names && is_inside))
    return "one triangle, or inside with triangles";
  if (fabs(oracle_length(normal) - 1) > 1e-5 && (names || oracle_length(normal) > 0) &&
      oracle_length(normal) > 0)
    return "normal";
  if (status_of(w) == STATUS_WITNESS && w->time.low > w->nearest.time)
    return "time.low after nearest.time";
  if (is_free && (double)w->distance.low < (double)o->clearance * (1 - 1e-5))
    return "FREE, but distance.low is less than the clearance";
  if (w->verdict == NSVCD_UNDECIDED && o->clearance > 0 && w->opinion.asked)
    return "UNDECIDED with a clearance, but an opinion";
  if (w->contact_count != (status_of(w) == STATUS_WITNESS) ||
      (w->contact_count && memcmp(&w->contacts[0], &w->nearest, sizeof w->nearest) != 0))
    return "contacts";
  if (w->safe.time > w->time.low) return "safe place after time.low";
  if (!(first_of(o) > 0) && w->safe.time < w->time.low) return "safe place before time.low";
  // where both move, they may hardly move against each other
  const int one_rests = s->parts[0].count == 1 || s->parts[1].count == 1;
  const double epsilons = 12 * s->epsilon / fmax(s->speed, 1e-9);
  if (one_rests && (double)w->safe.time < fmax((double)w->time.low - epsilons - 1e-6, 0))
    return "safe place hairs before time.low";
  if (w->verdict == NSVCD_HIT && (w->time.high < w->nearest.time || w->time.high > w->nearest.time))
    return "time.high";
  if (w->verdict == NSVCD_UNDECIDED && !w->why) return "UNDECIDED, but not why";
  if (!(o->slop > 0) && (w->push_out[0] != 0 || w->push_out[1] != 0 || w->push_out[2] != 0))
    return "lift without skin";
  return NULL;
}

// The point is on one of them, or where they are nearest, and the normal points from b to a.
static void judge_place(const scene *s, const ask *k, const oracle_triangle *a,
                        const oracle_triangle *b, double moved) {
  const nsvcd_answer *w = &k->answer;
  const oracle_triangle point = point_of(w->nearest.point);
  double x[3], y[3], unused[3];
  const double apart = sqrt(oracle_triangles(a, b, DBL_MAX, x, y));
  double direction = 0;
  for (int i = 0; i < 3 && apart > 50 * s->epsilon; i++)
    direction += (double)w->nearest.normal[i] * (x[i] - y[i]) / apart;
  if (apart > 50 * s->epsilon + 50 * moved && direction < 0.99 - 8 * (s->epsilon + moved) / apart)
    find(s, BAD_PLACE, k, NULL, direction);
  const double off = fmax(oracle_triangles(a, &point, DBL_MAX, x, unused),
                          oracle_triangles(b, &point, DBL_MAX, x, unused));
  const double most = fmax(apart + s->epsilon, (double)w->distance.high);
  const double allowed = most + s->epsilon + moved + 1e-6 * oracle_length(point.v[0]);
  if (sqrt(off) > allowed && !(k->swapped && k->options.slop > 0))
    find(s, BAD_PLACE, k, NULL, sqrt(off) - allowed);
}

static void judge_triangles(const scene *s, const ask *k) {
  const nsvcd_answer *w = &k->answer;
  double x[3], y[3];
  if (w->nearest.triangle_a == NSVCD_NO_TRIANGLE || !k->world) return;
  const double t = (double)w->nearest.time;
  const double moved = 1e-7 * s->speed + 1e-7 * s->size;
  const oracle_triangle a = triangle_of(s, k->world, 0, w->nearest.triangle_a, t);
  const oracle_triangle b = triangle_of(s, k->world, 1, w->nearest.triangle_b, t);
  const double apart = sqrt(oracle_triangles(&a, &b, DBL_MAX, x, y));
  if (apart > (double)w->distance.high + moved) find(s, HIGH_TOO_LOW, k, NULL, apart);
  if (apart < (double)w->distance.high - 4 * s->epsilon - moved)
    find(s, PART_FARTHER, k, NULL, apart);  // it is about a part of a large triangle
  else
    judge_place(s, k, &a, &b, moved);
  if (status_of(w) != STATUS_WITNESS) return;
  if (apart > (double)k->options.clearance + s->epsilon + moved)
    find(s, WITNESS_APART, k, NULL, apart);
  if ((double)w->distance.high > ((double)k->options.clearance + s->epsilon) * (1 + 1e-5) + 1e-9)
    find(s, BAD_ANSWER, k, NULL, (double)w->distance.high);
}

static void judge_distances(const scene *s, const ask *k) {
  const nsvcd_answer *w = &k->answer;
  const double clearance = (double)k->options.clearance;
  const double epsilon = 1e-6 * clearance + 1e-10 * s->size;
  const int is_free = w->verdict == NSVCD_FREE;
  const int all = is_free || measure_of(&k->options) > 0;
  double until = DBL_MAX;
  double low = DBL_MAX;
  if (w->inside) return;
  for (size_t i = 0; i < k->world->count; i++) {
    const moment *m = &k->world->moments[i];
    if (m->t < (double)w->time.low) until = fmin(until, m->d);
    if (all || m->t < (double)w->time.low) low = fmin(low, m->d);
  }
  if (clearance > 0 ? until < clearance - epsilon : !(until > 0))
    find(s, is_free ? FREE_BUT_NEAR : UNTIL_BUT_NEAR, k, NULL, until);
  if (low < (double)w->distance.low - epsilon - 1e-6 * (double)w->distance.low)
    find(s, LOW_TOO_HIGH, k, NULL, low);
  if (is_free && k->world->inside && k->world->at_start > 1e-9 * s->size)
    find(s, FREE_BUT_INSIDE, k, NULL, 0);
}

static void judge_inside(const scene *s, const ask *k) {
  if (!k->answer.inside) return;
  const double start = k->world->at_start;
  double most = 0;
  for (int n = 0; n < 2; n++) {
    const oracle_pose pose = pose_in(s, k->world, n, 0);
    double m[9], d[3], at[3];
    for (int i = 0; i < 3; i++) d[i] = (double)k->answer.nearest.point[i] - pose.position[i];
    oracle_matrix(pose.rotation, m);
    oracle_rotate_back(m, d, at);
    most = fmax(most, fabs(oracle_winding(&s->parts[n].mesh, at)));
  }
  if (start > s->epsilon && most < 0.4 && !(k->swapped && k->options.slop > 0))
    find(s, INSIDE_POINT, k, NULL, most);
  if (start > 1e-9 * s->size && !k->world->inside) find(s, INSIDE_FALSE, k, NULL, start);
  // who asks for yes or no alone is told what is known first; a witness is sought for some units only
  const int tells = first_of(&k->options) > 0 || measure_of(&k->options) > 0 || k->options.slop > 0;
  if (!(start > 0) && tells && !k->ladder) find(s, INSIDE_MEETS, k, NULL, start);
}

// What it need not have left open, and what it is late for.
static void judge_effort(const scene *s, const ask *k) {
  const nsvcd_answer *w = &k->answer;
  const nsvcd_question *o = &k->options;
  const double allowed = (double)o->clearance + (double)o->tolerance + 4 * s->epsilon +
                         4e-6 * (s->size + 10 * s->scale);
  if (w->work > o->work + 10000) find(s, OVER_WORK, k, NULL, (double)w->work);
  if (w->verdict == NSVCD_UNDECIDED && w->work < o->work && k->world->least > allowed)
    find(s, GAVE_UP, k, NULL, k->world->least);
  if (w->verdict == NSVCD_UNDECIDED && !k->ladder && !(measure_of(o) > 0) && s->turn < 5 &&
      k->world->least > allowed + 1e-3 && (w->work < o->work || o->work >= NSVCD_DEFAULT_WORK))
    find(s, CLEAR_UNDECIDED, k, NULL, k->world->least);
  if (w->verdict == NSVCD_UNDECIDED && !(k->world->at_start > 0) && !k->ladder && !s->rests &&
      !(o->slop > 0))
    find(s, START_UNDECIDED, k, NULL, 0);
  if (status_of(w) == STATUS_WITNESS && first_of(o) > 0) {
    const double late = (double)(w->nearest.time - w->time.low);
    const double there = distance_at(s, k->world, (double)w->time.low);
    if (late > (double)first_of(o) * 1.0001 + 1e-6 && there > allowed && w->work < o->work)
      find(s, w->work < o->work / 8 ? LATE : LATE_IN_DOUBT, k, NULL, there);
  }
  const double wide = (double)(w->distance.high - w->distance.low) - s->epsilon;
  const double least = 2 * (s->epsilon + (double)o->tolerance);
  const double allowed_wide =
      fmax((double)measure_of(o), least) + 4e-6 * (s->size + k->world->least);
  if (measure_of(o) > 0 && !w->inside && w->work < o->work)
    widest = fmax(widest, wide / allowed_wide);
  if (measure_of(o) > 0 && !w->inside && w->work < o->work && wide > allowed_wide)
    find(s, WIDE, k, NULL, wide / allowed_wide);
}

static void judge_skin(const scene *s, const ask *k) {
  const nsvcd_answer *w = &k->answer;
  const double lift[3] = {(double)w->push_out[0], (double)w->push_out[1], (double)w->push_out[2]};
  const double clearance = (double)k->options.clearance;
  const double skin = (double)k->options.slop;
  const double start = k->world->at_start;
  if (!(skin > 0) || k->ladder) return;
  if (oracle_length(lift) > 4.001 * skin) find(s, SKIN_LONG, k, NULL, oracle_length(lift) / skin);
  if (s->deep && w->verdict == NSVCD_FREE) find(s, SKIN_DEEP, k, NULL, start);
  if (!s->rests || s->pressed + clearance > 0.9 * skin) return;
  if (!(oracle_length(lift) > 0)) {
    if (start <= clearance && w->verdict != NSVCD_FREE) find(s, SKIN_RESTS, k, NULL, start);
  } else if (start < clearance - 2 * s->epsilon || !(start > 0)) {
    find(s, SKIN_SHORT, k, NULL, start);
  }
}

// -------------------------------------------------------------------------------------------------
// two answers

// clang-format off
enum { BY_FIRST = 1, BY_MEASURE = 2, BY_CLEARANCE = 4, BY_SKIN = 8, BY_TOLERANCE = 16,
       BY_SEGMENTS = 32, BY_SWAPPING = 64, BY_WORK = 128 };
// clang-format on

static int differ(float x, float y, int by) {
  return x < y || y < x ? by : 0;
}
static int differences(const ask *i, const ask *j) {
  const nsvcd_question *x = &i->options;
  const nsvcd_question *y = &j->options;
  return differ(first_of(x), first_of(y), BY_FIRST) |
         differ(measure_of(x), measure_of(y), BY_MEASURE) |
         differ(x->clearance, y->clearance, BY_CLEARANCE) | differ(x->slop, y->slop, BY_SKIN) |
         differ(x->tolerance, y->tolerance, BY_TOLERANCE) |
         (x->segments != y->segments ? BY_SEGMENTS : 0) |
         (i->swapped != j->swapped ? BY_SWAPPING : 0) | (x->work != y->work ? BY_WORK : 0);
}

// What holds of any two, whatever else is asked, where the motion is the same.
static void judge_contradictions(const scene *s, const ask *i, const ask *j) {
  const nsvcd_answer *x = &i->answer;
  const nsvcd_answer *y = &j->answer;
  if (i->world != j->world) return;
  const int x_free = x->verdict == NSVCD_FREE;
  const int meets = status_of(y) == STATUS_WITNESS && j->options.clearance <= i->options.clearance;
  if (x_free && (meets || y->inside)) find(s, CONTRADICTION, i, j, 0);
  if (!x_free && meets && x->time.low > y->nearest.time) find(s, CONTRADICTION, i, j, 1);
  if (x->inside || y->nearest.triangle_a == NSVCD_NO_TRIANGLE) return;
  if ((x_free || measure_of(&i->options) > 0 || y->nearest.time < x->time.low) &&
      x->distance.low > y->distance.high)
    find(s, CONTRADICTION, i, j, 2);
  if (status_of(y) == STATUS_WITNESS && status_of(x) == STATUS_WITNESS &&
      !(j->options.slop > 0 && i->options.slop <= 0) && status_of(y) != status_of(x))
    find(s, CONTRADICTION, i, j, 3);
}

// i is decided, j not: which option has lost it?
static void judge_losses(const scene *s, const ask *i, const ask *j, int by) {
  const nsvcd_question *x = &i->options;
  const nsvcd_question *y = &j->options;
  const status was = status_of(&i->answer);
  const int is_free = was == STATUS_CERTIFIED_FREE;
  const double margin = (double)(y->clearance + y->tolerance) + 4 * s->epsilon + 4e-6 * s->size;
  kind lost = KINDS;
  // an eighth of the work is kept for that
  if (by == BY_FIRST && !(first_of(x) > 0) && 10 * i->answer.work < y->work) lost = LOST_BY_FIRST;
  if (by == BY_MEASURE && !(measure_of(x) > 0))
    lost = y->clearance > 0 ? LOST_BY_BOTH : LOST_BY_MEASURE;
  if (by == BY_SKIN && !(x->slop > 0) && i->world == j->world && 10 * i->answer.work < y->work)
    lost = LOST_BY_SKIN;
  if (by == BY_SEGMENTS && !x->segments && s->turn < 5) lost = LOST_BY_SEGMENTS;
  if (by == BY_CLEARANCE && !(first_of(x) > 0) && !(measure_of(x) > 0) && i->world == j->world &&
      (is_free ? y->clearance < x->clearance : y->clearance > x->clearance))
    lost = LOST_BY_CLEARANCE;
  if (by == BY_TOLERANCE && !(x->tolerance > 0)) lost = LOST_BY_TOLERANCE;
  if (lost == KINDS || (is_free && i->world->least < margin)) return;
  // what does not meet, or comes hardly nearer than the clearance, may be undecided
  if (was == STATUS_WITNESS && i->world->least > 0 &&
      i->world->least > (double)y->clearance - s->epsilon)
    return;
  find(s, lost, j, i, (double)i->answer.work / (double)x->work);
}

static void judge_pair(const scene *s, const ask *i, const ask *j) {
  const nsvcd_answer *x = &i->answer;
  const nsvcd_answer *y = &j->answer;
  const int by = differences(i, j);
  const int open = y->verdict == NSVCD_UNDECIDED;
  if (x->verdict != NSVCD_UNDECIDED && open) judge_losses(s, i, j, by);
  if (by == BY_FIRST && first_of(&j->options) < first_of(&i->options) &&
      first_of(&j->options) > 0) {
    const float to = first_of(&j->options) + 1e-6f;
    if (y->time.low < x->time.low - to && !(i->options.tolerance > 0) &&
        y->work < j->options.work / 2)
      find(s, FINER_LATER, j, i, (double)(x->time.low - y->time.low));
    if (status_of(y) == STATUS_WITNESS && status_of(x) == STATUS_WITNESS &&
        y->nearest.time > x->nearest.time + to && !(i->options.tolerance > 0) &&
        y->work < j->options.work / 2)
      find(s, FINER_EARLIER, j, i, (double)(y->nearest.time - x->nearest.time));
  }
  if (by == BY_MEASURE && measure_of(&j->options) < measure_of(&i->options) &&
      measure_of(&j->options) > 0 &&
      (double)(x->distance.low - y->distance.low) >
          (double)(measure_of(&j->options) + 2 * j->options.tolerance) + 2 * s->epsilon +
              4e-6 * (s->size + i->world->least))
    find(s, COARSER_LOW, j, i, (double)(x->distance.low - y->distance.low));
  if (by == BY_SWAPPING && i < j) {
    int same = status_of(x) == status_of(y) && x->work == y->work &&
               x->nearest.triangle_a == y->nearest.triangle_a &&
               x->nearest.triangle_b == y->nearest.triangle_b &&
               !differ(x->nearest.time, y->nearest.time, 1) &&
               !differ(x->time.low, y->time.low, 1) &&
               !differ(x->distance.low, y->distance.low, 1) &&
               !differ(x->distance.high, y->distance.high, 1);
    for (int k = 0; k < 3; k++)
      same = same && !differ(x->nearest.normal[k], y->nearest.normal[k], 1) &&
             !differ(x->push_out[k], y->push_out[k], 1);
    if (!same) find(s, SWAP_DIFFERS, i, j, 0);
  }
  if (by && !(by & (BY_CLEARANCE | BY_SKIN | BY_SWAPPING)) && i < j && i->world != j->world)
    find(s, SKIN_DIFFERS, i, j, 0);
}

// Two steps of a ladder: j had twice the work.
static void judge_step(const scene *s, const ask *i, const ask *j) {
  const nsvcd_answer *x = &i->answer;
  const nsvcd_answer *y = &j->answer;
  const int measures = measure_of(&i->options) > 0;
  // a contact found by chance, with hardly any work
  const int by_chance = first_of(&i->options) > 0 && i->options.work < 500;
  if (x->verdict != NSVCD_UNDECIDED && y->verdict == NSVCD_UNDECIDED && !by_chance)
    find(s, LADDER_LOST, j, i, 0);
  if (i->world != j->world) return;
  if (y->time.low < x->time.low - first_of(&i->options) - 1e-6f)
    find(s, LADDER_UNTIL, j, i, (double)(x->time.low - y->time.low));
  if (first_of(&i->options) > 0 && status_of(x) == STATUS_WITNESS &&
      status_of(y) == STATUS_WITNESS && y->nearest.time > x->nearest.time + 1e-6f)
    find(s, LADDER_LATER, j, i, (double)(y->nearest.time - x->nearest.time));
  if (measures && y->distance.low < x->distance.low * 0.999f - 1e-9f)
    find(s, LADDER_LOW, j, i, (double)(x->distance.low - y->distance.low));
  const int named = x->nearest.triangle_a != NSVCD_NO_TRIANGLE;
  if (measures && named && y->distance.high > x->distance.high * 1.001f + (float)s->epsilon)
    find(s, LADDER_HIGH, j, i, (double)(y->distance.high - x->distance.high));
}

// -------------------------------------------------------------------------------------------------

// Where other answers see something, this one is held against it too.
static void gather_moments(const scene *s) {
  for (size_t i = 0; i < ask_count; i++) {
    const ask *k = &asks[i];
    const double until = (double)k->answer.time.low;
    if (!k->world) continue;
    if (k->answer.nearest.triangle_a != NSVCD_NO_TRIANGLE)
      distance_at(s, k->world, (double)k->answer.nearest.time);
    if (until > 0 && until < 1) {
      distance_at(s, k->world, until * (1 - 1e-6));
      distance_at(s, k->world, until * 0.995);
    }
  }
}

// Once for each option that has lost one: does it come back?
static void ask_again(const scene *s) {
  const size_t count = ask_count;
  int left = 2;
  for (size_t j = 5; j < count && asks[j].ladder == 0 && left > 0; j++) {
    nsvcd_question plain = asks[j].options;
    plain.ask = NSVCD_ASK_HIT;
    plain.to = plain.to_time = 0;
    for (size_t i = 0; i < j && asks[j].answer.verdict == NSVCD_UNDECIDED; i++) {
      if (asks[i].swapped != asks[j].swapped ||
          memcmp(&plain, &asks[i].options, sizeof plain) != 0 ||
          asks[i].answer.verdict == NSVCD_UNDECIDED)
        continue;
      nsvcd_question more = asks[j].options;
      more.work = 16 * s->work;
      const ask *again = put(s, &more, asks[j].swapped, -1);
      if (again->answer.verdict == NSVCD_UNDECIDED) find(s, LOST_FOR_GOOD, again, &asks[i], 0);
      left--;
      break;
    }
  }
}

static void judge_scene(const scene *s) {
  gather_moments(s);
  for (size_t i = 0; i < ask_count; i++) {
    const ask *k = &asks[i];
    const char *fault = broken(s, k);
    if (fault && telling) printf("  ! %s\n", fault);
    if (fault) find(s, BAD_ANSWER, k, NULL, 0);
    if (!k->world || fault) continue;
    judge_triangles(s, k);
    judge_distances(s, k);
    judge_inside(s, k);
    judge_effort(s, k);
    judge_skin(s, k);
    for (size_t j = 0; j < ask_count; j++) {
      if (!asks[j].world || i == j) continue;
      judge_contradictions(s, k, &asks[j]);
      if (!k->ladder && !asks[j].ladder) judge_pair(s, k, &asks[j]);
    }
    if (i + 1 < ask_count && k->ladder > 0 && asks[i + 1].ladder == k->ladder && asks[i + 1].world)
      judge_step(s, k, &asks[i + 1]);
  }
}

static void run_scene(uint64_t seed) {
  static scene s;
  draw_scene(&s, seed);
  world_count = 0;
  if (telling)
    printf("%llu %s: scale %g, %zu and %zu poses, %zu and %zu triangles, skin %g, pressed %g\n",
           (unsigned long long)seed, s.name, s.scale, s.parts[0].count, s.parts[1].count,
           s.parts[0].mesh.triangle_count, s.parts[1].mesh.triangle_count, s.skin, s.pressed);
  put_all(&s);
  ask_again(&s);
  judge_scene(&s);
  for (int k = 0; k < 2; k++) oracle_mesh_free(&s.parts[k].mesh);
}

static int report(void) {
  int unsound = 0;
  for (int k = 0; k < KINDS; k++) {
    if (findings[k].count)
      printf("%s: %zu in %zu scenes\n", findings[k].what, findings[k].count, findings[k].scenes);
    for (size_t n = 0; n < EXAMPLES && n < findings[k].scenes; n++)
      printf("    %s\n", findings[k].examples[n]);
    if (k < FAILURES) unsound |= findings[k].count > 0;
  }
  printf("\n%8s %8s\n", "answers", "scenes");
  for (int k = 0; k < KINDS; k++)
    printf("%8zu %8zu  %s%s\n", findings[k].count, findings[k].scenes,
           k < FAILURES ? "must be 0: " : "", findings[k].what);
  printf(
      "%zu questions: free %zu, witness %zu, inside %zu, undecided %zu; brackets up to %.3f of "
      "what "
      "is allowed\n",
      questions, verdicts[STATUS_CERTIFIED_FREE], verdicts[STATUS_WITNESS], verdicts[STATUS_INSIDE],
      verdicts[STATUS_UNDECIDED], widest);
  return unsound;
}

int main(int argc, char **argv) {
  const long count = argc > 1 ? atol(argv[1]) : 40;
  const long seed = argc > 2 ? atol(argv[2]) : 1;
  if (count < 1 || seed < 0 || argc - 3 > MOST_FILES)
    return complain("[COUNT [SEED [NAME.obj...]]]"), USAGE;
  file_count = argc > 3 ? argc - 3 : 0;
  file_names = argv + 3;
  telling = count == 1;
  workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  for (long n = 0; n < count; n++) run_scene((uint64_t)(seed + n));
  const int unsound = report();
  for (int n = 0; n < FILES + MOST_FILES; n++) {
    nsvcd_body_free(solids[n].body, NULL);
    shapes_free(&solids[n].shape);
  }
  free(workspace);
  return unsound;
}
