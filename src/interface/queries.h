// In: two movers and options. Out: an answer, and its derivative.
//
// WHAT AN ANSWER IS WORTH
//   By proof, the default, FREE and HIT are facts. They are about the surfaces of the two meshes,
//   and about the motion as nsvcd_sweep describes it. The theorem stands in proof/proof, and
//   tests/test_proof.c replays its certificates in double precision. UNDECIDED comes with a reason,
//   nsvcd_why, and with the network's opinion where it has one.
//
//   By the network, everything is an opinion. Its measured error rates are in
//   tests/bench/RESULTS.md: two to six of a hundred answers are wrong where bodies of 0.1 to 0.4 m
//   come within a millimetre of each other. If a wrong answer does harm, ask for a proof. Whether
//   one body is inside the other is estimated by a winding number of patches, which is reliable for
//   closed meshes.
//
// NUMERIC ROBUSTNESS, as measured by `make race`, `make bench`, tests/test_proof.c and
// tests/bench/extremes.sh
//   A query computes in float32, but for triangle pairs and containment, which are computed in
//   double.
//   Range         Coordinates reach up to NSVCD_MAX_COORDINATE. Radii of bodies begin at
//                 NSVCD_MIN_RADIUS, below which squares underflow. Proofs are tested from 3e-11 to
//                 3e5 m.
//   Rounding      Proofs allow for NSVCD__ROUNDING, two millionths, of the distances and extents
//                 involved: 2 um for bodies of 0.3 m, 80 um if one measures 20 m. Surfaces must be
//                 farther apart than that, and little more, to be certified free.
//   Quantization  Triangles of a coarse or scaled body are off by a few micrometres at most, if it
//                 measures 0.3 m.
//   Far away      Positions are first taken relative to one body, which is the one that rests, or
//                 else the larger. Everything is computed in its frame, in units of its scale. So a
//                 scene 10 km from the origin loses only what its own coordinates lose, about 1 mm.
//   Resolution    The network needs patches that are not much larger than the clearance in
//                 question. For a body of 5 cm against one of 20 m, with 256 patches each, 62 % of
//                 its answers near contact are right (RESULTS.md, *mixed*). Cut the large mesh to
//                 what the motion can reach, with nsvcd_mesh_cut. For a proof, the size of patches
//                 decides only what an answer costs.
//   Bad numbers   NaN and infinity are refused, also under -ffast-math: their bits are tested.
//
// DETERMINISM
//   One binary on one processor makes the same blob of a mesh, the same answer to a question and
//   the same plan, to the bit, whatever the workspace held and in any thread. There is one
//   exception: an answer of nsvcd_sweep_batch may depend on the question before it.
//
//   Two builds round differently if their compilers, flags or libms differ. So does one build on
//   two processors that select different vectors. Given the same blobs, one never refutes what the
//   other proves: by the theorem, every proven verdict is true. But one may leave undecided what
//   the other proves, and times, points, patches and work differ.
//
//   The network's logits differ by more than rounding. Its search ends at the first pair that is
//   clear. Where a pair is near that bound, or near another pair in rank, two builds may answer by
//   different pairs or decoders. So the network's verdict may differ where the logit is near 0, or
//   the ranker's near its bounds of +-3. So may bodies that two builds encode, and plans. The
//   joints of nsvcd_plan and neuralsvcd_robot.h are placed by libm's sines.
//
//   NSVCD_ONE_PATH makes blobs without latents, and answers by proof, the same to the bit with
//   SSE2, AVX2, AVX-512, NEON, SIMD128 and plain C, so that two machines replay a game alike. It
//   does the same operations in the same order, fuses no products into sums, and has its own sines
//   and angles. It costs 4 to 14 % of the time (`make bench-one-path`). The compiler must not fuse
//   either: gcc does unless it is told -std=c99 or the like, or -ffp-contract=off; clang does with
//   -ffp-contract=fast. In a build that fuses, nsvcd_self_test returns BUILD.
#pragma once
#include "bodies.h"

// The place of a body. A point x of its frame is at `rotation` x + position in the world.
typedef struct nsvcd_pose {
  float position[3];  // metres
  // unit quaternion x y z w; its length is 1 within NSVCD_UNIT_TOLERANCE
  float rotation[4];
} nsvcd_pose;

#define NSVCD_UNIT_TOLERANCE 1e-4f

// What is asked about two moving bodies.
typedef enum nsvcd_ask {
  // do they hit each other at all? The search ends at any contact. The answer's time is that of
  // this contact, which is usually not the first
  NSVCD_ASK_HIT = 0,
  // do they, and when first? The answer also says how far the bodies may move
  NSVCD_ASK_FIRST,
  // do they, and how near do they come? The answer's time is that of some contact, as for HIT. The
  // network gives its opinion of the distance if it is named as the method
  NSVCD_ASK_DISTANCE
} nsvcd_ask;

// How a question is answered.
typedef enum nsvcd_method {
  // by proof where both bodies have triangles, else by the network
  NSVCD_METHOD_DEFAULT = 0,
  NSVCD_METHOD_PROOF,   // facts
  NSVCD_METHOD_NETWORK  // an opinion, in strictly bounded time
} nsvcd_method;

// The network's decoders. All decode the same latents. They take about 4, 13 and 40 thousand
// multiplications for each pair of patches.
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
  // K, the number of patch pairs that are decoded, 1..NSVCD_MAX_PAIRS; default NSVCD_DEFAULT_PAIRS
  size_t pairs;
  nsvcd_model model;
  nsvcd_precision precision;
  // fraction of collisions to be found: 0.99f, 0.999f or 0.9999f; default 0, balanced errors
  float recall;
  // fraction of their radii by which patches are inflated before planes separate them; default as
  // much as `recall` needs, or 1 for a distance. Patches that only come near are then decoded too:
  // the logit rises before contact and has a gradient there, but more near misses are called hits
  float inflate;
} nsvcd_network_options;

// units of work for DISTANCE and for checks of joints
#define NSVCD_DEFAULT_WORK 100000
// units of work for HIT and FIRST; only close fits need as many
#define NSVCD_DEFAULT_VERDICT_WORK 10000000
#define NSVCD_NO_TRIANGLE 0xffffffffu
// the most contacts of an answer
#define NSVCD_MAX_CONTACTS 4
#define NSVCD_DEFAULT_PAIRS 8
#define NSVCD_MAX_PAIRS 256
// the logit of a proven hit; proven free is its negative
#define NSVCD_LOGIT_CERTAIN 100.0f
// the default of `to`, as a fraction of the radius of the smaller body's sphere
#define NSVCD_DEFAULT_TO 0.001f

// no index
#define NSVCD_NONE ((size_t)-1)
#define NSVCD_MAX_JOINTS 128

// Two bodies that can meet, by their indices.
typedef struct nsvcd_body_pair {
  uint32_t a, b;
} nsvcd_body_pair;

// A body in a question: its motion and its size. Many movers may share one body.
typedef struct nsvcd_mover {
  // the body, from nsvcd_encode, nsvcd_body_load, nsvcd_body_trust or nsvcd_body_scale
  const nsvcd_body *body;
  // (count) poses. Between two of them the rotation is a slerp, and the position of the pivot is
  // linear in time. One pose: the body rests there. NULL, with count 0: it rests at the origin
  const nsvcd_pose *poses;
  // number of poses, up to NSVCD_MAX_POSES
  size_t count;
  // (count) times of the poses, from 0 to 1, each at least 1e-7 after the one before; they are
  // rounded to 2^-32. NULL: uniform
  const float *times;
  // scale of the body about its origin, NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; default 1
  float scale;
  // the pivot, a point of the body's frame before scaling: between two poses it goes straight, and
  // the body turns about it. Default its origin. A body in flight turns about its centre of mass, a
  // door about any point of its hinge, a screw about any point of its axis
  float pivot[3];
} nsvcd_mover;

// A question about two bodies. Zero is the default of everything but the bodies.
typedef struct nsvcd_question {
  // the bodies. Either may move, or both, over the same time; their counts of poses may differ
  nsvcd_mover a, b;
  nsvcd_ask ask;
  // metres: how exact the answer has to be; not set with HIT. FIRST: no point of one body travels
  // farther than this from time.low to time.high, as the other body sees it. Nor does it travel
  // more than a quarter of its whole way, if triangles are stored that exactly. DISTANCE: the
  // bracket is no wider than this and the quantization errors. Default NSVCD_DEFAULT_TO, unless
  // to_time is set
  float to;
  // how exact a FIRST has to be, as a fraction of the motion, up to 1: time.low to time.high is no
  // longer, down to 5e-7, since they are floats. With `to`, both hold. Default: only `to` holds
  float to_time;
  // metres: coming within this distance is a hit; default 0: only meeting is
  float clearance;
  // metres: a contact at the start does not count if it is no deeper than this. So a body may rest
  // on another, slide along it or leave it. Its depth is that of the penetration, or of the
  // violation of the clearance, or the sum of both.
  //   The question is then about a body that is pushed out by the slop (answer.push_out), along the
  // normals of all that it touches at the start. Surfaces nearer than a twentieth of the slop count
  // as touching.
  //   With FIRST, so do surfaces nearer than `to`, up to half of the slop. A body that was stopped
  // before a contact can then go on: entering it by less than the slop is FREE, although HIT, which
  // has no `to`, reports a contact. Where surfaces were so near but did not touch, answer.depth
  // is 0
  float slop;
  // metres: surfaces that come within the clearance and this together, but not within the
  // clearance, may be left undecided
  float tolerance;
  // FIRST: 1 reports up to NSVCD_MAX_CONTACTS contacts, which hold the body; default one contact
  int manifold;
  nsvcd_method method;
  // units that a proof may take, approximately; default NSVCD_DEFAULT_VERDICT_WORK, for DISTANCE
  // NSVCD_DEFAULT_WORK. By default, each interval of a long motion (see nsvcd_sweep) may take as
  // much, so that the limit grows with the length.
  //   A unit is one search for a plane between two patches, 16 triangles against the box of 16, one
  // triangle against 16, two triangles at one time, or a ray against 16 triangles or one.
  //   A limit that is given is for the whole motion, in the order of time. When it is reached, the
  // answer tells what was proven by then. DISTANCE divides what is left among the intervals by
  // their length.
  //   An eighth of the limit (by default, of NSVCD_DEFAULT_WORK) is a reserve. Once surfaces have
  // come too near to tell, only the reserve is left. FIRST spends it on what follows them, and the
  // rest of the limit on what precedes them. FIRST also has the reserve for what is undecided when
  // the limit is reached: until when the motion is free, and whether the bodies meet at all. A
  // manifold may take another eighth, and so may the pose of a pushed-out body. Apart from these
  // eighths, a question takes the same work whatever the limit
  size_t work;
  // the most segments that a motion, or each interval of a long one, is cut into: 16, 32, 48 or 64;
  // default 64. Fewer segments take less memory, and make intervals shorter
  size_t segments;
  // options of the network, if it answers. The network has no FIRST, no clearance and no slop, and
  // does not bracket a DISTANCE: `to` is for proofs
  nsvcd_network_options network;
  // 1: the question is about the surfaces alone: a body that lies inside the other, off its
  // surface, is FREE of it, and has a distance. For proofs
  int surfaces;
  // called about every 1,000 units of a proof's work; may be NULL. If it returns anything but 0,
  // the proof ends as if there were no more units
  int (*stop)(void *user);
  // passed to `stop`
  void *user;
} nsvcd_question;

typedef enum nsvcd_verdict {
  // neither is known; nsvcd_answer.why has the reason
  NSVCD_UNDECIDED = 0,
  // the surfaces never come within the clearance, and no part of one body is inside the other
  NSVCD_FREE,
  // the surfaces come within the clearance, or one body, or a part of it, is inside the other at
  // the start
  NSVCD_HIT
} nsvcd_verdict;

// The verdict in one word; never NULL.
NSVCDDEF const char *nsvcd_verdict_string(nsvcd_verdict verdict);

// Which method reached the verdict.
typedef enum nsvcd_by {
  // a fact. Bodies without triangles can also be FREE by proof, if spheres that cover their
  // surfaces never meet. Whether one of them is inside the other is then still an estimate
  NSVCD_BY_PROOF = 0,
  // an opinion
  NSVCD_BY_NETWORK
} nsvcd_by;

// Why part of the question is not answered.
typedef enum nsvcd_why {
  // all of it is answered
  NSVCD_WHY_NOTHING = 0,
  // surfaces come too near each other without meeting: within question.tolerance, or within 1e-9 of
  // all lengths, or, if a body is coarse or scaled, within the quantization errors. Or eight rays
  // could not tell whether one body is inside the other
  NSVCD_WHY_TOO_NEAR,
  // question.work was not enough
  NSVCD_WHY_WORK,
  // a part of one body seems to be inside the other at the start, and the other is nearly a solid
  // but not closed (see CLOSED MESHES). If nothing is inside it, encode it as `open`
  NSVCD_WHY_OPEN
} nsvcd_why;

// A bracket: the number is no less than `low` and no more than `high`.
typedef struct nsvcd_range {
  float low, high;
} nsvcd_range;

// Two triangles, and where they meet or are nearest.
typedef struct nsvcd_contact {
  // metres, world: where the triangles meet, or else the point of b's that is nearest to a's. If b
  // has a convex radius, the point is on b's surface. Large triangles are stored in parts: the
  // point is on the part examined last
  float point[3];
  // unit, world: the direction from b to a, against the motion. Let v be the velocity of a's point
  // relative to b's; if the contact is at a pose, just before that. If a motion has led to the
  // contact, v . normal <= 0.
  //   Triangles that are apart have the direction from b's nearest point to a's. Triangles that
  // meet have the direction in which they met, by their velocities at that time. A corner on a face
  // has the face's normal, on the side that the corner came from, whatever the winding. An edge
  // across an edge has the direction across both. A corner on a corner or an edge, or an edge along
  // an edge, has the direction most against v of all that still separated them.
  //   Two kinds of normals may point along v. Triangles that touch from the start have the
  // direction of least depth, out of closed surfaces. A manifold has points where both faces are
  // being left.
  //   The normal is 0 if no triangles are named, or if they have no area and so no direction
  float normal[3];
  // metres: the distance of the stored triangles, less convex radii; 0: they meet. In a manifold it
  // is the distance at that point
  float gap;
  // time of the contact in [0,1], rounded up
  float time;
  // the triangles' numbers in the caller's meshes; NSVCD_NO_TRIANGLE if none are named
  uint32_t triangle_a, triangle_b;
  // the patches that hold these triangles
  uint32_t patch_a, patch_b;
  // in a manifold: a number of the corner, or of the two edges, that touch. It stays the same as
  // long as these touch
  uint32_t id;
} nsvcd_contact;

// Where the bodies may go: their poses at a time until which they are free of each other, pushed
// out of what they touch; nsvcd_world_slide goes on from there. There is no such pose if they are
// in contact at the start and no push-out ends that (answer.depth is HUGE_VALF), or if one body is,
// or may be, inside the other. Then the poses are those at the start, as the caller gave them.
typedef struct nsvcd_safe_pose {
  // time of the poses: time.low of the answer. If the bodies are about to touch then, it is a
  // little less, by the error of poses in float and of coarse triangles
  float time;
  // world. The push-out is in the pose of a, or of b if only b moves. A slop below the resolution
  // of floats at that distance from the origin is lost in rounding
  nsvcd_pose a, b;
} nsvcd_safe_pose;

// What the network estimates.
typedef struct nsvcd_opinion {
  // 1: the network was asked. 0: everything here is 0
  int asked;
  // logit of a collision; positive means yes. It is the largest of the pairs decoded, less the
  // threshold for `recall`. The search ends at the first logit above 3. Where the tiny decoder,
  // which ranks the pairs, is clear (beyond +-3), its logit is the answer. NSVCD_LOGIT_CERTAIN or
  // its negative: no decoder was needed. DISTANCE: the logit of the pair that comes nearest
  float logit;
  // metres: the gap of the pair that `logit` is of; if negative, the depth. HUGE_VALF: no decoder
  // was needed. DISTANCE: the least gap of all pairs decoded, which within a patch's radius of
  // contact is usually right to a tenth of that radius. For other questions it is a by-product
  float distance;
  // time in [0,1] at which the most suspicious pair comes closest
  float time;
  // the patches of that pair
  uint32_t patch_a, patch_b;
  // number of patch pairs whose spheres meet and that no plane separates, until the search ends. A
  // pair counts once in each interval of time
  size_t candidates;
  // 1: there were more candidates than `pairs` let through
  int limited;
} nsvcd_opinion;

// What is known. Each field means the same whatever was asked and by which method. Unknown numbers
// are HUGE_VALF, unknown counts 0.
typedef struct nsvcd_answer {
  nsvcd_verdict verdict;
  nsvcd_by by;
  // the reason if the verdict is UNDECIDED, or if a bracket of the time or distance is wider than
  // the question says; else NSVCD_WHY_NOTHING. Of several reasons the first in this order is given:
  // OPEN; WORK, if it is the bracket of a DISTANCE that is too wide; TOO_NEAR; WORK
  nsvcd_why why;
  // 1: a hit because one body, or a part of it, lies inside the other at the start, by proof or by
  // the network's estimate. Their surfaces may meet as well: HIT without a slop does not look
  int inside;
  // time of the first contact, in [0,1]: the bodies are free of each other before `low`, and in
  // contact at `high`. FIRST: both are as close together as `to` and to_time say. HIT and DISTANCE:
  // low is 0, and high is the time of some contact, perhaps not the first. By the network, high is
  // when the pair that it suspects comes closest. FREE: both are 1
  nsvcd_range time;
  // metres: the least distance over the motion, or up to time.high if that is known. The distance
  // of a hit is at most the clearance. Quantization errors are allowed for, so `high` may be above
  // 0 even where the surfaces meet
  nsvcd_range distance;
  nsvcd_safe_pose safe;
  // metres: how deep a contact at the start is, to within a few per cent and quantization errors.
  // That is the length of the smallest push-out of a from b that ends it, along normals of what
  // touches, or across two of its edges. The push-out goes up to the slop along each of these, so
  // it may be longer where it combines several. 0: there is no contact at the start
  float depth;
  // metres, world, at the start: how a was pushed out of b for the slop. The answer is about the
  // motion displaced by it, which touches nothing at the start. The push-out turns with b; or with
  // a, if a rests, or if both move and a's extent, convex radius included, is the larger.
  //   It is 0 if nothing touched or was near enough to count. It is also 0 if no push-out helps,
  // since a is pressed in deeper than the slop or held from all sides. Then the contact counts
  float push_out[3];
  // number of contacts at time.high, of a HIT with known triangles: one, or those of a manifold
  size_t contact_count;
  // the contacts. A manifold has those four points that span the largest area, of all that are no
  // farther apart than the clearance and `to` (its default if only to_time is given). They are in
  // the order of their ids
  nsvcd_contact contacts[NSVCD_MAX_CONTACTS];
  // the two triangles that distance.high is about, whatever the verdict. HIT: the contact that was
  // found. UNDECIDED: two that come too near to tell, for FIRST the earliest such. No triangles are
  // named if none were found. If one body is inside the other, only the point is set, to a point of
  // the inner body
  nsvcd_contact nearest;
  nsvcd_opinion opinion;
  // units that the proof took
  size_t work;
} nsvcd_answer;

// Bytes of workspace that nsvcd_sweep needs; 0 if the question is refused. They depend on the sizes
// of the bodies, the method, the segments, and the network's pairs and model.
//   question   NULL: enough for any question
NSVCDDEF size_t nsvcd_sweep_workspace_size(const nsvcd_question *question);

// Answers a question. The same question gets the same answer, in one build (see DETERMINISM), and
// the same verdict if a and b are swapped.
//   question   not NULL
//   workspace  (workspace_size) bytes, nsvcd_sweep_workspace_size(question) or more, not NULL,
//              aligned to NSVCD_ALIGNMENT
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a workspace of its own; bodies may be shared
//   errors     ARGUMENT, WORKSPACE, BODY and VERSION (by a body's first bytes), SAME, TRIANGLES or
//              LATENTS if a body lacks what the method needs, and the code of the field at fault:
//              POSES, TIMES, POSE, QUATERNION, SCALE, PIVOT; ASK, METHOD, TO, TO_TIME, CLEARANCE,
//              SLOP, TOLERANCE, MANIFOLD, SEGMENTS; PAIRS, MODEL, PRECISION, RECALL, INFLATE
//   source     the proof: this library, proof/proof; the network: NeuralSVCD, algorithm 1
//
// What is proven is about the surfaces of the two meshes, scaled and posed exactly as described.
// FREE and HIT hold for the meshes' own floats. The triangles of a HIT meet, or come within the
// clearance, to 1e-12 of all lengths: both extents and the distance of the bodies. A question is
// UNDECIDED if surfaces come within 1e-9 of these lengths without meeting, or if it takes more work
// than allowed. Bodies that are coarse or were scaled have a quantization error, which
// nsvcd_body_facts tells. Their HIT is one to within both bodies' errors, and surfaces nearer than
// these errors are undecided.
//
// More work never leaves undecided what less decides. Nor does it take more units for that, unless
// less has reached its last eighth (DISTANCE: its half). For FIRST, time.low rises with the work,
// and is 0 only if the first moments of the motion take more than a sixteenth of the work.
//
// A motion of any length, up to NSVCD_MAX_POSES poses of each body, is one question, and takes no
// more memory than a short one. More poses are refused with NSVCD_ERROR_POSES. Times are floats:
// among 65,536 poses they resolve a 250th of the time from one to the next.
//
// A long motion, with more than 64 poses or more than 1,280 degrees of turn, is searched interval
// by interval, in the order of time. An interval has as many arcs from pose to pose as make 64
// segments, or question.segments, of at most 20 degrees each. Easy parts are searched in much
// larger intervals. HIT tries both ends of the motion first. FIRST ends with the interval that has
// the first contact. After an undecided interval, later ones are only asked whether the bodies meet
// at all.
//
// What it costs: let Ga and Gb be the bodies' numbers of groups of 16 patches. Let S be the number
// of segments of the motion or interval: about 16 up to 320 degrees of turn, 64 at most. The search
// takes at most 18 S Ga Gb + 3 S tests of 16 spheres against one. In a body of more than 512
// patches, only groups that the other body comes near count. About 16 more tests are made there for
// each level of spheres, and for each 16 spheres of it that the other body comes near. Then a proof
// takes up to question.work units. The network takes 18 S more tests, since it searches a first
// pair of groups twice. It runs the tiny decoder on 12 K pairs and the chosen one on K (the tiny
// alone: on 3 K), and computes 32 distances for each patch.
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

// Answers many questions, such as a frame of a game or a sampling planner has. The answers are
// those of nsvcd_sweep, to the bit, with one exception. If a question and the one before it ask the
// network about the same two bodies, the pair of patches that collided before is tried first. If
// that pair collides clearly again (logit above 3), it is the answer, and nothing else is searched.
//   questions  (count); count may be 0
//   workspace  (workspace_size) bytes, as for nsvcd_sweep, large enough for each question
//   answers    (count); left as they were on failure
//   allocates  nothing
//   threads    each needs a workspace of its own; bodies may be shared
//   errors     those of nsvcd_sweep, for the first question that has one
//   source     this library; physics engines call it temporal coherence
NSVCDDEF nsvcd_result nsvcd_sweep_batch(const nsvcd_question *questions, size_t count,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answers);

#ifndef NSVCD_NO_GRADIENT
// Answers a question by the network, with the derivatives of its logit by the poses of a and b. For
// DISTANCE they are the derivatives of opinion.distance, along which lies the shortest way out.
// Whatever drives the poses (joints, a spline) goes on from there by the chain rule.
//   question   its method is not PROOF, and it asks nothing that only a proof answers
//   workspace, answer   as for nsvcd_sweep
//   gradient_a, gradient_b   (count, 6), one row for a body without poses; one of them may be NULL;
//              left as they were on failure. A pose's row has the derivatives by a displacement of
//              the body's origin (metres, world axes), then by a small rotation about that origin
//              (rotation vector, radians, world axes, applied on the left)
//   allocates  nothing
//   threads    each needs a workspace of its own; bodies may be shared
//   errors     those of nsvcd_sweep
//   source     reverse mode; this library
//
// The gradient is that of the pair and the interval of time that decided. It is zero if no decoder
// was needed, and for poses that do not affect that pair. As a maximum over pairs, the logit has
// kinks. Others come from the network (ReLU) and from a pair's frame, and there are some where a
// flat patch does not turn. There is one where nothing moves: the gradient is then the mean of both
// its sides. The ends of the interval move with the poses, except at t = 0 and 1 and where a
// segment of the search begins or ends. The unit of length, and the spheres' allowance for the
// motion between keyframes, are taken as constant. With int8 it is the derivative of the float
// decoder, or, if that is compiled out, of the function that int8 rounds.
NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b);
#endif
