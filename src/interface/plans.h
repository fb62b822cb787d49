// In: a planning problem, or control points. Out: control points, or what the joints are at a time.
//
// A trajectory of F joints is a spline through control points: the start, M via points, the goal,
// control (M + 2, F), uniform in t in [0,1]. Between two points it is of degree five. At via points
// it has the velocity and the acceleration of central differences, and it is at rest at both ends;
// so both are continuous everywhere.
#pragma once
#include "queries.h"

#ifndef NSVCD_NO_OPTIMIZER
#define NSVCD_MAX_VIA_POINTS 32
// of a stage of the planner
#define NSVCD_MAX_PLAN_SEGMENTS 4096

// The joints at a time, or their derivatives by t.
//   control    (via_points + 2, joints), not NULL
//   via_points M, up to NSVCD_MAX_VIA_POINTS; of more, nothing is written
//   t          taken into [0,1]
//   derivative 0: the joints; 1, 2, 3: velocity, acceleration, jerk; of more, nothing is written
//   out        (joints), not NULL
//   allocates  nothing
//   source     quintic Hermite interpolation, as the paper's authors use it
NSVCDDEF void nsvcd_spline(const float *control, size_t via_points, size_t joints, float t,
                           size_t derivative, float *out);

typedef enum nsvcd_plan_status {
  // the trajectory is within the limits and free of collision: certified where bodies have
  // triangles, else as far as the network knows; but for what it deviates from the last check's
  // motion, answer.deviate
  NSVCD_PLAN_CONVERGED = 0,
  // the iterations ended before one was found; this is the best
  NSVCD_PLAN_LIMIT,
  // by the progress callback; this is the best so far
  NSVCD_PLAN_CANCELLED,
  // the start is out of the limits or in collision: control is the smoothest way to the goal
  NSVCD_PLAN_START,
  // the goal is out of the limits or in collision: so again
  NSVCD_PLAN_GOAL
} nsvcd_plan_status;

// A status in a word or two, for a person; never NULL.
NSVCDDEF const char *nsvcd_plan_status_string(nsvcd_plan_status status);

typedef struct nsvcd_plan_progress {
  // from 0
  size_t seed, iteration;
  // of this stage; L-BFGS begins anew where the proof found a hit
  size_t iterations;
  // 0: MPPI, 1: L-BFGS
  int refining;
  // of the best trajectory of this stage. Stages look at different poses: their costs do not
  // compare
  float cost;
  // the part of it that is due to collision: at 0 it is free, as far as the stage's segments show
  float collision;
  // (via_points + 2, F), valid during the call
  const float *control;
  size_t via_points;
} nsvcd_plan_progress;

// A scene: who moves how, and who can meet whom. Nothing else is looked at. One `user` serves all
// callbacks; these must depend on nothing but their arguments and it.
typedef struct nsvcd_plan_problem {
  // F, 1..NSVCD_MAX_JOINTS
  size_t joints;
  // (F), limits
  const float *low, *high;
  // (F)
  const float *start, *goal;
  // (B), up to 65536, with latents; ones in no pair may be NULL
  const nsvcd_body *const *bodies;
  size_t body_count;
  // (P). The planner asks about a's motion as seen from b: take the body that rests, or else the
  // larger one, as b, for the other way round costs a little accuracy
  const nsvcd_body_pair *pairs;
  size_t pair_count;
  // joints (F) -> poses (B), in the world. What is grasped moves with the hand because this says
  // so: nothing is encoded anew
  void (*kinematics)(void *user, const float *joints, nsvcd_pose *poses);
  // joints (F) -> jacobian (B, 6, F): of each body, by a joint, the displacement of its origin and
  // its rotation vector, in the world's axes. NULL: by differences of `kinematics`
  void (*jacobian)(void *user, const float *joints, float *jacobian);
  // Instead of the network: the cost of collision of poses (T, B) at T times along the trajectory.
  // It may end at the first sum above `limit`. Sets *collides if there is a collision. Unless
  // `gradient` is NULL, adds the cost's derivative to it, (T, B, 6), as nsvcd_sweep_gradient has
  // it. NULL: the network
  float (*collision)(void *user, const nsvcd_pose *poses, size_t times, float limit,
                     int *collides, float *gradient);
  // once in each iteration; not 0 cancels. May be NULL
  int (*progress)(void *user, const nsvcd_plan_progress *progress);
  void *user;
} nsvcd_plan_problem;

// What is zero is the stage's default.
typedef struct nsvcd_plan_stage {
  // M, up to NSVCD_MAX_VIA_POINTS
  size_t via_points;
  // of the trajectory, each swept as one motion; with `discrete`, their ends are looked at; up to
  // NSVCD_MAX_PLAN_SEGMENTS
  size_t segments;
  // at most, up to 100000; NSVCD_NONE: leave the stage out
  size_t iterations;
  // random trajectories in an iteration of MPPI, or gradients in a bundle of L-BFGS; up to 10000
  size_t draws;
  // their standard deviation about the trajectory, radians or metres: MPPI's at mid-motion, at
  // first; of L-BFGS's bundle at all via points. Negative: 0
  float noise;
} nsvcd_plan_stage;

// What is zero is the default, which stands last; weights that are negative count as zero. If an
// exact check finds contacts, raise sweep.network.recall, `collision` or the bodies' number of
// patches; if the status is LIMIT, `seeds` or explore.draws. The smoothness counts radians and
// metres alike: for ways of hundreds of metres, raise `duration` or `collision`.
typedef struct nsvcd_plan_options {
  // of all random numbers
  uint64_t seed;
  // starts, tried until one ends free, up to 1000; 6
  size_t seeds;
  // MPPI: 5 via points, 24 segments, 40 iterations, 100 draws, noise 0.3
  nsvcd_plan_stage explore;
  // L-BFGS: 10, 22, 10, 10, 0.01
  nsvcd_plan_stage refine;
  // weights of the means of squares over the motion: 10, 2, 10
  float velocity, acceleration, jerk;
  // weight of the logits' sum over pairs and segments: 20; the paper's is 1
  float collision;
  // seconds from start to goal, which only weights the terms above: 20
  float duration;
  // logits above minus this cost: 2
  float margin;
  // 1: poses instead of sweeps
  int discrete;
  // segments of the last check, up to 4 NSVCD_MAX_PLAN_SEGMENTS; 16 times the finest stage's, or
  // that limit. Limits are looked at between these and at via points. Twice as many take
  // answer.deviate to a quarter
  size_t check;
  // how all questions are asked; sweep.network.recall = 0.999f keeps more distance. The search asks
  // the network. `method` is that of start, goal and the last check, and so are `clearance`, `slop`
  // and the like. Not read: a, b, ask, to and to_time
  nsvcd_question sweep;
} nsvcd_plan_options;

typedef struct nsvcd_plan_answer {
  nsvcd_plan_status status;
  // by the last check, or of the start or the goal where the status says so
  int collides;
  // that leaves its limits, or NSVCD_NONE
  size_t joint;
  // of the greatest logit, or NSVCD_NONE
  size_t pair;
  // greatest of the last check; with a custom cost of collision that cost
  float logit;
  // of that logit, in [0,1]
  float time;
  // metres that the spline deviates from the motion of the last check, through whose poses it goes:
  // the farthest of any point of a's bounding sphere, as b sees it. Of all pairs whose a is given,
  // with a custom cost of collision too. Measured, not proven: half way between two poses, where a
  // smooth curve deviates most, at 16 places or more of each piece of the spline. 0 where no
  // trajectory was sought
  float deviation;
  // of the trajectory, the latter without collision and limits; 0 where none was sought
  float cost, smoothness;
  // M of `control`
  size_t via_points;
  // used; the latter of both stages
  size_t seeds, iterations;
  // that were costed
  size_t trajectories;
  // queries asked
  size_t sweeps;
} nsvcd_plan_answer;

// Bytes of the workspace that nsvcd_plan needs; 0 if problem or options are refused, or if it were
// more than SIZE_MAX.
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_plan_workspace_size(const nsvcd_plan_problem *problem,
                                          const nsvcd_plan_options *options);

// Finds a smooth trajectory from start to goal on which no pair meets. The same problem, the same
// trajectory, in one build: see DETERMINISM above.
//   problem    not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_plan_workspace_size(problem, options) or more, not
//              NULL, aligned to NSVCD_ALIGNMENT
//   control    (M + 2, F), not NULL, with the M of options.refine, or of explore if that is left
//              out; NSVCD_MAX_VIA_POINTS + 2 rows are always enough. Written whatever the status
//              is; not on failure
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each with its own workspace; they may share bodies
//   errors     ARGUMENT (NULL), COUNT, PAIR, BODY, VERSION, STAGE, PLAN (of the options), LIMITS
//              (low above high), VALUE (limits, start or goal not finite or beyond
//              NSVCD_MAX_COORDINATE), NUMBER (a cost beyond the range of float), POSE and
//              QUATERNION (from `kinematics`), WORKSPACE, TOO_LARGE, and those of the queries
//   source     MPPI (Williams et al. 2017), then L-BFGS with bundled gradients (Suh et al. 2022);
//              NeuralSVCD, appendix D
//
// Start, goal and the trajectory at the end are proven free where bodies have triangles: for the
// motion of each pair as seen from b between the poses of the check's segments, position linear and
// rotation slerp. The spline goes through these poses, and in between deviates from that motion by
// answer.deviate, which nothing proves: to have the spline itself clear, by measure, ask for a
// sweep.clearance above that. With `discrete`, or a cost of collision of one's own, nothing is
// proven between the poses.
//
// Where the proof finds a hit, the refinement goes on from there with twice the margin and a little
// more, three times at most. It ends within seeds * (iterations of MPPI + 4 times those of L-BFGS)
// iterations, each of `draws` trajectories, and for L-BFGS of 5 more.
NSVCDDEF nsvcd_result nsvcd_plan(const nsvcd_plan_problem *problem,
                                 const nsvcd_plan_options *options, void *workspace,
                                 size_t workspace_size, float *control,
                                 nsvcd_plan_answer *answer);
#endif  // NSVCD_NO_OPTIMIZER
