// In: two movers and options. Out: an answer, and its derivative.
#pragma once
#include "bodies.h"

// Takes a point x of the body's frame to the world: rotation x + position.
typedef struct nsvcd_pose {
  float position[3];  // metres
  // unit quaternion x y z w
  float rotation[4];
} nsvcd_pose;

typedef enum nsvcd_status {
  // the network has answered
  NSVCD_STATUS_OK = 0,
  // proven: the surfaces never meet; and, by the proof, nothing is inside of anything
  NSVCD_STATUS_CERTIFIED_FREE,
  // one body, or a part of it, lies inside the other at the start: by the proof a fact, by the
  // network's method an estimate. Surfaces may meet as well. Where first, measure or skin ask for
  // more than yes or no, that is looked for, and a WITNESS is said if it is found soon
  NSVCD_STATUS_INSIDE,
  // the network has answered, but more pairs of patches overlapped than options.pairs let through
  NSVCD_STATUS_LIMIT,
  // proven: two triangles meet
  NSVCD_STATUS_WITNESS,
  // the proof came to no end: see nsvcd_answer
  NSVCD_STATUS_UNDECIDED
} nsvcd_status;

// A status in a word or two, for a person; never NULL.
NSVCDDEF const char *nsvcd_status_string(nsvcd_status status);

// The decoders, all on the same latents: about 4, 13 and 40 thousand multiplications for each pair
// of patches.
typedef enum nsvcd_model {
  // the largest that is compiled in
  NSVCD_MODEL_DEFAULT = 0,
  NSVCD_MODEL_TINY,
  NSVCD_MODEL_SMALL,
  NSVCD_MODEL_BASE
} nsvcd_model;

// The arithmetic of the decoder. Latents are int8 in any case.
typedef enum nsvcd_precision {
  NSVCD_PRECISION_FLOAT = 0,
  NSVCD_PRECISION_INT8
} nsvcd_precision;

// How a question is answered.
typedef enum nsvcd_method {
  // by proof where both bodies have triangles, else by the network
  NSVCD_METHOD_DEFAULT = 0,
  NSVCD_METHOD_PROOF,   // a witness or a certificate
  NSVCD_METHOD_NETWORK  // an opinion, in a time that is bounded strictly
} nsvcd_method;

#define NSVCD_DEFAULT_WORK 100000
#define NSVCD_NO_TRIANGLE 0xffffffffu
#define NSVCD_DEFAULT_PAIRS 8
#define NSVCD_MAX_PAIRS 256
// the logit of INSIDE; its negative is that of CERTIFIED_FREE
#define NSVCD_LOGIT_CERTAIN 100.0f

// What is zero is the default.
typedef struct nsvcd_sweep_options {
  // K, pairs of patches that the network looks at, 1..NSVCD_MAX_PAIRS; 0: NSVCD_DEFAULT_PAIRS
  size_t pairs;
  nsvcd_model model;
  nsvcd_precision precision;
  // share of collisions that the network is to find: 0 (balanced errors), 0.99f, 0.999f or 0.9999f
  float recall;
  nsvcd_method method;
  // units that a proof may take, about; 0: NSVCD_DEFAULT_WORK. A unit is a plane sought for two
  // patches, 16 triangles against the box of 16, one of them against these, two triangles at one
  // time, or a ray against 16 or one. An eighth is left once surfaces have come too near to tell
  size_t work;
  // a motion is cut into at most so many, a multiple of 16 up to 64; 0: 64. Fewer take less memory;
  // what turns by more than 20 degrees in one of them takes longer to prove
  size_t segments;
  // metres: surfaces that come closer than this, or than this and the clearance, and do not meet,
  // may be left undecided
  float tolerance;

  // By proof only:
  // metres: to come as close as this counts as a collision; 0: to meet does
  float clearance;
  // share of the motion, up to 1: contact_time is that of the first contact, to this. 0: of any
  // contact. It may be later where surfaces are within the quanta or the tolerance of each other
  // for longer than this before they meet, or more work is needed: see free_until. An eighth of the
  // work is kept for whether they meet at all
  float first;
  // metres: the least distance over the motion is between clearance_low and clearance_high. These
  // are no farther apart than this, or than twice the bodies' quanta and the tolerance where that
  // is more, and these quanta (nsvcd_body_facts.quantum) once more; farther where work ran out:
  // then they are the best that was proven. 0: unasked. Not with `first`. The status is what it
  // would be without
  float measure;
  // metres: a contact at the start that is no deeper than this does not count, nor does what is
  // nearer than the clearance by no more than this; what is both is to be so in sum. So a body may
  // rest on another, slide along it or leave it. The question is asked as if a were lifted off b,
  // by this much along the normals of all that it touches, and touches nothing then: see
  // answer.lift
  float skin;
} nsvcd_sweep_options;

// A body in a scene: how it moves, and how large it is. Many may share one body.
typedef struct nsvcd_mover {
  // from nsvcd_encode, nsvcd_body_load, nsvcd_body_trust or nsvcd_body_scale
  const nsvcd_body *body;
  // (count), uniform in t in [0,1]; in between, position linear and rotation slerp. One pose: it
  // rests there. NULL, and count 0: it rests at the origin
  const nsvcd_pose *poses;
  // up to NSVCD_MAX_POSES
  size_t count;
  // of the body, about its origin, NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; 0: 1
  float scale;
} nsvcd_mover;

// Do two bodies hit each other? What is zero is the default, but for the bodies.
typedef struct nsvcd_question {
  // either may move, or both, in the same time; their counts of poses may differ
  nsvcd_mover a, b;
  nsvcd_sweep_options options;
} nsvcd_question;

typedef struct nsvcd_answer {
  // of collision; positive is yes. By the network: the greatest of the pairs looked at, less the
  // threshold that options.recall asks for; the search ends at the first above 3. Where the tiny
  // decoder, which ranks the pairs, is clear (beyond +-3), that one answers. By proof:
  // +-NSVCD_LOGIT_CERTAIN; where it is undecided, the network's
  float logit;
  // logit > 0. UNDECIDED: the network's opinion on whether they meet, or yes where there is none or
  // something else is asked
  int collides;
  // in [0,1]. WITNESS: when the triangles meet; with options.first the first contact is then, or
  // before that but not before free_until; 0 if they meet at the start. UNDECIDED: when the
  // triangles named are as near as clearance_high. INSIDE: 0. By the network, and UNDECIDED where
  // no triangles are named: when the most suspicious pair comes closest
  float contact_time;
  // in [0,1]. By proof: no contact is before this. CERTIFIED_FREE: 1. With options.first: when
  // doubt begins, or, where none does before it, contact_time - first of a WITNESS; earlier where
  // work ran out. Otherwise 0
  float free_until;
  // metres. By proof: they stay farther apart than clearance_low until free_until, with
  // options.measure all the time, and come as near as clearance_high, at contact_time if triangles
  // are named. What stored triangles are off by is allowed for, and so clearance_high is not 0
  // where they meet; it is HUGE_VALF where it is not known
  float clearance_low;
  float clearance_high;
  // the pair that decided; 0, 0 where there is none
  uint32_t patch_a;
  uint32_t patch_b;
  nsvcd_status status;
  // by the network: pairs of patches whose spheres meet, each counted once for each stretch of
  // time, until the search ends
  size_t candidates;
  // metres, world. Of the triangles named below, where they meet at that time, or on one of them
  // where they are nearest; of a large one, which is stored in parts, the part that was looked at
  // last. INSIDE: a point of what is inside
  float point[3];
  // world. Unit normal of one of these, from b to a (an open surface met from behind: as it is
  // wound), or, where they are apart, the direction from b's to a's. 0 where none are named, and
  // where that triangle has no area
  float normal[3];
  // as numbered in the caller's meshes. WITNESS: those that meet. UNDECIDED: two that come too near
  // to tell, with options.first the earliest; NSVCD_NO_TRIANGLE where none are known. With
  // options.measure the nearest ones found, but for INSIDE. Otherwise NSVCD_NO_TRIANGLE
  uint32_t triangle_a;
  uint32_t triangle_b;
  // metres, world, at the start: by what a was lifted off b for options.skin; it turns with b, or,
  // where a rests, or both move and a is the larger, with a. The answer is about the motion so
  // displaced, which touches nothing at the start. 0: nothing was touched; or no lift does that,
  // since a is pressed in deeper than the skin, or held from all sides: then the contact counts
  float lift[3];
  // units that the proof took
  size_t work;
} nsvcd_answer;

// Bytes of the workspace that nsvcd_sweep needs; 0 if the question is refused. They depend on the
// sizes of the bodies, the method, and options.segments, pairs and model.
//   question   NULL: enough for any question
NSVCDDEF size_t nsvcd_sweep_workspace_size(const nsvcd_question *question);

// Answers a question. The same question, the same answer, in one build: see DETERMINISM above; and
// the same verdict whichever body is a and which b.
//   question   not NULL
//   workspace  (workspace_size) bytes, nsvcd_sweep_workspace_size(question) or more, not NULL,
//              aligned to NSVCD_ALIGNMENT
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each with its own workspace; they may share bodies
//   errors     ARGUMENT, POSE, SCALE, TOLERANCE, SAME, WORKSPACE, and BODY where a body lacks what
//              the method needs
//   source     the proof: this library, proof/proof; the network: NeuralSVCD, algorithm 1
//
// What a proof says is about the surfaces of the two meshes, scaled and posed exactly as described.
// CERTIFIED_FREE and INSIDE hold for the meshes themselves. The triangles of a WITNESS meet to
// within the two bodies' quanta (nsvcd_body_facts, times the scale). UNDECIDED are surfaces that
// come as close as that without meeting, or more work than was allowed. More work never leaves
// undecided what less decides, but for luck: options.first with a few hundred units.
//
// What it costs: Ga and Gb are the bodies' groups of 16 patches. A motion has S segments: 16 or so
// up to 320 degrees of turn, 64 at most. The search takes at most 18 S Ga Gb + 3 S tests of 16
// spheres against one; by the network, for motions that turn by more than 45 degrees, on machines
// of less than 16 lanes, 34 S Ga Gb. Of bodies of more than 512 patches only those groups count
// that the other body comes near, and some 16 tests more for each level of spheres and each 16
// spheres of it that it comes near. Then a proof takes options.work units. The network takes the
// tiny decoder on 12 K pairs and the chosen one on K (tiny alone: on 3 K), and 32 distances for
// each patch.
NSVCDDEF nsvcd_result nsvcd_sweep(const nsvcd_question *question, void *workspace,
                                  size_t workspace_size, nsvcd_answer *answer);

// Workspaces as constants, for arrays of a fixed size, a little larger than need be. Where one
// workspace is for both methods, take the larger.
//   patches_a, patches_b patches of the bodies, or more
//   segments             options.segments, 16 to 64
//   pairs                options.pairs, K
// NSVCD_MEMORY declares an array that is aligned:
//   static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(64, 192, 16));
#define NSVCD_MEMORY(name, bytes) uint64_t name[((bytes) + 7) / 8]
#define NSVCD__GROUPS_OF(patches) ((patches) > 512 ? 32 : ((patches) + 15) / 16)
#define NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) \
  (1024 + 704 * (segments) + 8 * NSVCD__GROUPS_OF(patches_a) * NSVCD__GROUPS_OF(patches_b) + \
   ((patches_a) > 512 || (patches_b) > 512 ? 1024 : 0))
#define NSVCD_PROOF_WORKSPACE_BYTES(patches_a, patches_b, segments) \
  (NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) + 24576 + 168 * (segments))
#define NSVCD_NETWORK_WORKSPACE_BYTES(patches_a, patches_b, segments, pairs) \
  (NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) + 96 * (pairs))

// Answers many questions, as a frame of a game or a sampling planner has them. Where a question and
// the one before it ask the network about the same two bodies, it is first asked where that one
// collided. If that is a clear collision again (logit above 3), it is the answer, and the rest is
// not searched. All other answers are nsvcd_sweep's, to the bit.
//   questions  (count); count may be 0
//   workspace  as for nsvcd_sweep, large enough for each of them
//   answers    (count); left as they were on failure
//   allocates  nothing
//   threads    as nsvcd_sweep
//   errors     those of nsvcd_sweep, of the first question that has one
//   source     this library; physics engines call it temporal coherence
NSVCDDEF nsvcd_result nsvcd_sweep_batch(const nsvcd_question *questions, size_t count,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answers);

#ifndef NSVCD_NO_GRADIENT
// Answers a question by the network, with the derivatives of answer->logit by the poses of a and b.
// What drives the poses (joints, a spline) goes on from there by the chain rule.
//   question   options.method is not PROOF, and no option is set that only a proof has
//   workspace, answer   as for nsvcd_sweep
//   gradient_a, gradient_b   (count, 6), one row for a body without poses; one of them may be NULL;
//              left as they were on failure. Of each pose: by a displacement of the body's origin
//              (metres, world axes), then by a small rotation about that origin (rotation vector,
//              radians, world axes, applied on the left)
//   allocates  nothing
//   threads    as nsvcd_sweep
//   errors     those of nsvcd_sweep
//   source     reverse mode; this library
//
// Zero where no network answered (CERTIFIED_FREE, INSIDE), and for poses that the decisive pair
// does not pass. It is the gradient of the pair and the stretch of time that decided: the logit is
// the greatest of several, and so has kinks, also where the network (ReLU) and the frame of a pair
// have theirs. Where the pair is at rest, or does not turn, it is the mean of both sides. The ends
// of the stretch move with the poses, but for those at t = 0 or 1 and where a segment of the search
// begins or ends. The unit of length, and the spheres' allowance for what the motion does between
// its knots, are taken as constant. In int8 arithmetic it is the derivative of the float decoder,
// or, without that, of the function that the int8 one rounds.
NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b);
#endif
