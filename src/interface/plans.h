// In: a planning problem, or control points. Out: control points, or the joints at a time.
//
// A trajectory of F joints is a spline through control points: the start, M via points and the
// goal, at uniform times t in [0,1]. They are an array `control` (M + 2, F). Between two of them
// the spline has degree five. At a via point its velocity and acceleration are central differences
// of the control points; at both ends it rests. So both are continuous everywhere.
#pragma once
#include "queries.h"

#ifndef NSVCD_NO_OPTIMIZER
#define NSVCD_MAX_VIA_POINTS 32
// the most segments of a stage of the planner
#define NSVCD_MAX_PLAN_SEGMENTS 4096

// Evaluates a spline: tells where the joints are at a time, or their derivatives by t.
//   control    (via_points + 2, joints) radians or metres, not NULL
//   via_points M, up to NSVCD_MAX_VIA_POINTS; if more, nothing is written
//   joints     F, the number of joints
//   t          time, clamped to [0,1]
//   derivative 0: the joints; 1, 2, 3: velocity, acceleration, jerk; if more, nothing is written
//   out        (joints), not NULL
//   allocates  nothing
//   source     quintic Hermite interpolation, as the paper's authors use it
NSVCDDEF void nsvcd_spline(const float *control, size_t via_points, size_t joints, float t,
                           size_t derivative, float *out);

typedef enum nsvcd_plan_status {
  // the trajectory is within the limits and free of collision. That is proven where bodies have
  // triangles; otherwise it is so as far as the network knows. It is about the motion of the last
  // check, from which the trajectory deviates by answer.deviation
  NSVCD_PLAN_CONVERGED = 0,
  // the iterations ended before a free trajectory was found; this is the best
  NSVCD_PLAN_LIMIT,
  // the progress callback ended the search; this is the best trajectory so far
  NSVCD_PLAN_CANCELLED,
  // the start is out of the limits or in collision; `control` is the smoothest path to the goal
  NSVCD_PLAN_START,
  // the goal is out of the limits or in collision; `control` is the smoothest path to it
  NSVCD_PLAN_GOAL
} nsvcd_plan_status;

// The status in a word or two, for people; never NULL.
NSVCDDEF const char *nsvcd_plan_status_string(nsvcd_plan_status status);

// How far a plan has come.
typedef struct nsvcd_plan_progress {
  // the number of the initial trajectory, and of the stage's iteration with it, from 0
  size_t seed, iteration;
  // how many iterations this stage has. L-BFGS starts again if the proof finds a hit
  size_t iterations;
  // 0: MPPI, 1: L-BFGS
  int refining;
  // cost of the best trajectory of this stage. Stages evaluate different poses, so their costs do
  // not compare
  float cost;
  // the part of the cost due to collision; 0: free, as far as the stage's segments show
  float collision;
  // (via_points + 2, F) the best trajectory, valid during the call
  const float *control;
  // M
  size_t via_points;
} nsvcd_plan_progress;

// A scene: how bodies move, and which pairs can meet. No other pairs are checked. All callbacks get
// the same `user`, and must depend on nothing but that and their arguments. Joints are in radians
// or metres.
typedef struct nsvcd_plan_problem {
  // F, 1..NSVCD_MAX_JOINTS
  size_t joints;
  // (F) limits of the joints
  const float *low, *high;
  // (F) joints
  const float *start, *goal;
  // (B) bodies, with latents; those in no pair may be NULL
  const nsvcd_body *const *bodies;
  // B, up to 65536
  size_t body_count;
  // (P) pairs of indices of bodies. The planner asks about a's motion as seen from b. Let b be the
  // body that rests, or else the larger: the other way round is a little less accurate
  const nsvcd_body_pair *pairs;
  // P
  size_t pair_count;
  // computes the poses (B) of the bodies in the world, for joints (F). To grasp a thing, let this
  // move it with the hand; nothing is encoded again
  void (*kinematics)(void *user, const float *joints, nsvcd_pose *poses);
  // computes the jacobian (B, 6, F) for joints (F): for each body and joint, the displacement of
  // the body's origin and its rotation vector, in world axes. NULL: by differences of `kinematics`
  void (*jacobian)(void *user, const float *joints, float *jacobian);
  // returns the cost of collision of poses (times, B) along the trajectory; NULL: the network's. It
  // may return as soon as the sum exceeds `limit`. It sets *collides if there is a collision.
  // Unless `gradient` is NULL, it adds the cost's derivative to it, (times, B, 6), as
  // nsvcd_sweep_gradient has it
  float (*collision)(void *user, const nsvcd_pose *poses, size_t times, float limit,
                     int *collides, float *gradient);
  // called once per iteration; may be NULL. If it returns anything but 0, the plan is cancelled
  int (*progress)(void *user, const nsvcd_plan_progress *progress);
  // passed to all of these
  void *user;
} nsvcd_plan_problem;

// One of the planner's two stages. Zero means its default, which nsvcd_plan_options tells.
typedef struct nsvcd_plan_stage {
  // M, up to NSVCD_MAX_VIA_POINTS
  size_t via_points;
  // number of segments of the trajectory, up to NSVCD_MAX_PLAN_SEGMENTS. Each is swept as one
  // motion; with `discrete`, its ends are checked
  size_t segments;
  // the most iterations, up to 100000; NSVCD_NONE: the stage is skipped
  size_t iterations;
  // number of random trajectories in an iteration of MPPI, or of gradients in a bundle of L-BFGS;
  // up to 10000
  size_t draws;
  // radians or metres: their standard deviation around the trajectory. That is at mid-motion in the
  // first iteration of MPPI, and at all via points for L-BFGS's bundle. Negative: 0
  float noise;
} nsvcd_plan_stage;

// How a plan is made. Zero means the default; negative weights count as zero. If an exact check
// finds contacts, raise sweep.network.recall, `collision` or the bodies' number of patches. If the
// status is LIMIT, raise `seeds` or explore.draws. Smoothness counts radians and metres alike: for
// paths of hundreds of metres, raise `duration` or `collision`.
typedef struct nsvcd_plan_options {
  // seed of all random numbers
  uint64_t seed;
  // the most initial trajectories, which are tried until one ends free, up to 1000; default 6
  size_t seeds;
  // MPPI; default 5 via points, 24 segments, 40 iterations, 100 draws, noise 0.3
  nsvcd_plan_stage explore;
  // L-BFGS; default 10 via points, 22 segments, 10 iterations, 10 draws, noise 0.01
  nsvcd_plan_stage refine;
  // weights of their mean squares over the motion; default 10, 2, 10
  float velocity, acceleration, jerk;
  // weight of the sum of logits over pairs and segments; default 20 (the paper's is 1)
  float collision;
  // seconds from start to goal, which only weight the terms above; default 20
  float duration;
  // logits above minus this have a cost; default 2
  float margin;
  // 1: poses are checked instead of sweeps
  int discrete;
  // segments of the last check, up to 4 NSVCD_MAX_PLAN_SEGMENTS; default 16 times those of the
  // finest stage, or that limit. Joint limits are checked between segments and at via points. Twice
  // as many segments make answer.deviation a quarter
  size_t check;
  // how questions are asked; sweep.network.recall = 0.999f keeps more distance. The search asks the
  // network. `method`, `clearance`, `slop` and the like apply to the start, the goal and the last
  // check. Not read: a, b, ask, to and to_time
  nsvcd_question sweep;
} nsvcd_plan_options;

// What was found.
typedef struct nsvcd_plan_answer {
  nsvcd_plan_status status;
  // 1: the trajectory collides, by the last check; or the start or the goal does, if the status
  // names it
  int collides;
  // a joint that leaves its limits; NSVCD_NONE: none does
  size_t joint;
  // the pair with the largest logit; NSVCD_NONE: there is none
  size_t pair;
  // the largest logit of the last check; with a custom cost of collision, that cost
  float logit;
  // time of that logit, in [0,1]
  float time;
  // metres: how far the spline deviates from the motion of the last check, through whose poses it
  // goes. It is the largest deviation of any point of a's bounding sphere, as b sees it, over all
  // pairs whose body a is given, also with a custom cost of collision. It is measured, not proven:
  // half way between two poses, where a smooth curve deviates most, at 16 or more times in each
  // piece of the spline. 0: no trajectory was sought
  float deviation;
  // cost of the trajectory, and the part of it that is due to neither collision nor limits; 0: no
  // trajectory was sought
  float cost, smoothness;
  // M of `control`
  size_t via_points;
  // number of initial trajectories that were used, and of iterations of both stages
  size_t seeds, iterations;
  // number of trajectories whose cost was computed
  size_t trajectories;
  // number of queries asked
  size_t sweeps;
} nsvcd_plan_answer;

// Bytes of workspace that nsvcd_plan needs; 0 if problem or options are refused, or if it would be
// more than SIZE_MAX.
//   problem    not NULL
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_plan_workspace_size(const nsvcd_plan_problem *problem,
                                          const nsvcd_plan_options *options);

// Finds a smooth trajectory from start to goal on which no pair meets. The same problem gives the
// same trajectory, in one build: see DETERMINISM above.
//   problem    not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_plan_workspace_size(problem, options) or more, not
//              NULL, aligned to NSVCD_ALIGNMENT
//   control    (M + 2, F) radians or metres, not NULL; M is that of options.refine, or of explore
//              if refine is skipped. NSVCD_MAX_VIA_POINTS + 2 rows are always enough. It is written
//              whatever the status, but not on failure
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a workspace of its own; bodies may be shared
//   errors     ARGUMENT (NULL), COUNT, PAIR, BODY, VERSION, STAGE, PLAN (of the options), LIMITS
//              (low above high), VALUE (limits, start or goal not finite or beyond
//              NSVCD_MAX_COORDINATE), NUMBER (a cost beyond the range of float), POSE and
//              QUATERNION (from `kinematics`), WORKSPACE, TOO_LARGE, and those of the queries
//   source     MPPI (Williams et al. 2017), then L-BFGS with bundled gradients (Suh et al. 2022);
//              NeuralSVCD, appendix D
//
// If bodies have triangles, the start, the goal and the final trajectory are proven free. The proof
// is about the motion of each pair, as seen from b, between the poses of the check's segments, with
// linear positions and slerped rotations. The spline goes through these poses, and deviates from
// that motion in between by answer.deviation, which is measured, not proven. To clear the spline
// itself, ask for a larger sweep.clearance than that. With `discrete`, or a custom cost of
// collision, nothing is proven between the poses.
//
// If the proof finds a hit, the refinement goes on from there with twice the margin and a little
// more, three times at most. The planner ends within seeds * (iterations of MPPI + 4 times those of
// L-BFGS) iterations of `draws` trajectories each, and 5 more each for L-BFGS.
NSVCDDEF nsvcd_result nsvcd_plan(const nsvcd_plan_problem *problem,
                                 const nsvcd_plan_options *options, void *workspace,
                                 size_t workspace_size, float *control,
                                 nsvcd_plan_answer *answer);
#endif  // NSVCD_NO_OPTIMIZER
