// In: a scene, and joint values. Out: a checker, and where links and parts are, in double. The
// floor, top to bottom:
//
//   chain            links, joints and frames: forward kinematics
//   mimics           joints that others drive
//   steps            what the joints do between two times
//   deviation        how far points of a part can be from an axis; how far a part leaves its sweep
//   checker          the checker of a scene
//   cones            does an axis stay within its cone? a configuration near by in which it does
//   samples          configurations of a motion, and boxes about the parts in them
//   local_queries    two parts, in the frame of one of them
//   check            is a motion of the joints free?
//   merge            motions on clocks of their own, as one
//   looks            does a motion seem free?
//   proofs           a certificate of a pair, as the joints move it
//   rrt              trees of configurations, and the nearest node
//   configurations   one configuration: proximities, the nearest free one; which pairs can meet
//   cholesky         linear equations
//   reach            configurations that have a tool at a target
//   spans            two parts, and how far the joints between them move a point
//   meetings         configurations in which two parts meet, and in which they do not
//   partings         does a plane part two parts in all of a box of values?
//   ranges           do two parts meet never, always or sometimes?
//   blends           from one state to another, within limits of speed and acceleration
//   smooth           a path, timed, then smooth
//   grow             where a tree grows, and edge by edge, in the cones
//   trees            two trees, from the start and the goals, until they meet
//   route            a start and goals: a path, shortened, as a motion that is proven
//
// All questions about bodies are asked by nsvcd_sweep, as any program asks them.
#pragma once
#include "../ground/memory.h"
#include "../ground/motions.h"
#include "../ground/valid.h"
#include "../interface/robots.h"

// steps of a check that are asked about together, at most
#define NSVCD__MOST_STEPS 256

// A joint, as the checker has it, and the link that it carries.
typedef struct nsvcd__link {
  // of the joint, in its parent link
  nsvcd__dpose origin;
  // unit, in the joint's frame
  nsvcd__d3 axis;
} nsvcd__link;

// Where the links are in a configuration, in the world.
typedef struct nsvcd__links {
  // of the links, the world first
  nsvcd__dpose frames[NSVCD_MAX_JOINTS + 1];
  // of the joints: unit
  nsvcd__d3 axes[NSVCD_MAX_JOINTS];
} nsvcd__links;

// A box along the world's axes, in double.
typedef struct nsvcd__bounds {
  nsvcd__d3 low, high;
} nsvcd__bounds;

// A part, as the checker has it.
typedef struct nsvcd__member {
  // in its link
  nsvcd__dpose frame;
  // a sphere about its triangles, in its link; and no point is farther from its origin
  nsvcd__d3 centre;
  double radius, extent;
  // metres: what it goes beyond its triangles; the error of its balls, and how many it has
  double round, ball_error;
  size_t balls;
  // a box about all of it, in its own axes, scaled
  nsvcd__d3 middle, half;
  // of all samples, or where it rests
  nsvcd__bounds bounds;
  // its first sample, if it moves
  size_t row;
  // metres, at most: how far it leaves the sweep between its samples; errors of frames in double
  double deviation, rounding;
  // moves, but is in none of the pairs that are asked about: not placed
  int is_skipped;
} nsvcd__member;

// A cone, as the checker has it.
typedef struct nsvcd__kept_axis {
  uint32_t link;
  // unit, in the link and in the world
  nsvcd__d3 axis, direction;
  double angle;
} nsvcd__kept_axis;

struct nsvcd_checker {
  // the caller's; or, where joints mimic others, that with joints of its own
  const nsvcd_scene *scene;
  nsvcd_scene own;
  // (F)
  nsvcd_joint *joints;
  nsvcd__link *links;
  // where the links are: in a configuration, or at both ends of a step
  nsvcd__links *at, *next;
  // (B)
  nsvcd__member *members;
  // the parts that move
  uint32_t *movers;
  size_t mover_count;
  // (C)
  nsvcd__kept_axis *cones;
  // (P): the pairs, as they are asked about: what was hit last first
  uint32_t *order;
  // (P): those of an interval that are not proven yet
  uint32_t *left;
  // (moving parts, NSVCD__MOST_STEPS + 1): samples, in the world; metres that a part deviates in
  // the step after each, at most
  nsvcd__dpose *frames;
  nsvcd__bounds *bounds;
  double *deviations;
  // (NSVCD__MOST_STEPS + 1): of both parts of a pair, see local_queries
  nsvcd_pose *local[2];
  // of the samples; and the most, in the step after each, that parts deviate which are near there
  double times[NSVCD__MOST_STEPS + 1], coarse[NSVCD__MOST_STEPS + 1];
  // (W, 2): when a motion leaves what is allowed at its start, and enters what is at its end
  double *cuts;
  void *query;
  size_t query_size;
  // questions are about surfaces alone
  int surfaces;
  // ends questions; NULL: nothing does
  int (*stop)(void *user);
  void *user;
  // an error of a question, which ends those that follow
  nsvcd_result result;
  // units that questions took so far
  uint64_t units;
};

static nsvcd__d3 nsvcd__dquat_rotate(nsvcd__dquat q, nsvcd__d3 a) {
  const nsvcd__d3 axis = nsvcd__dquat_axis(q);
  const nsvcd__d3 twice = nsvcd__d3_scale(nsvcd__d3_cross(axis, a), 2);
  return nsvcd__d3_add(nsvcd__d3_fma(q.w, twice, a), nsvcd__d3_cross(axis, twice));
}

static nsvcd__d3 nsvcd__dpose_apply(const nsvcd__dpose *frame, nsvcd__d3 a) {
  return nsvcd__d3_add(nsvcd__dquat_rotate(frame->rotation, a), frame->position);
}

static nsvcd__dpose nsvcd__dpose_mul(const nsvcd__dpose *a, const nsvcd__dpose *b) {
  const nsvcd__d3 position = nsvcd__dquat_rotate(a->rotation, b->position);
  const nsvcd__dpose out = {nsvcd__dquat_mul(a->rotation, b->rotation),
                            nsvcd__d3_add(a->position, position)};
  return out;
}

// b, as seen from a.
static nsvcd__dpose nsvcd__dpose_inverse_mul(const nsvcd__dpose *a, const nsvcd__dpose *b) {
  const nsvcd__dquat back = nsvcd__dquat_inverse(a->rotation);
  const nsvcd__d3 offset = nsvcd__d3_sub(b->position, a->position);
  const nsvcd__dpose out = {nsvcd__dquat_mul(back, b->rotation),
                            nsvcd__dquat_rotate(back, offset)};
  return out;
}

// The link before another one on the way to the world.
static size_t nsvcd__link_before(const nsvcd_checker *c, size_t link) {
  return c->scene->joints[link - 1].parent;
}

static int nsvcd__slides(const nsvcd_checker *c, size_t joint) {
  return c->scene->joints[joint].kind == NSVCD_JOINT_PRISMATIC;
}

// What a joint carries, in the joint's parent link.
static nsvcd__dpose nsvcd__joint_frame(const nsvcd_checker *c, size_t joint, double value) {
  const nsvcd__link *link = &c->links[joint];
  const int slides = nsvcd__slides(c, joint);
  const nsvcd__d3 axis = nsvcd__d3_scale(link->axis, slides ? value : sin(0.5 * value));
  const nsvcd__dpose slid = {{0, 0, 0, 1}, axis};
  const nsvcd__dpose turned = {{axis.x, axis.y, axis.z, cos(0.5 * value)}, {0, 0, 0}};
  return nsvcd__dpose_mul(&link->origin, slides ? &slid : &turned);
}

// Forward kinematics.
static void nsvcd__place_links(const nsvcd_checker *c, const double *joints,
                               nsvcd__links *out) {
  const nsvcd__dpose world = {{0, 0, 0, 1}, {0, 0, 0}};
  out->frames[0] = world;
  for (size_t i = 0; i < c->scene->joint_count; i++) {
    const nsvcd__dpose link = nsvcd__joint_frame(c, i, joints[i]);
    out->frames[i + 1] = nsvcd__dpose_mul(&out->frames[c->scene->joints[i].parent], &link);
    out->axes[i] = nsvcd__dquat_rotate(out->frames[i + 1].rotation, c->links[i].axis);
  }
}

static nsvcd__dpose nsvcd__frame_of_part(const nsvcd_checker *c, const nsvcd__links *at,
                                         size_t part) {
  const uint32_t link = c->scene->parts[part].link;
  return nsvcd__dpose_mul(&at->frames[link], &c->members[part].frame);
}

NSVCDDEF void nsvcd_forward_kinematics(const nsvcd_checker *checker, const double *joints,
                                       nsvcd_pose *poses) {
  nsvcd__links at;
  nsvcd__place_links(checker, joints, &at);
  for (size_t n = 0; n < checker->scene->part_count; n++) {
    const nsvcd__dpose frame = nsvcd__frame_of_part(checker, &at, n);
    poses[n] = nsvcd__dpose_round(&frame);
  }
}
