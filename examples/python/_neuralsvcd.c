// SPDX-License-Identifier: MIT
// _neuralsvcd.c - the library as the module neuralsvcd loads it, with ctypes, which knows nothing of
// the header. So that a changed header cannot break it silently, prototypes are compared here, and
// the layout of structs is told to the module, which compares it on import.
#define NSVCD_NO_STDIO  // Python reads the files
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "neuralsvcd.h"
#include "extras/neuralsvcd_certify.h"
#include "extras/neuralsvcd_robot.h"
#include "extras/neuralsvcd_world.h"
#include "examples/scenery/mesh_files.h"

// The functions as the module calls them. If the header says otherwise, this does not compile.
const char *nsvcd_result_string(nsvcd_result);
nsvcd_result nsvcd_mesh_cut(const nsvcd_mesh *, const float[3], const float[3],
                            const nsvcd_allocator *, nsvcd_mesh *);
nsvcd_result nsvcd_mesh_hull(const float *, size_t, const nsvcd_allocator *, nsvcd_mesh *);
nsvcd_result nsvcd_mesh_of_heights(const float *, size_t, size_t, const float[2],
                                   const nsvcd_allocator *, nsvcd_mesh *);
void nsvcd_mesh_free(nsvcd_mesh *, const nsvcd_allocator *);
nsvcd_result nsvcd_encode(const nsvcd_mesh *, const nsvcd_encode_options *, const nsvcd_allocator *,
                          void *, size_t, const nsvcd_body **);
nsvcd_result nsvcd_encode_box(const float[3], float, const nsvcd_allocator *, const nsvcd_body **);
void nsvcd_body_free(const nsvcd_body *, const nsvcd_allocator *);
nsvcd_result nsvcd_body_load(const void *, size_t, const nsvcd_body **);
nsvcd_result nsvcd_body_scale(const nsvcd_body *, const float[3], void *, size_t,
                              const nsvcd_body **);
nsvcd_body_facts nsvcd_body_describe(const nsvcd_body *);
int nsvcd_body_patch(const nsvcd_body *, uint32_t, float[3], float *);
size_t nsvcd_sweep_workspace_size(const nsvcd_question *);
nsvcd_result nsvcd_sweep(const nsvcd_question *, void *, size_t, nsvcd_answer *);
nsvcd_result nsvcd_sweep_batch(const nsvcd_question *, size_t, void *, size_t, nsvcd_answer *);
nsvcd_result nsvcd_contacts(const nsvcd_question *, void *, size_t, nsvcd_contact *, size_t,
                            size_t *, int *);
nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *, void *, size_t, nsvcd_answer *, float *,
                                  float *);
void nsvcd_spline(const float *, size_t, size_t, float, size_t, float *);
size_t nsvcd_plan_workspace_size(const nsvcd_plan_problem *, const nsvcd_plan_options *);
nsvcd_result nsvcd_plan(const nsvcd_plan_problem *, const nsvcd_plan_options *, void *, size_t,
                        float *, nsvcd_plan_answer *);
size_t nsvcd_checker_size(const nsvcd_scene *);
nsvcd_result nsvcd_checker_open(const nsvcd_scene *, void *, size_t, nsvcd_checker **);
void nsvcd_forward_kinematics(const nsvcd_checker *, const double *, nsvcd_pose *);
nsvcd_result nsvcd_check(nsvcd_checker *, const nsvcd_joint_motion *, const nsvcd_check_options *,
                         nsvcd_check_answer *);
nsvcd_result nsvcd_proximities(nsvcd_checker *, const double *, const nsvcd_proximity_options *,
                               nsvcd_proximity *, size_t, size_t *);
nsvcd_result nsvcd_nearest_free(nsvcd_checker *, const double *, const nsvcd_nearest_free_options *,
                                double *, int *);
nsvcd_result nsvcd_find_pairs(nsvcd_checker *, size_t, uint64_t, nsvcd_body_pair *, size_t,
                              nsvcd_pair_counts *);
nsvcd_result nsvcd_reparent(const nsvcd_checker *, const double *, size_t, uint32_t, nsvcd_part *);
nsvcd_result nsvcd_reach(nsvcd_checker *, const nsvcd_reach_problem *, const nsvcd_reach_options *,
                         double *, size_t, nsvcd_reach_answer *);
size_t nsvcd_route_size(const nsvcd_checker *, const nsvcd_route_problem *,
                        const nsvcd_route_options *);
nsvcd_result nsvcd_route(nsvcd_checker *, const nsvcd_route_problem *, const nsvcd_route_options *,
                         void *, size_t, nsvcd_route_answer *);
size_t nsvcd_tree_size(const nsvcd_mesh *);
nsvcd_result nsvcd_tree_build(const nsvcd_mesh *, void *, size_t, const nsvcd_tree **);
size_t nsvcd_certify_workspace_size(const nsvcd_question *, const nsvcd_tree *, const nsvcd_tree *);
nsvcd_result nsvcd_certify(const nsvcd_question *, const nsvcd_tree *, const nsvcd_tree *,
                           const nsvcd_certify_options *, void *, size_t, uint8_t *, size_t,
                           nsvcd_certificate *);
size_t nsvcd_world_size(size_t);
nsvcd_result nsvcd_world_begin(void *, size_t, size_t, nsvcd_world **);
nsvcd_result nsvcd_world_add(nsvcd_world *, const nsvcd_world_body *, size_t *);
nsvcd_result nsvcd_world_move(nsvcd_world *, size_t, const nsvcd_pose *);
nsvcd_result nsvcd_world_remove(nsvcd_world *, size_t);
nsvcd_result nsvcd_world_get(const nsvcd_world *, size_t, nsvcd_world_body *);
nsvcd_result nsvcd_world_drive(nsvcd_world *, size_t, const nsvcd_pose *);
nsvcd_result nsvcd_world_arrive(nsvcd_world *);
nsvcd_result nsvcd_world_sweep(const nsvcd_world *, const nsvcd_world_question *, void *, size_t,
                               nsvcd_world_answer *);
nsvcd_result nsvcd_world_list(const nsvcd_world *, const nsvcd_world_question *, void *, size_t,
                              size_t *, size_t, size_t *);
nsvcd_result nsvcd_world_pairs(const nsvcd_world *, float, nsvcd_body_pair *, size_t, size_t *);
nsvcd_result nsvcd_world_slide(nsvcd_world *, size_t, const nsvcd_slide_options *, float, void *,
                               size_t, nsvcd_velocity *, nsvcd_slide_answer *);
nsvcd_result nsvcd_world_step(nsvcd_world *, nsvcd_world_mover *, size_t,
                              const nsvcd_step_options *, float, void *, size_t,
                              nsvcd_step_answer *);
nsvcd_result nsvcd_mesh_mass(const nsvcd_mesh *, nsvcd_mass *);

// A mesh from the bytes of a file, of which the name may be "". placed: its origin, in the file's
// units, and its scale. Returns why there is none, or NULL.
extern const char *neuralsvcd_mesh_parse(const char *name, const void *data, size_t size,
                                         const double placed[4], nsvcd_mesh *mesh,
                                         const char **format, size_t *line);

const char *neuralsvcd_mesh_parse(const char *name, const void *data, size_t size,
                                  const double placed[4], nsvcd_mesh *mesh, const char **format,
                                  size_t *line) {
  const nsvcd_mesh_options options = {NSVCD_MESH_ANY, {placed[0], placed[1], placed[2]}, placed[3]};
  mesh_fault fault;
  (void)mesh_parse_to(name, data, size, &options, NULL, mesh, &fault);
  *format = fault.format;
  *line = fault.line;
  return fault.reason;
}

extern const char *neuralsvcd_version(void);

const char *neuralsvcd_version(void) {
  return NSVCD_VERSION;
}

// A struct is at 0, a field at its offset; a constant has its value for the place, and no size.
typedef struct neuralsvcd_layout {
  const char *name;
  size_t place, size;
} neuralsvcd_layout;

// clang-format off
#define STRUCT(type) {"nsvcd_" #type, 0, sizeof(nsvcd_##type)}
#define FIELD(type, field) \
  {"nsvcd_" #type "." #field, offsetof(nsvcd_##type, field), sizeof(((nsvcd_##type *)0)->field)}
#define CONSTANT(name) {"NSVCD_" #name, (size_t)(NSVCD_##name), 0}

static const neuralsvcd_layout layouts[] = {
    STRUCT(mesh), FIELD(mesh, positions), FIELD(mesh, indices), FIELD(mesh, vertex_count),
    FIELD(mesh, triangle_count),
    STRUCT(encode_options), FIELD(encode_options, patches), FIELD(encode_options, patch_radius),
    FIELD(encode_options, convex_radius),
    FIELD(encode_options, open), FIELD(encode_options, latents),
    FIELD(encode_options, no_triangles), FIELD(encode_options, coarse), FIELD(encode_options, balls), FIELD(encode_options, progress), FIELD(encode_options, user),
    STRUCT(body_facts), FIELD(body_facts, size), FIELD(body_facts, patches),
    FIELD(body_facts, centre), FIELD(body_facts, radius), FIELD(body_facts, extent),
    FIELD(body_facts, low), FIELD(body_facts, high), FIELD(body_facts, mean_patch_radius),
    FIELD(body_facts, triangles), FIELD(body_facts, stored_triangles), FIELD(body_facts, quantization_error),
    FIELD(body_facts, convex_radius), FIELD(body_facts, balls), FIELD(body_facts, ball_error), FIELD(body_facts, latents), FIELD(body_facts, components),
    FIELD(body_facts, open_components), FIELD(body_facts, open_edges), FIELD(body_facts, open),
    STRUCT(pose), FIELD(pose, position), FIELD(pose, rotation),
    STRUCT(network_options), FIELD(network_options, pairs), FIELD(network_options, model),
    FIELD(network_options, precision), FIELD(network_options, recall), FIELD(network_options, inflate),
    STRUCT(mover), FIELD(mover, body), FIELD(mover, poses), FIELD(mover, count),
    FIELD(mover, times), FIELD(mover, scale), FIELD(mover, pivot),
    STRUCT(question), FIELD(question, a), FIELD(question, b), FIELD(question, ask),
    FIELD(question, to), FIELD(question, to_time), FIELD(question, clearance),
    FIELD(question, slop), FIELD(question, tolerance), FIELD(question, manifold),
    FIELD(question, method), FIELD(question, work), FIELD(question, segments),
    FIELD(question, network), FIELD(question, surfaces),
    FIELD(question, stop), FIELD(question, user),
    STRUCT(range), FIELD(range, low), FIELD(range, high),
    STRUCT(contact), FIELD(contact, point), FIELD(contact, normal), FIELD(contact, gap),
    FIELD(contact, time), FIELD(contact, triangle_a), FIELD(contact, triangle_b),
    FIELD(contact, patch_a), FIELD(contact, patch_b), FIELD(contact, id),
    STRUCT(safe_pose), FIELD(safe_pose, time), FIELD(safe_pose, a), FIELD(safe_pose, b),
    STRUCT(opinion), FIELD(opinion, asked), FIELD(opinion, logit), FIELD(opinion, distance),
    FIELD(opinion, time),
    FIELD(opinion, patch_a), FIELD(opinion, patch_b), FIELD(opinion, candidates),
    FIELD(opinion, limited),
    STRUCT(answer), FIELD(answer, verdict), FIELD(answer, by), FIELD(answer, why),
    FIELD(answer, inside), FIELD(answer, time), FIELD(answer, distance), FIELD(answer, safe),
    FIELD(answer, depth), FIELD(answer, push_out), FIELD(answer, contact_count),
    FIELD(answer, contacts), FIELD(answer, nearest), FIELD(answer, opinion), FIELD(answer, work),
    STRUCT(body_pair), FIELD(body_pair, a), FIELD(body_pair, b),
    STRUCT(plan_progress), FIELD(plan_progress, seed), FIELD(plan_progress, iteration),
    FIELD(plan_progress, iterations), FIELD(plan_progress, refining), FIELD(plan_progress, cost),
    FIELD(plan_progress, collision), FIELD(plan_progress, control),
    FIELD(plan_progress, via_points),
    STRUCT(plan_problem), FIELD(plan_problem, joints), FIELD(plan_problem, low),
    FIELD(plan_problem, high), FIELD(plan_problem, start), FIELD(plan_problem, goal),
    FIELD(plan_problem, bodies), FIELD(plan_problem, body_count), FIELD(plan_problem, pairs),
    FIELD(plan_problem, pair_count), FIELD(plan_problem, kinematics), FIELD(plan_problem, jacobian),
    FIELD(plan_problem, collision), FIELD(plan_problem, progress), FIELD(plan_problem, user),
    STRUCT(plan_stage), FIELD(plan_stage, via_points), FIELD(plan_stage, segments),
    FIELD(plan_stage, iterations), FIELD(plan_stage, draws), FIELD(plan_stage, noise),
    STRUCT(plan_options), FIELD(plan_options, seed), FIELD(plan_options, seeds),
    FIELD(plan_options, explore), FIELD(plan_options, refine), FIELD(plan_options, velocity),
    FIELD(plan_options, acceleration), FIELD(plan_options, jerk), FIELD(plan_options, collision),
    FIELD(plan_options, duration), FIELD(plan_options, margin),
    FIELD(plan_options, discrete), FIELD(plan_options, check),
    FIELD(plan_options, sweep),
    STRUCT(plan_answer), FIELD(plan_answer, status), FIELD(plan_answer, collides),
    FIELD(plan_answer, joint), FIELD(plan_answer, pair), FIELD(plan_answer, logit),
    FIELD(plan_answer, time), FIELD(plan_answer, deviation), FIELD(plan_answer, cost),
    FIELD(plan_answer, smoothness),
    FIELD(plan_answer, via_points), FIELD(plan_answer, seeds), FIELD(plan_answer, iterations),
    FIELD(plan_answer, trajectories), FIELD(plan_answer, sweeps),
    STRUCT(joint), FIELD(joint, kind), FIELD(joint, parent), FIELD(joint, origin),
    FIELD(joint, axis), FIELD(joint, low), FIELD(joint, high), FIELD(joint, speed),
    FIELD(joint, acceleration), FIELD(joint, mimic), FIELD(joint, multiplier), FIELD(joint, offset),
    STRUCT(part), FIELD(part, body), FIELD(part, link), FIELD(part, pose), FIELD(part, scale),
    STRUCT(scene), FIELD(scene, joints), FIELD(scene, joint_count), FIELD(scene, parts),
    FIELD(scene, part_count), FIELD(scene, pairs), FIELD(scene, pair_count), FIELD(scene, clearances),
    FIELD(scene, allowances), FIELD(scene, allowance_count), FIELD(scene, cones), FIELD(scene, cone_count),
    STRUCT(allowance), FIELD(allowance, pair), FIELD(allowance, joints), FIELD(allowance, distance),
    STRUCT(cone), FIELD(cone, part), FIELD(cone, axis), FIELD(cone, direction), FIELD(cone, angle),
    STRUCT(joint_motion), FIELD(joint_motion, pieces), FIELD(joint_motion, degree),
    FIELD(joint_motion, points), FIELD(joint_motion, times),
    STRUCT(partial_motion), FIELD(partial_motion, motion), FIELD(partial_motion, joints),
    FIELD(partial_motion, joint_count), FIELD(partial_motion, delay),
    STRUCT(proximity), FIELD(proximity, pair), FIELD(proximity, verdict), FIELD(proximity, why), FIELD(proximity, distance), FIELD(proximity, depth), FIELD(proximity, contact),
    FIELD(proximity, slope),
    STRUCT(proximity_options), FIELD(proximity_options, max_distance), FIELD(proximity_options, to),
    FIELD(proximity_options, max_depth), FIELD(proximity_options, work),
    STRUCT(nearest_free_options), FIELD(nearest_free_options, clearance), FIELD(nearest_free_options, farthest),
    FIELD(nearest_free_options, seed), FIELD(nearest_free_options, stop), FIELD(nearest_free_options, user),
    STRUCT(pair_counts), FIELD(pair_counts, asked), FIELD(pair_counts, adjacent),
    FIELD(pair_counts, touching),
    CONSTANT(MAX_JOINTS),
    STRUCT(check_options), FIELD(check_options, clearance), FIELD(check_options, finest),
    FIELD(check_options, work), FIELD(check_options, stop), FIELD(check_options, user),
    FIELD(check_options, to_time),
    STRUCT(check_answer), FIELD(check_answer, verdict), FIELD(check_answer, why),
    FIELD(check_answer, pair), FIELD(check_answer, piece), FIELD(check_answer, fraction),
    FIELD(check_answer, contact), FIELD(check_answer, joint), FIELD(check_answer, placed),
    FIELD(check_answer, sweeps), FIELD(check_answer, free_until), FIELD(check_answer, cone),
    STRUCT(reach_problem), FIELD(reach_problem, start), FIELD(reach_problem, link),
    FIELD(reach_problem, tool), FIELD(reach_problem, target_link), FIELD(reach_problem, target),
    FIELD(reach_problem, half), FIELD(reach_problem, free_axis), FIELD(reach_problem, stop),
    FIELD(reach_problem, user), FIELD(reach_problem, held),
    STRUCT(reach_options), FIELD(reach_options, position_tolerance),
    FIELD(reach_options, angle_tolerance), FIELD(reach_options, apart), FIELD(reach_options, starts),
    FIELD(reach_options, seed), FIELD(reach_options, clearance), FIELD(reach_options, may_touch),
    STRUCT(reach_answer), FIELD(reach_answer, solutions), FIELD(reach_answer, starts),
    FIELD(reach_answer, reached), FIELD(reach_answer, touching), FIELD(reach_answer, best),
    FIELD(reach_answer, position_error), FIELD(reach_answer, angle_error),
    FIELD(reach_answer, check),
    STRUCT(route_problem), FIELD(route_problem, start), FIELD(route_problem, goals),
    FIELD(route_problem, goal_count), FIELD(route_problem, guess),
    FIELD(route_problem, guess_count), FIELD(route_problem, stop), FIELD(route_problem, abandon),
    FIELD(route_problem, user), FIELD(route_problem, held),
    STRUCT(route_options), FIELD(route_options, seed), FIELD(route_options, clearance),
    FIELD(route_options, nodes), FIELD(route_options, tries), FIELD(route_options, edge),
    FIELD(route_options, looks), FIELD(route_options, shortcuts), FIELD(route_options, smoothings),
    STRUCT(route_answer), FIELD(route_answer, status), FIELD(route_answer, goal),
    FIELD(route_answer, motion), FIELD(route_answer, stops), FIELD(route_answer, duration),
    FIELD(route_answer, unhindered), FIELD(route_answer, check), FIELD(route_answer, nodes),
    FIELD(route_answer, checks), FIELD(route_answer, proven), FIELD(route_answer, looks),
    STRUCT(certify_options), FIELD(certify_options, answer), FIELD(certify_options, visits),
    STRUCT(certificate), FIELD(certificate, verdict), FIELD(certificate, why), FIELD(certificate, inside),
    FIELD(certificate, time), FIELD(certificate, size), FIELD(certificate, visits),
    STRUCT(world_body), FIELD(world_body, body), FIELD(world_body, pose),
    FIELD(world_body, scale), FIELD(world_body, pivot), FIELD(world_body, groups),
    FIELD(world_body, passes), FIELD(world_body, fixed), FIELD(world_body, sensor),
    STRUCT(world_contact), FIELD(world_contact, body), FIELD(world_contact, contact),
    FIELD(world_contact, impulse),
    STRUCT(world_question), FIELD(world_question, question), FIELD(world_question, self),
    FIELD(world_question, groups), FIELD(world_question, passes),
    STRUCT(world_answer), FIELD(world_answer, verdict), FIELD(world_answer, why),
    FIELD(world_answer, body), FIELD(world_answer, time), FIELD(world_answer, safe_time),
    FIELD(world_answer, safe), FIELD(world_answer, depth), FIELD(world_answer, push_out),
    FIELD(world_answer, contact_count), FIELD(world_answer, contacts),
    FIELD(world_answer, questions), FIELD(world_answer, work),
    STRUCT(slide_options), FIELD(slide_options, clearance), FIELD(slide_options, margin),
    FIELD(slide_options, mass), FIELD(slide_options, inertia), FIELD(slide_options, friction),
    FIELD(slide_options, restitution), FIELD(slide_options, up), FIELD(slide_options, step),
    FIELD(slide_options, slope), FIELD(slide_options, rounds), FIELD(slide_options, work),
    STRUCT(velocity), FIELD(velocity, linear), FIELD(velocity, angular),
    STRUCT(slide_answer), FIELD(slide_answer, pose), FIELD(slide_answer, spent),
    FIELD(slide_answer, rests), FIELD(slide_answer, ground), FIELD(slide_answer, ground_normal),
    FIELD(slide_answer, caught), FIELD(slide_answer, contact_count),
    FIELD(slide_answer, contacts), FIELD(slide_answer, questions), FIELD(slide_answer, work),
    FIELD(slide_answer, told), FIELD(slide_answer, given), FIELD(slide_answer, seconds),
    FIELD(slide_answer, clock), FIELD(slide_answer, slides),
    STRUCT(world_mover), FIELD(world_mover, id), FIELD(world_mover, how), FIELD(world_mover, velocity),
    FIELD(world_mover, push_mass), FIELD(world_mover, damping), FIELD(world_mover, spin_damping),
    FIELD(world_mover, asleep), FIELD(world_mover, sleepless), FIELD(world_mover, calm),
    FIELD(world_mover, answer),
    STRUCT(step_options), FIELD(step_options, gravity), FIELD(step_options, quiet),
    FIELD(step_options, calm),
    STRUCT(step_answer), FIELD(step_answer, awake), FIELD(step_answer, asleep),
    FIELD(step_answer, caught), FIELD(step_answer, contacts), FIELD(step_answer, questions),
    FIELD(step_answer, work), FIELD(step_answer, refused),
    STRUCT(mass), FIELD(mass, volume), FIELD(mass, centre), FIELD(mass, inertia),
    FIELD(mass, is_of_box),
    CONSTANT(JOINT_REVOLUTE), CONSTANT(JOINT_CONTINUOUS), CONSTANT(JOINT_PRISMATIC),
    CONSTANT(ROUTE_FOUND), CONSTANT(ROUTE_LIMIT), CONSTANT(ROUTE_STOPPED), CONSTANT(ROUTE_START),
    CONSTANT(ROUTE_GOAL),
    CONSTANT(ERROR_ARGUMENT), CONSTANT(ERROR_IO), CONSTANT(ERROR_MEMORY),
    CONSTANT(ERROR_WORKSPACE), CONSTANT(ERROR_CANCELLED), CONSTANT(ERROR_COUNT),
    CONSTANT(ERROR_FORMAT), CONSTANT(ERROR_SYNTAX), CONSTANT(ERROR_INDEX), CONSTANT(ERROR_NUMBER),
    CONSTANT(ERROR_EMPTY), CONSTANT(ERROR_TOO_LARGE), CONSTANT(ERROR_SIZES), CONSTANT(ERROR_BOX),
    CONSTANT(ERROR_PATCHES), CONSTANT(ERROR_RADIUS), CONSTANT(ERROR_BODY), CONSTANT(ERROR_VERSION),
    CONSTANT(ERROR_TRIANGLES), CONSTANT(ERROR_LATENTS), CONSTANT(ERROR_POSES),
    CONSTANT(ERROR_TIMES), CONSTANT(ERROR_POSE), CONSTANT(ERROR_QUATERNION), CONSTANT(ERROR_SCALE),
    CONSTANT(ERROR_PIVOT), CONSTANT(ERROR_SAME), CONSTANT(ERROR_ASK), CONSTANT(ERROR_METHOD), CONSTANT(ERROR_TO),
    CONSTANT(ERROR_TO_TIME), CONSTANT(ERROR_CLEARANCE), CONSTANT(ERROR_SLOP),
    CONSTANT(ERROR_TOLERANCE), CONSTANT(ERROR_MANIFOLD), CONSTANT(ERROR_SEGMENTS),
    CONSTANT(ERROR_PAIRS), CONSTANT(ERROR_MODEL), CONSTANT(ERROR_PRECISION),
    CONSTANT(ERROR_RECALL), CONSTANT(ERROR_INFLATE), CONSTANT(ERROR_JOINT), CONSTANT(ERROR_AXIS),
    CONSTANT(ERROR_LIMITS), CONSTANT(ERROR_SPEED), CONSTANT(ERROR_LINK), CONSTANT(ERROR_PAIR), CONSTANT(ERROR_CONE),
    CONSTANT(ERROR_VALUE), CONSTANT(ERROR_DEGREE), CONSTANT(ERROR_TURN), CONSTANT(ERROR_FINEST),
    CONSTANT(ERROR_DISTANCE), CONSTANT(ERROR_FARTHEST), CONSTANT(ERROR_ROUTE), CONSTANT(ERROR_HELD),
    CONSTANT(ERROR_MIMIC),
    CONSTANT(ERROR_STAGE), CONSTANT(ERROR_PLAN), CONSTANT(ERROR_WORLD), CONSTANT(ERROR_BUILD),
    CONSTANT(ASK_HIT), CONSTANT(ASK_FIRST), CONSTANT(ASK_DISTANCE),
    CONSTANT(UNDECIDED), CONSTANT(FREE), CONSTANT(HIT),
    CONSTANT(BY_PROOF), CONSTANT(BY_NETWORK),
    CONSTANT(WHY_NOTHING), CONSTANT(WHY_TOO_NEAR), CONSTANT(WHY_WORK), CONSTANT(WHY_OPEN),
    CONSTANT(MODEL_DEFAULT), CONSTANT(MODEL_TINY), CONSTANT(MODEL_SMALL), CONSTANT(MODEL_BASE),
    CONSTANT(PRECISION_FLOAT), CONSTANT(PRECISION_INT8),
    CONSTANT(METHOD_DEFAULT), CONSTANT(METHOD_PROOF), CONSTANT(METHOD_NETWORK),
    CONSTANT(PLAN_CONVERGED), CONSTANT(PLAN_LIMIT), CONSTANT(PLAN_CANCELLED), CONSTANT(PLAN_START),
    CONSTANT(PLAN_GOAL),
    CONSTANT(NO_TRIANGLE), CONSTANT(MAX_CONTACTS), CONSTANT(MAX_VIA_POINTS), CONSTANT(NONE),
    CONSTANT(WORLD_CONTACTS),
};
// clang-format on

extern const neuralsvcd_layout *neuralsvcd_layouts(size_t *count);

const neuralsvcd_layout *neuralsvcd_layouts(size_t *count) {
  *count = sizeof layouts / sizeof *layouts;
  return layouts;
}
