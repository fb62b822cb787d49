// In: two movers and options. Out: an answer, and its derivative.
#pragma once
#include "bodies.h"

// Takes a point x of the body's frame to the world: rotation x + position.
typedef struct nsvcd_pose {
  float position[3];  // metres
  // unit quaternion x y z w, its length 1 to NSVCD_UNIT_TOLERANCE
  float rotation[4];
} nsvcd_pose;

#define NSVCD_UNIT_TOLERANCE 1e-4f

// What is asked of two bodies that move.
typedef enum nsvcd_ask {
  // do they hit each other at all? The search ends at whatever contact it finds: the time that is
  // told is that of this one, as a rule not the first
  NSVCD_ASK_HIT = 0,
  // do they, and when first? This is what tells how far things may move
  NSVCD_ASK_FIRST,
  // do they, and how near do they come? Of the time no more is told than of HIT. The network, where
  // it is named, tells its opinion of the distance
  NSVCD_ASK_DISTANCE
} nsvcd_ask;

// How a question is answered.
typedef enum nsvcd_method {
  // by proof where both bodies have triangles, else by the network
  NSVCD_METHOD_DEFAULT = 0,
  NSVCD_METHOD_PROOF,   // facts
  NSVCD_METHOD_NETWORK  // an opinion, in a time that is bounded strictly
} nsvcd_method;

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

// What the network is told. What is zero is the default.
typedef struct nsvcd_network_options {
  // K, pairs of patches that it looks at, 1..NSVCD_MAX_PAIRS; 0: NSVCD_DEFAULT_PAIRS
  size_t pairs;
  nsvcd_model model;
  nsvcd_precision precision;
  // share of collisions that it is to find: 0 (balanced errors), 0.99f, 0.999f or 0.9999f
  float recall;
  // Patches are inflated by this share of their radii before planes separate them, so that patches
  // which only come near are looked at too: the logit rises before contact, and has a gradient
  // there. It calls more of what is near a hit. 0: as much as `recall` needs, or, where a distance
  // is asked for, 1
  float inflate;
} nsvcd_network_options;

// units; HIT and FIRST, whose verdict on a close fit may take as many, and nothing else does
#define NSVCD_DEFAULT_WORK 100000
#define NSVCD_DEFAULT_VERDICT_WORK 10000000
#define NSVCD_NO_TRIANGLE 0xffffffffu
// that an answer names at most
#define NSVCD_MAX_CONTACTS 4
#define NSVCD_DEFAULT_PAIRS 8
#define NSVCD_MAX_PAIRS 256
// the logit of what a proof says is a hit; its negative is that of what is free
#define NSVCD_LOGIT_CERTAIN 100.0f
// of the radius of the smaller body's sphere: what `to` is where nothing is said
#define NSVCD_DEFAULT_TO 0.001f

#define NSVCD_NONE ((size_t)-1)
#define NSVCD_MAX_JOINTS 32

// Two bodies that can meet, by their indices.
typedef struct nsvcd_body_pair {
  uint32_t a, b;
} nsvcd_body_pair;

// A body in a scene: how it moves, and how large it is. Many may share one body.
typedef struct nsvcd_mover {
  // from nsvcd_encode, nsvcd_body_load, nsvcd_body_trust or nsvcd_body_scale
  const nsvcd_body *body;
  // (count) poses; in between, position linear and rotation slerp. One: it rests there. NULL, and
  // count 0: it rests at the origin
  const nsvcd_pose *poses;
  // up to NSVCD_MAX_POSES
  size_t count;
  // (count) when it is at each, from 0 to 1, each later than the one before by 1e-7 or more;
  // rounded to 2^-32. NULL: uniform
  const float *times;
  // of the body, about its origin, NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; 0: 1
  float scale;
} nsvcd_mover;

// Do two bodies hit each other? What is zero is the default, but for the bodies.
typedef struct nsvcd_question {
  // either may move, or both, in the same time; their counts of poses may differ
  nsvcd_mover a, b;
  nsvcd_ask ask;
  // metres. FIRST: no point of one body moves farther than this, as the other sees it, from the
  // time that is proven free to that of the contact; nor than a quarter of its way, if triangles
  // are stored as exactly as that. DISTANCE: how wide the bracket may be. 0 (and
  // to_time 0): NSVCD_DEFAULT_TO of the smaller body. Not with HIT
  float to;
  // FIRST: the same as a share of the motion, up to 1. Where both are set, both hold
  float to_time;
  // metres: to come as near as this is a hit; 0: to meet is one
  float clearance;
  // metres: initial penetration, or violation of the clearance, up to this is ignored (their sum,
  // if both). So a body may rest on another, slide along it or leave it. The question is asked as
  // if a were pushed out of b by this much along the normals of all that it touches: see
  // answer.lift. What is nearer than a twentieth of this is pushed out of as if it touched. With
  // FIRST, so is what is nearer than `to`, up to half of this, so that a body that was stopped
  // before a contact goes on: entering it by less than this is FREE, though HIT, which has no `to`,
  // tells of a contact. answer.depth is 0 for what was so near and did not touch
  float slop;
  // metres: surfaces that come closer than this, or than this and the clearance, and do not meet,
  // may be left undecided
  float tolerance;
  // FIRST: 1: up to four contacts, which hold the body, are told, where else one is
  int manifold;
  nsvcd_method method;
  // units that a proof may take, about; 0: NSVCD_DEFAULT_VERDICT_WORK, of DISTANCE
  // NSVCD_DEFAULT_WORK, which each interval of a long motion may take (see nsvcd_sweep), so that it
  // grows with the length. A unit is a plane sought for two patches, 16 triangles against the box
  // of 16, one of them against these, two triangles at one time, or a ray against 16 or one. What
  // is named is for all of the motion, in the order of time: when it ends, what was proven until
  // then is told; of DISTANCE each interval has the share that is its part of the time left. An
  // eighth is left once surfaces have come too near to tell. Of FIRST an eighth is kept for what
  // has not been decided by then: what of the motion is free until when, and whether they meet at
  // all. A manifold, and the place of a pushed out body, may take an eighth each besides. By
  // default an eighth is one of NSVCD_DEFAULT_WORK. Before that, a question takes as many units
  // whatever is allowed
  size_t work;
  // a motion, or each interval of a long one, is cut into at most so many, a multiple of 16 up to
  // 64; 0: 64. Fewer take less memory, and make intervals shorter
  size_t segments;
  // where it is the network that answers. It knows nothing of FIRST, a clearance or a slop, and has
  // no bounds of a DISTANCE: `to` is a proof's
  nsvcd_network_options network;
} nsvcd_question;

typedef enum nsvcd_verdict {
  NSVCD_UNDECIDED = 0,
  // the surfaces never come within the clearance; and nothing is inside of anything
  NSVCD_FREE,
  // they do, or one body, or a part of it, is inside of the other at the start
  NSVCD_HIT
} nsvcd_verdict;

// A verdict in a word; never NULL.
NSVCDDEF const char *nsvcd_verdict_string(nsvcd_verdict verdict);

// Who says so.
typedef enum nsvcd_by {
  // it is a fact. Bodies without triangles may be FREE by it too: spheres that cover their surfaces
  // never meet, and only that nothing is inside is an estimate
  NSVCD_BY_PROOF = 0,
  // it is an opinion
  NSVCD_BY_NETWORK
} nsvcd_by;

// Why not all that was asked is answered.
typedef enum nsvcd_why {
  // all of it is
  NSVCD_WHY_NOTHING = 0,
  // surfaces come within the tolerance, or 1e-9 of all lengths, and do not meet; or, of eight rays,
  // none could tell whether one is inside the other
  NSVCD_WHY_TOO_NEAR,
  // question.work was not enough
  NSVCD_WHY_WORK,
  // at the start a part of one seems to be inside the other, which is nearly a solid but not closed
  // (nsvcd_body_facts.open_components): encode that as `open`, if nothing is inside of it
  NSVCD_WHY_OPEN
} nsvcd_why;

// What is known of a number: it is no less than `low`, and no more than `high`.
typedef struct nsvcd_range {
  float low, high;
} nsvcd_range;

// Two triangles, and where they meet or are nearest.
typedef struct nsvcd_contact {
  // metres, world. Where they meet, or on b where they are nearest: on its surface, if it is round.
  // Of a large triangle, which is stored in parts, on the part that was looked at last
  float point[3];
  // world, unit, from b to a, and against the motion: with v the velocity of a's point there less
  // that of b's, v . normal is not above 0 wherever a motion has led to the contact (at a pose, v
  // is that before it). Triangles that are apart have the direction from b's nearest point to a's;
  // those that meet have the one at which they met as they go at that time. Where a corner met a
  // face that is the face's normal, on the side that the corner came from, however it is wound;
  // where an edge crossed an edge, the direction across both; where a corner met a corner or an
  // edge, or an edge an edge along it, of all directions along which they were separated still the
  // one most against v. Two contacts may be along v: triangles in touch from the start on, which
  // have the direction along which they are the least deep, out of closed surfaces; and of a
  // manifold, places where both faces are left. 0 where none are named, and where no direction is
  // known, since they have no area
  float normal[3];
  // metres between the stored triangles, of a manifold at that place, less what is round; 0: they
  // meet
  float gap;
  // in [0,1]: when, rounded up
  float time;
  // as numbered in the caller's meshes; NSVCD_NO_TRIANGLE where none are named
  uint32_t triangle_a, triangle_b;
  // that list them
  uint32_t patch_a, patch_b;
  // of a manifold: of the corner, or the two edges, that touch; the same as long as they do
  uint32_t id;
} nsvcd_contact;

// Where the bodies may go: to where they are at a time until which they are free of each other,
// pushed out of what they touch. There is no such place where they are in contact at the start and
// no lift ends that (depth is HUGE_VALF), or where one is, or may be, inside of the other: then it
// is where they are at the start, as the caller has them.
typedef struct nsvcd_safe_pose {
  // time.low, or, where they are about to touch then, a little before: by as much as poses in
  // float, and coarse triangles, are off. Never later than time.low
  float time;
  // of both, world. The push-out is in the pose of a; where only b moves, in that of b. A slop that
  // is less than what floats resolve so far from the origin is too little for them
  nsvcd_pose a, b;
} nsvcd_safe_pose;

// What the network thinks.
typedef struct nsvcd_opinion {
  // 1: it was asked. Otherwise all is 0
  int asked;
  // of collision, positive is yes: the greatest of the pairs looked at, less the threshold that
  // `recall` asks for; the search ends at the first above 3. Where the tiny decoder, which ranks
  // the pairs, is clear (beyond +-3), that one answers. NSVCD_LOGIT_CERTAIN, or its negative: no
  // decoder was needed. Asked for the distance: of the pair that comes nearest
  float logit;
  // metres, of the same pair: by how much it misses, or, negative, how deep it is. Asked for, it is
  // the least of all pairs looked at, and within a patch's radius of contact off by a tenth of it
  // or less, as a rule; else a by-product. HUGE_VALF where no decoder was needed
  float distance;
  // in [0,1]: when the most suspicious pair comes closest
  float time;
  // that pair
  uint32_t patch_a, patch_b;
  // pairs of patches whose spheres meet and that no plane between them parts, each counted once for
  // each interval of time, until the search ends
  size_t candidates;
  // 1: there were more of these than `pairs` let through
  int limited;
} nsvcd_opinion;

// One meaning a field, whatever was asked and whoever answers. What is not known is HUGE_VALF, or a
// count of 0.
typedef struct nsvcd_answer {
  nsvcd_verdict verdict;
  nsvcd_by by;
  nsvcd_why why;
  // 1: a hit, for one body or a part of it lies inside the other at the start, by proof or by the
  // network's estimate. Surfaces may meet as well: a plain question does not look for that
  int inside;
  // in [0,1], of the first contact: they are free of each other before `low`, and in contact at
  // `high`. FIRST: as near each other as `to` says. HIT, DISTANCE: low is 0, and high is the time
  // of a contact, before which there may be others; by the network, when the pair that it suspects
  // comes closest. FREE: 1, 1
  nsvcd_range time;
  // metres: the least distance over the motion, up to time.high where that is known: to the
  // clearance or less that they come, if they hit. What stored triangles are off by is allowed for,
  // and so `high` is not 0 where they meet
  nsvcd_range distance;
  nsvcd_safe_pose safe;
  // metres: of a contact at the start, the smallest push-out of a off b, up to the slop or where it
  // is made of several normals their sum, that ends it: of those along normals of what touches, or
  // across two of its edges; to a few per cent, and what stored triangles are off by. 0: there is
  // no contact at the start
  float depth;
  // metres, world, at the start: by what a was pushed out of b for the slop; it turns with b, or,
  // where a rests, or both move and a reaches farther from its origin, round and all, with a. The
  // answer is about the motion so displaced, which touches nothing at the start. 0: nothing was
  // touched, nor so near that it is pushed out of; or no push-out does that, since a is pressed in
  // deeper than the slop, or held from all sides: then the contact counts
  float push_out[3];
  // of a HIT whose triangles are known, at time.high: one, or a manifold, in the order of its ids.
  // That is of all places that are no farther apart than `to` (or the default, where only to_time
  // is given) and the clearance the four that interval most
  size_t contact_count;
  nsvcd_contact contacts[NSVCD_MAX_CONTACTS];
  // the triangles that distance.high is about, whatever the verdict: of a HIT the contact that
  // was found; of what is UNDECIDED two that come too near to tell, of FIRST the earliest. None are
  // named where none were found. Of what is inside the point alone is set, one of it
  nsvcd_contact nearest;
  nsvcd_opinion opinion;
  // units that the proof took
  size_t work;
} nsvcd_answer;

// Bytes of the workspace that nsvcd_sweep needs; 0 if the question is refused. They depend on the
// sizes of the bodies, the method, the segments, and the network's pairs and model.
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
//   errors     ARGUMENT, WORKSPACE, BODY and VERSION (by a body's first bytes), SAME, TRIANGLES or
//              LATENTS where a body lacks what the method needs, and of the question the code of
//              the field at fault: POSES, TIMES, POSE, QUATERNION, SCALE; ASK, METHOD, TO,
//              TO_TIME, CLEARANCE, SKIN, TOLERANCE, MANIFOLD, SEGMENTS; PAIRS, MODEL, PRECISION,
//              RECALL, SWELL
//   source     the proof: this library, proof/proof; the network: NeuralSVCD, algorithm 1
//
// What a proof says is about the surfaces of the two meshes, scaled and posed exactly as described.
// FREE and HIT hold for the meshes' own floats: the triangles of a HIT meet, or come within the
// clearance, to 1e-12 of all lengths (both extents and how far the bodies are apart). UNDECIDED are
// surfaces that come within 1e-9 of these without meeting, or more work than was allowed. Of bodies
// whose nsvcd_body_facts.quantization error is not 0 a HIT is one to within both quantization
// errors, and nearer than these it is undecided whether surfaces meet: they are coarse, or were
// scaled. More work never leaves undecided what less decides, nor takes more units for it, but
// where less has come to its last eighth, or half of DISTANCE. By FIRST time.low rises with it, and
// is 0 only where the first moments of the motion take more than a sixteenth of it.
//
// A motion of any length, up to NSVCD_MAX_POSES poses of each body, is one question, and takes no
// more memory than a short one. If it has more than 64 poses, or turns by more than 1,280 degrees,
// it is searched interval by interval, in the order of time: as many arcs from pose to pose as make
// 64 segments, or question.segments, of at most 20 degrees each. What is easy is searched in
// intervals that are much larger. HIT looks at both ends first. FIRST ends with the interval that
// has the first contact. Where an interval is left undecided, those after it are only asked whether
// they meet at all. Times are told as floats: of 65,536 poses they resolve a 250th of the way from
// one to the next. More poses than the limit are refused by NSVCD_ERROR_POSES.
//
// What it costs: Ga and Gb are the bodies' groups of 16 patches. A motion, or an interval, has S
// segments: 16 or so up to 320 degrees of turn, 64 at most. The search takes at most 18 S Ga Gb + 3
// S tests of 16 spheres against one. Of bodies of more than 512 patches only those groups count
// that the other body comes near, and some 16 tests more for each level of spheres and each 16
// spheres of it that it comes near. Then a proof takes question.work units. The network takes 18 S
// such tests more, as it looks at a first pair of groups twice, the tiny decoder on 12 K pairs and
// the chosen one on K (tiny alone: on 3 K), and 32 distances for each patch.
NSVCDDEF nsvcd_result nsvcd_sweep(const nsvcd_question *question, void *workspace,
                                  size_t workspace_size, nsvcd_answer *answer);

// Workspaces as constants, for arrays of a fixed size, a little larger than need be. Where one
// workspace is for both methods, take the larger.
//   patches_a, patches_b patches of the bodies, or more
//   segments             question.segments, 16 to 64
//   pairs                question.network.pairs, K
// NSVCD_MEMORY declares an array that is aligned:
//   static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(64, 192, 16));
#define NSVCD_MEMORY(name, bytes) uint64_t name[((bytes) + 7) / 8]
#define NSVCD__GROUPS_OF(patches) ((patches) > 512 ? 32 : ((patches) + 15) / 16)
#define NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) \
  (1088 + 704 * (segments) + 8 * NSVCD__GROUPS_OF(patches_a) * NSVCD__GROUPS_OF(patches_b) + \
   ((patches_a) > 512 || (patches_b) > 512 ? 1024 : 0))
#define NSVCD_PROOF_WORKSPACE_BYTES(patches_a, patches_b, segments) \
  (NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) + 24832 + 168 * (segments))
#define NSVCD_NETWORK_WORKSPACE_BYTES(patches_a, patches_b, segments, pairs) \
  (NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) + 576 + 32 * (segments) + 112 * (pairs))

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
// Answers a question by the network, with the derivatives, by the poses of a and b, of its logit,
// or, where a distance is asked for, of opinion.distance: along that is the shortest way out.
// What drives the poses (joints, a spline) goes on from there by the chain rule.
//   question   its method is not PROOF, and nothing is asked that only a proof knows
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
// Zero where no decoder was needed, and for poses that the decisive pair does not pass. It is the
// gradient of the pair and the interval of time that decided: its logit is the greatest of several,
// and so has kinks, also where the network (ReLU) and the frame of a pair have theirs, and where a
// flat patch does not turn. At rest it is the mean of both sides. The ends of the interval move
// with the poses, but for those at t = 0 or 1 and where a segment of the search begins or ends. The
// unit of length, and the spheres' allowance for what the motion does between its keyframes, are
// taken as constant. In int8 arithmetic it is the derivative of the float decoder, or, without
// that, of the function that the int8 one rounds.
NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b);
#endif
