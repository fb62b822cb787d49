// In: a planning problem, or control points. Out: control points, or the joints at a time.
//
// A trajectory of F joints is a spline through control points: the start, M via points, the goal;
// control (M + 2, F), uniform in t in [0,1]. It has degree five between two points. At via points
// its velocity and acceleration are those of central differences, and it rests at both ends, so
// both are continuous everywhere.
#pragma once
#include "queries.h"

#ifndef NSVCD_NO_OPTIMIZER
#define NSVCD_MAX_VIA_POINTS 32
// of a stage of the planner
#define NSVCD_MAX_PLAN_SEGMENTS 4096

// The joints at a time, or their derivatives by t.
//   control    (via_points + 2, joints), not NULL
//   via_points M, up to NSVCD_MAX_VIA_POINTS; if more, nothing is written
//   t          clamped to [0,1]
//   derivative 0: the joints; 1, 2, 3: velocity, acceleration, jerk; if more, nothing is written
//   out        (joints), not NULL
//   allocates  nothing
//   source     quintic Hermite interpolation, as the paper's authors use it
NSVCDDEF void nsvcd_spline(const float *control, size_t via_points, size_t joints, float t,
                           size_t derivative, float *out);

typedef enum nsvcd_plan_status {
  // the trajectory is within the limits and free of collision: proven where bodies have triangles,
  // otherwise as far as the network knows; up to its deviation from the last check's motion,
  // answer.deviation
  NSVCD_PLAN_CONVERGED = 0,
  // the iterations ended before a free one was found; this is the best
  NSVCD_PLAN_LIMIT,
  // by the progress callback; this is the best so far
  NSVCD_PLAN_CANCELLED,
  // the start is out of the limits or in collision; control is the smoothest path to the goal
  NSVCD_PLAN_START,
  // the same of the goal
  NSVCD_PLAN_GOAL
} nsvcd_plan_status;

// The status in a word or two, for people; never NULL.
NSVCDDEF const char *nsvcd_plan_status_string(nsvcd_plan_status status);

typedef struct nsvcd_plan_progress {
  // from 0
  size_t seed, iteration;
  // of this stage; L-BFGS starts again if the proof finds a hit
  size_t iterations;
  // 0: MPPI, 1: L-BFGS
  int refining;
  // of the best trajectory of this stage. Stages evaluate different poses, so their costs do not
  // compare
  float cost;
  // the part of the cost due to collision; 0: free, as far as the stage's segments show
  float collision;
  // (via_points + 2, F), valid during the call
  const float *control;
  size_t via_points;
} nsvcd_plan_progress;

// A scene: how bodies move, and which pairs can meet; no others are checked. All callbacks get the
// same `user`, and must depend on nothing but that and their arguments.
typedef struct nsvcd_plan_problem {
  // F, 1..NSVCD_MAX_JOINTS
  size_t joints;
  // (F), limits
  const float *low, *high;
  // (F)
  const float *start, *goal;
  // (B), up to 65536, with latents; those in no pair may be NULL
  const nsvcd_body *const *bodies;
  size_t body_count;
  // (P). The planner asks about a's motion as seen from b. Let b be the body that rests, or else
  // the larger: the other way round is a little less accurate
  const nsvcd_body_pair *pairs;
  size_t pair_count;
  // joints (F) -> poses (B), in the world. To grasp a thing, let this move it with the hand;
  // nothing is encoded again
  void (*kinematics)(void *user, const float *joints, nsvcd_pose *poses);
  // joints (F) -> jacobian (B, 6, F): for each body and joint, the displacement of the body's
  // origin and its rotation vector, in world axes. NULL: by differences of `kinematics`
  void (*jacobian)(void *user, const float *joints, float *jacobian);
  // NULL: the network. Otherwise the cost of collision of poses (T, B) at T times along the
  // trajectory. It may return as soon as the sum exceeds `limit`. Sets *collides if there is a
  // collision. Unless `gradient` is NULL, adds the cost's derivative to it, (T, B, 6), as
  // nsvcd_sweep_gradient has it
  float (*collision)(void *user, const nsvcd_pose *poses, size_t times, float limit,
                     int *collides, float *gradient);
  // called once per iteration; not 0 cancels. May be NULL
  int (*progress)(void *user, const nsvcd_plan_progress *progress);
  void *user;
} nsvcd_plan_problem;

// Zero means the stage's default.
typedef struct nsvcd_plan_stage {
  // M, up to NSVCD_MAX_VIA_POINTS
  size_t via_points;
  // of the trajectory, each swept as one motion; with `discrete`, their ends are checked; up to
  // NSVCD_MAX_PLAN_SEGMENTS
  size_t segments;
  // at most, up to 100000; NSVCD_NONE: skip the stage
  size_t iterations;
  // random trajectories in an iteration of MPPI, or gradients in a bundle of L-BFGS; up to 10000
  size_t draws;
  // their standard deviation around the trajectory, radians or metres: for MPPI at mid-motion, in
  // the first iteration; for L-BFGS's bundle at all via points. Negative: 0
  float noise;
} nsvcd_plan_stage;

// Zero means the default, which is given last; negative weights count as zero. If an exact check
// finds contacts, raise sweep.network.recall, `collision` or the bodies' number of patches; if the
// status is LIMIT, raise `seeds` or explore.draws. Smoothness counts radians and metres alike: for
// paths of hundreds of metres, raise `duration` or `collision`.
typedef struct nsvcd_plan_options {
  // of all random numbers
  uint64_t seed;
  // initial trajectories, tried until one ends free, up to 1000; 6
  size_t seeds;
  // MPPI: 5 via points, 24 segments, 40 iterations, 100 draws, noise 0.3
  nsvcd_plan_stage explore;
  // L-BFGS: 10, 22, 10, 10, 0.01
  nsvcd_plan_stage refine;
  // weights of the mean squares over the motion: 10, 2, 10
  float velocity, acceleration, jerk;
  // weight of the sum of logits over pairs and segments: 20; the paper's is 1
  float collision;
  // seconds from start to goal; they only weight the terms above: 20
  float duration;
  // logits above minus this cost: 2
  float margin;
  // 1: check poses instead of sweeps
  int discrete;
  // segments of the last check, up to 4 NSVCD_MAX_PLAN_SEGMENTS; 16 times the finest stage's, or
  // that limit. Joint limits are checked between segments and at via points. Twice as many make
  // answer.deviation a quarter
  size_t check;
  // how questions are asked; sweep.network.recall = 0.999f keeps more distance. The search asks the
  // network; `method`, `clearance`, `slop` and the like apply to the start, the goal and the last
  // check. Not read: a, b, ask, to and to_time
  nsvcd_question sweep;
} nsvcd_plan_options;

typedef struct nsvcd_plan_answer {
  nsvcd_plan_status status;
  // by the last check, or of the start or the goal if the status names it
  int collides;
  // a joint that leaves its limits, or NSVCD_NONE
  size_t joint;
  // the pair with the largest logit, or NSVCD_NONE
  size_t pair;
  // the largest of the last check; with a custom cost of collision, that cost
  float logit;
  // of that logit, in [0,1]
  float time;
  // metres: how far the spline leaves the motion of the last check, through whose poses it goes:
  // the largest deviation of any point of a's bounding sphere, as b sees it, over all pairs whose a
  // is given, also with a custom cost of collision. Measured, not proven: half way between two
  // poses, where a smooth curve deviates most, at 16 or more times in each piece of the spline. 0
  // if no trajectory was sought
  float deviation;
  // of the trajectory; smoothness is without collision and limits. 0 if none was sought
  float cost, smoothness;
  // M of `control`
  size_t via_points;
  // used; iterations of both stages
  size_t seeds, iterations;
  // whose cost was computed
  size_t trajectories;
  // queries asked
  size_t sweeps;
} nsvcd_plan_answer;

// Bytes of workspace that nsvcd_plan needs; 0 if problem or options are refused, or if it would be
// more than SIZE_MAX.
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_plan_workspace_size(const nsvcd_plan_problem *problem,
                                          const nsvcd_plan_options *options);

// Finds a smooth trajectory from start to goal on which no pair meets. Same problem, same
// trajectory, in one build: see DETERMINISM above.
//   problem    not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_plan_workspace_size(problem, options) or more, not
//              NULL, aligned to NSVCD_ALIGNMENT
//   control    (M + 2, F), not NULL, with the M of options.refine, or of explore if that is
//              skipped; NSVCD_MAX_VIA_POINTS + 2 rows are always enough. Written whatever the
//              status, but not on failure
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
// that motion in between by answer.deviation, which is not proven: to clear the spline itself, as
// measured, ask for a larger sweep.clearance than that. With `discrete`, or a custom cost of
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
