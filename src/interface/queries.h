// In: two movers and options. Out: an answer, and its derivative.
//
// WHAT AN ANSWER IS WORTH
//   By proof, the default, FREE and HIT are facts. They are about the surfaces of the two meshes,
//   and about the motion as nsvcd_sweep describes it. The theorem stands in proof/proof, and
//   tests/test_proof.c replays its certificates in double precision. UNDECIDED comes with a reason,
//   nsvcd_why, and with the network's opinion where it has one. By the network everything is an
//   opinion, whose measured error rates are in tests/bench/RESULTS.md. Where bodies of 0.1 to 0.4 m
//   come within a millimetre of each other, two to six of a hundred answers are wrong: if a wrong
//   answer does harm, ask for a proof. Whether one body is inside the other is estimated, by a
//   winding number of patches: reliable for closed meshes.
//
// NUMERIC ROBUSTNESS, as measured by `make race`, `make bench`, tests/test_proof.c and
// tests/bench/extremes.sh
//   A query computes in float32; pairs of triangles, and whether one body is inside the other, in
//   double.
//   Range         coordinates up to NSVCD_MAX_COORDINATE; bodies from NSVCD_MIN_RADIUS, below which
//                 squares underflow. Proofs are tested from 3e-11 to 3e5 m.
//   Rounding      proofs allow for NSVCD__ROUNDING, two millionths, of the distances and extents
//                 involved: 2 um for bodies of 0.3 m, 80 um if one measures 20 m. Surfaces must be
//                 farther apart than that, and little more, to be certified free.
//   Quantization  triangles of a coarse or scaled body are off by a few micrometres at most, if it
//                 measures 0.3 m.
//   Far away      positions are first taken relative to the fixed body: a scene 10 km from the
//                 origin loses what its own coordinates lose, about 1 mm. Everything is computed in
//                 the frame of one body, the one that rests or else the larger, in units of its
//                 scale.
//   Resolution    limits the network: a patch must not be much larger than the clearance in
//                 question. A body of 5 cm against one of 20 m, with 256 patches each, is judged
//                 right in 62 % of problems near contact (RESULTS.md, *mixed*): cut the large mesh
//                 to what the motion can reach, with nsvcd_mesh_cut. For a proof, the size of
//                 patches decides only what an answer costs.
//   Bad numbers   NaN and infinity are detected by their bits and refused, also under -ffast-math.
//
// DETERMINISM
//   One binary on one processor makes the same blob of a mesh, the same answer to a question and
//   the same plan, to the bit, whatever the workspace held and in any thread. One exception: an
//   answer of nsvcd_sweep_batch may depend on the question before. Another compiler, other flags,
//   another libm, and another processor where that selects the vectors, round differently. Given
//   the same blobs, none of these refutes what another proves: by the theorem every proven verdict
//   is true. But one may leave undecided what another proves, and times, points, patches and work
//   differ. Logits differ by more than rounding: the search ends at the first pair that is clear,
//   and when a pair is near that bound, or near another in rank, another pair or decoder may
//   answer. So the network's verdict may differ where logits are near 0, or the ranker's near its
//   bounds of +-3. The same holds for bodies that two builds encode, and for plans. Joints
//   (nsvcd_plan, neuralsvcd_robot.h) are placed by libm's sines. With NSVCD_ONE_PATH, blobs without
//   latents and answers by proof are the same to the bit with SSE2, AVX2, AVX-512, NEON, SIMD128
//   and plain C, so that two machines replay a game alike: the same operations in the same order,
//   no products fused into sums, this header's own sines and angles. gcc fuses unless it is told
//   -std=c99 or the like, or -ffp-contract=off; clang fuses with -ffp-contract=fast: then
//   nsvcd_self_test returns BUILD. It costs 4 to 14 % of the time (`make bench-one-path`).
#pragma once
#include "bodies.h"

// Takes a point x from the body's frame to the world: rotation x + position.
typedef struct nsvcd_pose {
  float position[3];  // metres
  // unit quaternion x y z w; its length is 1 within NSVCD_UNIT_TOLERANCE
  float rotation[4];
} nsvcd_pose;

#define NSVCD_UNIT_TOLERANCE 1e-4f

// What is asked about two moving bodies.
typedef enum nsvcd_ask {
  // do they hit each other at all? The search ends at any contact, and the answer's time is that of
  // this contact, which is usually not the first
  NSVCD_ASK_HIT = 0,
  // do they, and when first? The answer says how far things may move
  NSVCD_ASK_FIRST,
  // do they, and how near do they come? The time is as for HIT. The network, if it is named as the
  // method, gives its opinion of the distance
  NSVCD_ASK_DISTANCE
} nsvcd_ask;

// How a question is answered.
typedef enum nsvcd_method {
  // by proof where both bodies have triangles, else by the network
  NSVCD_METHOD_DEFAULT = 0,
  NSVCD_METHOD_PROOF,   // facts
  NSVCD_METHOD_NETWORK  // an opinion, in strictly bounded time
} nsvcd_method;

// The decoders, all of the same latents: about 4, 13 and 40 thousand multiplications per pair of
// patches.
typedef enum nsvcd_model {
  // the largest that is compiled in
  NSVCD_MODEL_DEFAULT = 0,
  NSVCD_MODEL_TINY,
  NSVCD_MODEL_SMALL,
  NSVCD_MODEL_BASE
} nsvcd_model;

// The decoder's arithmetic. Latents are int8 in any case.
typedef enum nsvcd_precision {
  NSVCD_PRECISION_FLOAT = 0,
  NSVCD_PRECISION_INT8
} nsvcd_precision;

// Options of the network. Zero means the default.
typedef struct nsvcd_network_options {
  // K, the pairs of patches that are decoded, 1..NSVCD_MAX_PAIRS; 0: NSVCD_DEFAULT_PAIRS
  size_t pairs;
  nsvcd_model model;
  nsvcd_precision precision;
  // fraction of collisions to be found: 0 (balanced errors), 0.99f, 0.999f or 0.9999f
  float recall;
  // Patches are inflated by this fraction of their radii before planes separate them, so that those
  // that only come near are decoded too: the logit rises before contact and has a gradient there,
  // but more near misses are called hits. 0: as much as `recall` needs; for a distance, 1
  float inflate;
} nsvcd_network_options;

// Units of work: for DISTANCE and checks of joints; and for HIT and FIRST, of which only close fits
// need as many.
#define NSVCD_DEFAULT_WORK 100000
#define NSVCD_DEFAULT_VERDICT_WORK 10000000
#define NSVCD_NO_TRIANGLE 0xffffffffu
// of an answer
#define NSVCD_MAX_CONTACTS 4
#define NSVCD_DEFAULT_PAIRS 8
#define NSVCD_MAX_PAIRS 256
// the logit of a proven hit; proven free is its negative
#define NSVCD_LOGIT_CERTAIN 100.0f
// of the radius of the smaller body's sphere: the default of `to`
#define NSVCD_DEFAULT_TO 0.001f

#define NSVCD_NONE ((size_t)-1)
#define NSVCD_MAX_JOINTS 32

// Two bodies that can meet, by their indices.
typedef struct nsvcd_body_pair {
  uint32_t a, b;
} nsvcd_body_pair;

// A body in a scene: how it moves, and its size. Many movers may share one body.
typedef struct nsvcd_mover {
  // from nsvcd_encode, nsvcd_body_load, nsvcd_body_trust or nsvcd_body_scale
  const nsvcd_body *body;
  // (count) poses; in between the position is linear and the rotation a slerp. One: it rests there.
  // NULL, with count 0: it rests at the origin
  const nsvcd_pose *poses;
  // up to NSVCD_MAX_POSES
  size_t count;
  // (count) the times of the poses, from 0 to 1, each at least 1e-7 after the one before; rounded
  // to 2^-32. NULL: uniform
  const float *times;
  // of the body, about its origin, NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; 0: 1
  float scale;
} nsvcd_mover;

// Do two bodies hit each other? Zero is the default of everything but the bodies.
typedef struct nsvcd_question {
  // either may move, or both, over the same time; their counts of poses may differ
  nsvcd_mover a, b;
  nsvcd_ask ask;
  // metres. FIRST: how far any point of one body may travel, as the other sees it, from time.low to
  // time.high; at most a quarter of its whole travel, if triangles are stored that exactly.
  // DISTANCE: how wide the bracket may be. 0 (and to_time 0): NSVCD_DEFAULT_TO of the smaller body.
  // Not with HIT
  float to;
  // FIRST: the same as a fraction of the motion, up to 1. If both are set, both hold
  float to_time;
  // metres: coming within this distance is a hit; 0: only meeting is
  float clearance;
  // metres: initial penetration, or violation of the clearance, up to this is ignored (their sum,
  // if both). So a body may rest on another, slide along it or leave it. The question is then about
  // a body that is pushed out by this much along the normals of all that it touches at the start:
  // answer.push_out. Surfaces nearer than a twentieth of this count as touching. With FIRST, so do
  // surfaces nearer than `to`, up to half of this, so that a body that was stopped before a contact
  // can go on: entering it by less than the slop is FREE, although HIT, which has no `to`, reports
  // a contact. answer.depth is 0 for surfaces that were so near but did not touch
  float slop;
  // metres: surfaces that come closer than this (than this and the clearance) without meeting may
  // be left undecided
  float tolerance;
  // FIRST: 1: report up to four contacts that hold the body, not one
  int manifold;
  nsvcd_method method;
  // Units that a proof may take, approximately. 0: NSVCD_DEFAULT_VERDICT_WORK, for DISTANCE
  // NSVCD_DEFAULT_WORK; each interval of a long motion (see nsvcd_sweep) may then take as much, so
  // that the limit grows with the length.
  //   A unit is one search for a plane between two patches, 16 triangles against the box of 16, one
  // triangle against 16, two triangles at one time, or a ray against 16 triangles or one.
  //   A limit that is given is for the whole motion, in the order of time. When it is reached, the
  // answer tells what was proven by then. DISTANCE divides what is left among the intervals by
  // their length.
  //   Once surfaces have come too near to tell, an eighth of the limit is left; of FIRST that is
  // for what follows them, and what precedes them has the rest. FIRST keeps an eighth for what is
  // undecided by then: until when the motion is free, and whether the bodies meet at all. A
  // manifold, and the pose of a pushed-out body, may take another eighth each. With 0, these
  // eighths are of NSVCD_DEFAULT_WORK. Apart from them, a question takes the same work whatever the
  // limit
  size_t work;
  // the most segments that a motion, or each interval of a long one, is cut into: a multiple of 16
  // up to 64; 0: 64. Fewer take less memory, and make intervals shorter
  size_t segments;
  // if the network answers. It has no FIRST, clearance or slop, and no bounds of a DISTANCE: `to`
  // is for proofs
  nsvcd_network_options network;
} nsvcd_question;

typedef enum nsvcd_verdict {
  NSVCD_UNDECIDED = 0,
  // the surfaces never come within the clearance, and nothing is inside of anything
  NSVCD_FREE,
  // they do, or one body, or a part of it, is inside the other at the start
  NSVCD_HIT
} nsvcd_verdict;

// The verdict in one word; never NULL.
NSVCDDEF const char *nsvcd_verdict_string(nsvcd_verdict verdict);

// Which method reached the verdict.
typedef enum nsvcd_by {
  // a fact. Bodies without triangles can also be FREE by proof: spheres that cover their surfaces
  // never meet; only that nothing is inside is then an estimate
  NSVCD_BY_PROOF = 0,
  // an opinion
  NSVCD_BY_NETWORK
} nsvcd_by;

// Why part of the question is not answered.
typedef enum nsvcd_why {
  // all of it is
  NSVCD_WHY_NOTHING = 0,
  // surfaces come within the tolerance, within 1e-9 of all lengths, or, of coarse and scaled
  // bodies, within their quantization errors, without meeting; or none of eight rays could tell
  // whether one body is inside the other
  NSVCD_WHY_TOO_NEAR,
  // question.work was not enough
  NSVCD_WHY_WORK,
  // at the start, a part of one seems to be inside the other, which is nearly a solid (see CLOSED
  // MESHES) but not closed: encode that one as `open` if nothing is inside of it
  NSVCD_WHY_OPEN
} nsvcd_why;

// A bracket: the number is no less than `low` and no more than `high`.
typedef struct nsvcd_range {
  float low, high;
} nsvcd_range;

// Two triangles, and where they meet or are nearest.
typedef struct nsvcd_contact {
  // metres, world: where they meet, or the point of b that is nearest to a, on b's surface if it
  // has a convex radius. Large triangles are stored in parts; the point is on the part examined
  // last
  float point[3];
  // world, unit, from b to a, and against the motion: let v be the velocity of a's point relative
  // to b's; if a motion has led to the contact, v . normal <= 0 (at a pose, v is that before it).
  // For triangles that are apart it is the direction from b's nearest point to a's. For triangles
  // that meet it is the direction in which they met, by their velocities at that time. A corner on
  // a face: the face's normal, on the side that the corner came from, whatever the winding. An edge
  // across an edge: the direction across both. A corner on a corner or an edge, or an edge along an
  // edge: of all directions that still separated them, the one most against v.
  //   Two kinds of contacts may point along v: triangles that touch from the start, which have the
  // direction of least depth, out of closed surfaces; and points of a manifold where both faces are
  // being left. 0 if no triangles are named, or if they have no area and so no direction
  float normal[3];
  // metres between the stored triangles, less convex radii; in a manifold, at that point. 0: they
  // meet
  float gap;
  // in [0,1], rounded up
  float time;
  // as numbered in the caller's meshes; NSVCD_NO_TRIANGLE if none are named
  uint32_t triangle_a, triangle_b;
  // that hold these triangles
  uint32_t patch_a, patch_b;
  // in a manifold: identifies the corner, or the two edges, that touch; the same as long as they do
  uint32_t id;
} nsvcd_contact;

// Where the bodies may go: their poses at a time until which they are free of each other, pushed
// out of what they touch. No such pose exists if they are in contact at the start and no push-out
// ends that (depth is HUGE_VALF), or if one is, or may be, inside the other: then these are the
// poses at the start, as the caller gave them.
typedef struct nsvcd_safe_pose {
  // time.low; or, if they are about to touch then, a little less: by the error of poses in float
  // and of coarse triangles
  float time;
  // world. The push-out is in the pose of a, or of b if only b moves. A slop below the resolution
  // of floats at that distance from the origin is lost in rounding
  nsvcd_pose a, b;
} nsvcd_safe_pose;

// What the network estimates.
typedef struct nsvcd_opinion {
  // 1: it was asked. Otherwise everything here is 0
  int asked;
  // of collision; positive means yes. The largest of the pairs decoded, less the threshold for
  // `recall`; the search ends at the first above 3. Where the tiny decoder, which ranks the pairs,
  // is clear (beyond +-3), its logit is the answer. NSVCD_LOGIT_CERTAIN or its negative: no decoder
  // was needed. For DISTANCE: of the pair that comes nearest
  float logit;
  // metres, of the same pair: the gap, or, negative, the depth. For DISTANCE it is the least of all
  // pairs decoded, and within a patch's radius of contact usually right to a tenth of that radius;
  // otherwise a by-product. HUGE_VALF if no decoder was needed
  float distance;
  // in [0,1]: when the most suspicious pair comes closest
  float time;
  // that pair
  uint32_t patch_a, patch_b;
  // pairs of patches whose spheres meet and that no plane separates, each counted once per interval
  // of time, until the search ends
  size_t candidates;
  // 1: there were more candidates than `pairs` let through
  int limited;
} nsvcd_opinion;

// Each field means the same whatever was asked and by which method. Unknown numbers are HUGE_VALF,
// unknown counts 0.
typedef struct nsvcd_answer {
  nsvcd_verdict verdict;
  nsvcd_by by;
  nsvcd_why why;
  // 1: a hit because one body, or a part of it, lies inside the other at the start, by proof or by
  // the network's estimate. Their surfaces may meet as well: HIT without a slop does not look
  int inside;
  // in [0,1], of the first contact: the bodies are free of each other before `low`, and in contact
  // at `high`. FIRST: as close together as `to` says. HIT, DISTANCE: low is 0, and high the time of
  // some contact, perhaps not the first; by the network, when the pair that it suspects comes
  // closest. FREE: 1, 1
  nsvcd_range time;
  // metres: the least distance over the motion, up to time.high if that is known; for a hit, at
  // most the clearance. Quantization errors are allowed for, so `high` may be above 0 even where
  // they meet
  nsvcd_range distance;
  nsvcd_safe_pose safe;
  // metres: of a contact at the start, the smallest push-out of a from b that ends it, up to the
  // slop (or, if it combines several normals, their sum): along normals of what touches, or across
  // two of its edges; to within a few per cent and quantization errors. 0: no contact at the start
  float depth;
  // metres, world, at the start: how a was pushed out of b for the slop. It turns with b; or with
  // a, if a rests, or if both move and a's extent, convex radius included, is the larger. The
  // answer is about the motion displaced by it, which touches nothing at the start. 0: nothing
  // touched, or was near enough to count; or no push-out helps, since a is pressed in deeper than
  // the slop or held from all sides: then the contact counts
  float push_out[3];
  // of a HIT with known triangles, at time.high: one contact; or a manifold, in the order of its
  // ids: of all points no farther apart than the clearance and `to` (its default if only to_time is
  // given), the four that span the largest area
  size_t contact_count;
  nsvcd_contact contacts[NSVCD_MAX_CONTACTS];
  // the triangles that distance.high is about, whatever the verdict. HIT: the contact that was
  // found; UNDECIDED: two that come too near to tell, for FIRST the earliest such. No triangles are
  // named if none were found. If one body is inside the other, only the point is set, to one of the
  // inner body
  nsvcd_contact nearest;
  nsvcd_opinion opinion;
  // units that the proof took
  size_t work;
} nsvcd_answer;

// Bytes of workspace that nsvcd_sweep needs; 0 if the question is refused. They depend on the sizes
// of the bodies, the method, the segments, and the network's pairs and model.
//   question   NULL: enough for any question
NSVCDDEF size_t nsvcd_sweep_workspace_size(const nsvcd_question *question);

// Answers a question. Same question, same answer, in one build (see DETERMINISM), and the same
// verdict if a and b are swapped.
//   question   not NULL
//   workspace  (workspace_size) bytes, nsvcd_sweep_workspace_size(question) or more, not NULL,
//              aligned to NSVCD_ALIGNMENT
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a workspace of its own; bodies may be shared
//   errors     ARGUMENT, WORKSPACE, BODY and VERSION (by a body's first bytes), SAME, TRIANGLES or
//              LATENTS if a body lacks what the method needs, and the code of the field at fault:
//              POSES, TIMES, POSE, QUATERNION, SCALE; ASK, METHOD, TO, TO_TIME, CLEARANCE, SLOP,
//              TOLERANCE, MANIFOLD, SEGMENTS; PAIRS, MODEL, PRECISION, RECALL, INFLATE
//   source     the proof: this library, proof/proof; the network: NeuralSVCD, algorithm 1
//
// What is proven is about the surfaces of the two meshes, scaled and posed exactly as described.
// FREE and HIT hold for the meshes' own floats: the triangles of a HIT meet, or come within the
// clearance, to 1e-12 of all lengths (both extents and the distance of the bodies). UNDECIDED are
// surfaces that come within 1e-9 of these without meeting, or questions that take more work than
// allowed. If a body's nsvcd_body_facts.quantization_error is not 0 (it is coarse, or was scaled),
// a HIT is one to within both errors, and surfaces nearer than these errors are undecided.
//
// More work never leaves undecided what less decides, nor takes more units for it, unless less has
// reached its last eighth (DISTANCE: its half). For FIRST, time.low rises with the work, and is 0
// only if the first moments of the motion take more than a sixteenth of the work.
//
// A motion of any length, up to NSVCD_MAX_POSES poses of each body, is one question, and takes no
// more memory than a short one. With more than 64 poses, or more than 1,280 degrees of turn, it is
// searched interval by interval, in the order of time: an interval has as many arcs from pose to
// pose as make 64 segments, or question.segments, of at most 20 degrees each. Easy parts are
// searched in much larger intervals. HIT tries both ends first. FIRST ends with the interval that
// has the first contact. After an undecided interval, later ones are only asked whether the bodies
// meet at all. Times are floats: among 65,536 poses they resolve a 250th of the time from one to
// the next. More poses are refused with NSVCD_ERROR_POSES.
//
// Cost: let Ga and Gb be the bodies' numbers of groups of 16 patches, and S the number of segments
// of the motion or interval: about 16 up to 320 degrees of turn, 64 at most. The search takes at
// most 18 S Ga Gb + 3 S tests of 16 spheres against one. For bodies of more than 512 patches, only
// groups that the other body comes near count, and about 16 more tests for each level of spheres
// and each 16 spheres of it that it comes near. Then a proof takes up to question.work units. The
// network takes 18 S more tests, since it searches a first pair of groups twice, the tiny decoder
// on 12 K pairs and the chosen one on K (the tiny alone: on 3 K), and 32 distances per patch.
NSVCDDEF nsvcd_result nsvcd_sweep(const nsvcd_question *question, void *workspace,
                                  size_t workspace_size, nsvcd_answer *answer);

// Workspace sizes as constants, for arrays of a fixed size, slightly larger than needed. For both
// methods, take the larger.
//   patches_a, patches_b patches of the bodies, or more
//   segments             question.segments, 16 to 64
//   pairs                question.network.pairs, K
// NSVCD_MEMORY declares an aligned array:
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

// Answers many questions, such as a frame of a game or a sampling planner has. If a question and
// the one before it ask the network about the same two bodies, the pair of patches that collided
// before is tried first. If it collides clearly again (logit above 3), that is the answer, and
// nothing else is searched. All other answers are nsvcd_sweep's, to the bit.
//   questions  (count); count may be 0
//   workspace  as for nsvcd_sweep, large enough for each question
//   answers    (count); left as they were on failure
//   allocates  nothing
//   threads    as nsvcd_sweep
//   errors     those of nsvcd_sweep, for the first question that has one
//   source     this library; physics engines call it temporal coherence
NSVCDDEF nsvcd_result nsvcd_sweep_batch(const nsvcd_question *questions, size_t count,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answers);

#ifndef NSVCD_NO_GRADIENT
// Answers a question by the network, with the derivatives of its logit by the poses of a and b; for
// DISTANCE, of opinion.distance, along which lies the shortest way out. Whatever drives the poses
// (joints, a spline) goes on from there by the chain rule.
//   question   its method is not PROOF, and it asks nothing that only a proof answers
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
// It is zero if no decoder was needed, and for poses that do not affect the decisive pair. It is
// the gradient of the pair and the interval of time that decided. As a maximum over pairs, the
// logit has kinks; it also has those of the network (ReLU) and of a pair's frame, and some where a
// flat patch does not turn. At rest it is the mean of both sides. The ends of the interval move
// with the poses, except at t = 0 and 1 and where a segment of the search begins or ends. The unit
// of length, and the spheres' allowance for the motion between keyframes, are taken as constant.
// With int8 it is the derivative of the float decoder, or, if that is compiled out, of the function
// that int8 rounds.
NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b);
#endif
