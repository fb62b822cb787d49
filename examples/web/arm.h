// arm.h - of web.c: a robot among obstacles. arm.js names joints, parts and pairs as a planning
// file has them, has a motion planned, bends it, and asks whether it is free.

#define ARM_PARTS 32
#define ARM_PAIRS 256

static nsvcd_joint arm_joints[NSVCD_MAX_JOINTS];
static nsvcd_part arm_parts[ARM_PARTS];
static nsvcd_mesh arm_meshes[ARM_PARTS];
static const nsvcd_tree *arm_trees[ARM_PARTS];
static nsvcd_body_pair arm_pairs[ARM_PAIRS];
static nsvcd_scene arm_scene = {arm_joints, 0, arm_parts, 0, arm_pairs, 0, NULL, NULL, 0, NULL, 0};
static nsvcd_checker *arm_checker;
static nsvcd_route_answer arm_route;
static double arm_ends[2][NSVCD_MAX_JOINTS];  // start and goal
static nsvcd_joint_motion arm_way;            // its points are the page's to bend
static nsvcd_check_answer arm_answer;
static nsvcd_pose arm_poses[ARM_PARTS];

nsvcd_result EXPORT(arm_joint)(nsvcd_joint_kind kind, uint32_t parent, float x, float y, float z,
                               float qx, float qy, float qz, float qw, float ax, float ay, float az,
                               double low, double high, double speed, double acceleration) {
  const nsvcd_joint joint = {
      kind, parent, {{x, y, z}, {qx, qy, qz, qw}}, {ax, ay, az}, low, high, speed, acceleration, 0,
      0,    0};
  if (arm_scene.joint_count == NSVCD_MAX_JOINTS) return NSVCD_ERROR_TOO_LARGE;
  arm_joints[arm_scene.joint_count++] = joint;
  return NSVCD_OK;
}

// A part on a link, from OBJ text, which is given back.
nsvcd_result EXPORT(arm_part)(uint32_t link, char *text, size_t size) {
  const size_t n = arm_scene.part_count;
  const nsvcd_encode_options options = {0};
  if (n == ARM_PARTS) return NSVCD_ERROR_TOO_LARGE;
  nsvcd_mesh *mesh = &arm_meshes[n];
  nsvcd_part *part = &arm_parts[n];
  nsvcd_result result = nsvcd_obj_parse(text, size, NULL, mesh, NULL);
  free(text);
  if (!result) result = nsvcd_encode(mesh, &options, NULL, NULL, 0, &part->body);
  if (result) return result;
  const size_t room = nsvcd_tree_size(mesh);
  void *memory = malloc(room);
  if (!memory) return NSVCD_ERROR_MEMORY;
  part->link = link;
  part->pose.rotation[3] = 1;
  arm_scene.part_count++;
  return nsvcd_tree_build(mesh, memory, room, &arm_trees[n]);
}

nsvcd_result EXPORT(arm_pair)(uint32_t a, uint32_t b) {
  if (arm_scene.pair_count == ARM_PAIRS) return NSVCD_ERROR_TOO_LARGE;
  arm_pairs[arm_scene.pair_count].a = a;
  arm_pairs[arm_scene.pair_count++].b = b;
  return NSVCD_OK;
}

double *EXPORT(arm_end)(size_t which) {
  return arm_ends[which];
}

// Looks at what was named and seeks a way from the start to the goal. NSVCD_ERROR_EMPTY: none is
// found.
nsvcd_result EXPORT(arm_plan)(void) {
  nsvcd_route_problem problem = {0};
  problem.start = arm_ends[0];
  problem.goals = arm_ends[1];
  problem.goal_count = 1;
  const size_t size = nsvcd_checker_size(&arm_scene);
  void *memory = malloc(size);
  if (!memory) return NSVCD_ERROR_MEMORY;
  nsvcd_result result = nsvcd_checker_open(&arm_scene, memory, size, &arm_checker);
  if (result) return result;
  const size_t room = nsvcd_route_size(arm_checker, &problem, NULL);
  void *trees = malloc(room);
  if (!trees) return NSVCD_ERROR_MEMORY;
  result = nsvcd_route(arm_checker, &problem, NULL, trees, room, &arm_route);
  if (result) return result;
  arm_way = arm_route.motion;
  return arm_route.status == NSVCD_ROUTE_FOUND ? NSVCD_OK : NSVCD_ERROR_EMPTY;
}

size_t EXPORT(arm_pieces)(void) {
  return arm_way.pieces;
}
size_t EXPORT(arm_degree)(void) {
  return arm_way.degree;
}
const double *EXPORT(arm_points)(void) {
  return arm_way.points;
}
const double *EXPORT(arm_times)(void) {
  return arm_way.times;
}
const nsvcd_mesh *EXPORT(arm_mesh)(size_t part) {
  return &arm_meshes[part];
}

// The poses of all parts at a time of the motion, seconds.
const nsvcd_pose *EXPORT(arm_place)(double time) {
  double at[NSVCD_MAX_JOINTS];
  nsvcd_motion_at(&arm_way, arm_scene.joint_count, time, at);
  nsvcd_forward_kinematics(arm_checker, at, arm_poses);
  return arm_poses;
}

nsvcd_result EXPORT(arm_check)(size_t times) {
  nsvcd_result result = NSVCD_OK;
  for (size_t i = 0; i < times && !result; i++)
    result = nsvcd_check(arm_checker, &arm_way, NULL, &arm_answer);
  return result;
}
const nsvcd_check_answer *EXPORT(arm_checked)(void) {
  return &arm_answer;
}

// A pair's part of the proof that the motion is free, in web_certificate and web_proof.
nsvcd_result EXPORT(arm_certify)(size_t pair) {
  const nsvcd_tree *a = arm_trees[arm_pairs[pair].a];
  const nsvcd_tree *b = arm_trees[arm_pairs[pair].b];
  const size_t size = nsvcd_certify_pair_workspace_size(&arm_way, a, b);
  void *room = malloc(size);
  if (!room) return NSVCD_ERROR_MEMORY;
  const nsvcd_result result = nsvcd_certify_pair(arm_checker, &arm_way, pair, 0, a, b, NULL, room,
                                                 size, proof, sizeof proof, &certificate);
  free(room);
  return !result && certificate.size > sizeof proof ? NSVCD_ERROR_TOO_LARGE : result;
}
