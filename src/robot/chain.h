// In: a scene, and joint values. Out: a checker, and where links and parts are, in double. The
// floor, top to bottom:
//
//   chain       what moves what; where everything is
//   steps       what the joints do between two times
//   deviate       how far points of a part can be from an axis; by how much a part leaves its sweep
//   path        is a motion of the joints free?
//   proofs      a certificate of a pair, as the joints move it
//   trees       configurations, and the nearest of them
//   configurations    one configuration: what is near, a way out; which pairs can meet
//   blends       from one state to another, within limits of speed and acceleration
//   smooth      a way in time, then smooth
//   route       a start and goals: two trees of proven edges, shortcuts
//
// It asks as any program does, by nsvcd_sweep.
#pragma once
#include "../ground/memory.h"
#include "../ground/rotations.h"
#include "../ground/valid.h"
#include "../interface/robots.h"

// The schedule of a check.
// steps that are looked at together, at most, and how often a motion is halved where that is too
// few
#define NSVCD__MOST_STEPS 256
#define NSVCD__STRETCHES 24
// steps of what bends, at first
#define NSVCD__FIRST_STEPS 4
// radians or metres: where the way bends by less, steps go on across
#define NSVCD__CORNER 1e-3
// metres that a part may deviate at first; each time a pair is asked again it may by this share of
// it
#define NSVCD__COARSE 2e-3
#define NSVCD__DEVIATION_FRACTION 8
#define NSVCD__FINEST 1e-5f
// units that a look for a hit may take, before the last
#define NSVCD__PAIR_TRY 200
// what frames in double are off, as a share of the lengths that they are computed from
#define NSVCD__FRAME_ROUNDING 1e-13

// A joint, as the checker has it; and the link that it carries.
typedef struct nsvcd__link {
  // in the parent link: where the joint is, and how it is turned, unit
  nsvcd__d3 position;
  nsvcd__dquat turn;
  // unit, in the joint's frame
  nsvcd__d3 axis;
  // joints between the world and this link, itself included: bit i is joint i
  uint32_t path;
} nsvcd__link;

// Where a link is, in the world.
typedef struct nsvcd__frame {
  nsvcd__dquat turn;
  nsvcd__d3 position;
} nsvcd__frame;

// Joint values, and what follows from them.
typedef struct nsvcd__configuration {
  double joints[NSVCD_MAX_JOINTS];
  // of the links, the world first
  nsvcd__frame frames[NSVCD_MAX_JOINTS + 1];
  // of the joints, in the world: unit
  nsvcd__d3 axes[NSVCD_MAX_JOINTS];
} nsvcd__configuration;

// Sides along the world's axes.
typedef struct nsvcd__bounds {
  nsvcd__d3 low, high;
} nsvcd__bounds;

// A part, as the checker has it.
typedef struct nsvcd__member {
  // in its link
  nsvcd__frame frame;
  // of a sphere about its triangles, in its link; from its origin
  nsvcd__d3 centre;
  double radius, extent;
  // of a box about all of it, in its own axes, scaled; and half of its sides
  nsvcd__d3 middle, half;
  // about all samples, or where it rests
  nsvcd__bounds box;
  // of a part that moves: where its samples begin
  size_t row;
  // metres, at most: by how much it leaves the way between its samples, and what frames in double
  // are off
  double deviation, rounding;
} nsvcd__member;

struct nsvcd_checker {
  const nsvcd_scene *scene;
  nsvcd__link links[NSVCD_MAX_JOINTS];
  nsvcd__member *members;  // (B)
  // (P): the pairs, as they are asked: what was hit last first
  uint32_t *order;
  // (P): those of a interval that are not proven yet
  uint32_t *left;
  // (movers, NSVCD__MOST_STEPS + 1): samples, in the world, and boxes about the parts there
  nsvcd__frame *frames;
  nsvcd__bounds *boxes;
  // (NSVCD__MOST_STEPS + 1): of both parts of a pair, as it is asked about; see nsvcd__sight
  nsvcd_pose *seen[2];
  // the times of the samples, and the most that a part deviates in the step after each
  double times[NSVCD__MOST_STEPS + 1], deviations[NSVCD__MOST_STEPS + 1];
  nsvcd__configuration at, next;
  void *query;
  size_t query_size;
};

static nsvcd__dquat nsvcd__dquat_mul(nsvcd__dquat a, nsvcd__dquat b) {
  const nsvcd__dquat back = {-a.x, -a.y, -a.z, a.w};
  return nsvcd__dquat_inverse_mul(back, b);
}

static nsvcd__d3 nsvcd__dquat_rotate(nsvcd__dquat q, nsvcd__d3 a) {
  const nsvcd__d3 axis = nsvcd__dquat_axis(q);
  const nsvcd__d3 twice = nsvcd__d3_scale(nsvcd__d3_cross(axis, a), 2);
  return nsvcd__d3_add(nsvcd__d3_fma(q.w, twice, a), nsvcd__d3_cross(axis, twice));
}

static nsvcd__frame nsvcd__frame_of(const nsvcd_pose *pose) {
  const float *q = pose->rotation;
  const nsvcd__dquat turn = {(double)q[0], (double)q[1], (double)q[2], (double)q[3]};
  const nsvcd__frame out = {nsvcd__dquat_unit(turn), nsvcd__d3_load(pose->position)};
  return out;
}

// What is `inner` in a frame, in the world.
static nsvcd__frame nsvcd__frame_in(const nsvcd__frame *frame, const nsvcd__frame *inner) {
  const nsvcd__d3 position = nsvcd__dquat_rotate(frame->turn, inner->position);
  const nsvcd__frame out = {nsvcd__dquat_mul(frame->turn, inner->turn),
                            nsvcd__d3_add(frame->position, position)};
  return out;
}

// What is `frame` in the world, as seen from another one.
static nsvcd__frame nsvcd__frame_from(const nsvcd__frame *from, const nsvcd__frame *frame) {
  const nsvcd__dquat back = {-from->turn.x, -from->turn.y, -from->turn.z, from->turn.w};
  const nsvcd__d3 offset = nsvcd__d3_sub(frame->position, from->position);
  const nsvcd__frame out = {nsvcd__dquat_inverse_mul(from->turn, frame->turn),
                            nsvcd__dquat_rotate(back, offset)};
  return out;
}

static nsvcd_pose nsvcd__pose_in(const nsvcd__frame *frame) {
  const nsvcd__dquat turn = nsvcd__dquat_unit(frame->turn);
  nsvcd_pose out;
  nsvcd__f3_store(nsvcd__f3_round(frame->position), out.position);
  out.rotation[0] = (float)turn.x;
  out.rotation[1] = (float)turn.y;
  out.rotation[2] = (float)turn.z;
  out.rotation[3] = (float)turn.w;
  return out;
}

static int nsvcd__slides(const nsvcd_checker *c, size_t joint) {
  return c->scene->joints[joint].kind == NSVCD_JOINT_PRISMATIC;
}

// Places the links where c->joints says.
static void nsvcd__pose_links(const nsvcd_checker *checker, nsvcd__configuration *c) {
  const nsvcd__frame world = {{0, 0, 0, 1}, {0, 0, 0}};
  c->frames[0] = world;
  for (size_t i = 0; i < checker->scene->joint_count; i++) {
    const nsvcd__link *link = &checker->links[i];
    const nsvcd__frame origin = {link->turn, link->position};
    nsvcd__frame frame =
        nsvcd__frame_in(&c->frames[checker->scene->joints[i].parent], &origin);
    c->axes[i] = nsvcd__dquat_rotate(frame.turn, link->axis);
    if (nsvcd__slides(checker, i)) {
      frame.position = nsvcd__d3_fma(c->joints[i], c->axes[i], frame.position);
    } else {
      const double half = 0.5 * c->joints[i];
      const nsvcd__d3 axis = nsvcd__d3_scale(link->axis, sin(half));
      const nsvcd__dquat turn = {axis.x, axis.y, axis.z, cos(half)};
      frame.turn = nsvcd__dquat_mul(frame.turn, turn);
    }
    c->frames[i + 1] = frame;
  }
}

static nsvcd__frame nsvcd__frame_of_part(const nsvcd_checker *checker,
                                         const nsvcd__configuration *c, size_t part) {
  return nsvcd__frame_in(&c->frames[checker->scene->parts[part].link],
                         &checker->members[part].frame);
}

NSVCDDEF void nsvcd_forward_kinematics(const nsvcd_checker *checker, const double *joints,
                                       nsvcd_pose *poses) {
  nsvcd__configuration c;
  memcpy(c.joints, joints, checker->scene->joint_count * sizeof *joints);
  nsvcd__pose_links(checker, &c);
  for (size_t n = 0; n < checker->scene->part_count; n++) {
    const nsvcd__frame frame = nsvcd__frame_of_part(checker, &c, n);
    poses[n] = nsvcd__pose_in(&frame);
  }
}
