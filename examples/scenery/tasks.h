// tasks.h - three motion planning tasks: dishes into a rack, a peg into a hole with two arms, a
// pickaxe through a mine.
//
// In:  a seed. Out: a scene (bodies, what carries them, which pairs can meet) and one to three
// planning problems (start and goal in joint space). task_place turns joint values into the poses
// of all bodies; task_check judges a trajectory by the exact oracle. Everything follows from the
// seed: starts and goals to the bit, measured with gcc and clang. What the sources leave open is
// chosen in comments marked "chosen". Metres, radians, seconds, right-handed, z up, quaternions x y
// z w.
//
//   task_scene scene;
//   if (!task_dish_episode(&scene, 7)) ...            // or task_bimanual_episode,
//                                                     task_mining_episode
//   for (int i = 0; i < scene.problem_count; i++) {
//     task_select(&scene, i);                         // before encoding pairs: it changes who
//                                                     carries what
//     ... plan from scene.problems[i].start to scene.problems[i].goal ...
//     if (task_check(&scene, joints, samples, NULL)) ...
//   }
//   task_free(&scene);
#ifndef NSVCD_SCENERY_TASKS_H
#define NSVCD_SCENERY_TASKS_H

#include "../../neuralsvcd.h"
#include "oracle.h"
#include "shapes.h"

#define TASK_DEF SHAPES_DEF
#define TASK_MAX_JOINTS 12
#define TASK_MAX_BODIES 96
#define TASK_MAX_PAIRS 1024
#define TASK_PI 3.14159265358979323846

// Link 0 is the world; link i + 1 is what joint i moves.
typedef struct task_joint {
  // the joint's frame in its parent link; roll, pitch, yaw as in URDF
  double origin[3], rpy[3], axis[3];
  double low, high;  // radians, or metres if it slides
  double speed;      // per second, at most
  int slides;
  int parent;  // a link
} task_joint;

typedef enum task_kind {
  TASK_ROBOT,
  TASK_HELD,   // grasped: moves with a link
  TASK_SCENE,  // stands still
  TASK_FLOOR,  // stands still, below the robot: the links of its foot never meet it
  TASK_ABSENT  // takes no part in this problem
} task_kind;

typedef struct task_body {
  const char *name;
  nsvcd_mesh mesh;     // for nsvcd_encode
  oracle_mesh exact;   // those triangles, for the oracle
  oracle_pose offset;  // its pose in the link
  int link;
  task_kind kind;
  // a robot's body is not tested against those on this many links before its own: they overlap by
  // design
  int near;
} task_body;

typedef struct task_problem {
  float start[TASK_MAX_JOINTS], goal[TASK_MAX_JOINTS];
  // from here to the goal a straight insertion is free; planners do not get to see it
  float approach[TASK_MAX_JOINTS];
} task_problem;

typedef struct task_scene {
  const char *name;
  task_joint joints[TASK_MAX_JOINTS];
  oracle_pose origins[TASK_MAX_JOINTS];  // origin and rpy as poses
  int joint_count;
  int foot;  // links up to this one never meet the floor
  task_body bodies[TASK_MAX_BODIES];
  int body_count;
  int pairs[TASK_MAX_PAIRS][2];  // bodies that can meet; where one stands still, it is the first
  int pair_count;
  task_problem problems[3];
  int problem_count;
  int selected;            // problem
  int held[3];             // bodies: the dish of each problem; peg and block; pickaxe
  oracle_pose grasps[3];   // poses of the dishes in the hand
  oracle_pose settled[3];  // their poses in the rack, once released
  shapes_rng rng;
  int failed;  // no memory, or too many bodies or pairs
} task_scene;

// ------------------------------------------------------------------------------------------- poses

TASK_DEF oracle_pose task_pose(double x, double y, double z, double roll, double pitch,
                               double yaw) {
  const double ax[3] = {1, 0, 0};
  const double ay[3] = {0, 1, 0};
  const double az[3] = {0, 0, 1};
  double qx[4], qy[4], qz[4], turn[4];
  oracle_pose pose = {{x, y, z}, {0, 0, 0, 1}};
  oracle_axis_angle(ax, roll, qx);
  oracle_axis_angle(ay, pitch, qy);
  oracle_axis_angle(az, yaw, qz);
  oracle_quat_mul(qz, qy, turn);
  oracle_quat_mul(turn, qx, pose.rotation);
  return pose;
}
TASK_DEF oracle_pose task_compose(const oracle_pose *a, const oracle_pose *b) {
  oracle_pose out;
  oracle_transform(a, b->position, out.position);
  oracle_quat_mul(a->rotation, b->rotation, out.rotation);
  return out;
}
// b as seen from a.
TASK_DEF oracle_pose task_relative(const oracle_pose *a, const oracle_pose *b) {
  oracle_pose out;
  double m[9];
  double d[3];
  double inverse[4] = {-a->rotation[0], -a->rotation[1], -a->rotation[2], a->rotation[3]};
  oracle_matrix(a->rotation, m);
  oracle_sub(b->position, a->position, d);
  oracle_rotate_back(m, d, out.position);
  oracle_quat_mul(inverse, b->rotation, out.rotation);
  return out;
}

// -------------------------------------------------------------------------------- scene and bodies

TASK_DEF void task_free(task_scene *scene) {
  for (int i = 0; i < scene->body_count; i++) {
    free(scene->bodies[i].mesh.positions);
    free(scene->bodies[i].mesh.indices);
    oracle_mesh_free(&scene->bodies[i].exact);
  }
  memset(scene, 0, sizeof *scene);
}
TASK_DEF void task_begin(task_scene *scene, const char *name, uint64_t seed) {
  memset(scene, 0, sizeof *scene);
  scene->name = name;
  scene->rng.state = seed;
}
// Takes the mesh over, empties it, and returns the new body's index.
TASK_DEF int task_add(task_scene *scene, const char *name, task_kind kind, int link, int near,
                      oracle_pose offset, shapes_mesh *mesh) {
  task_body *body = &scene->bodies[scene->body_count];
  float *positions = (float *)malloc((3 * mesh->vertices + 1) * sizeof(float));
  if (mesh->failed || !positions || scene->body_count == TASK_MAX_BODIES) {
    shapes_free(mesh);
    free(positions);
    return scene->failed = 1, 0;
  }
  memset(body, 0, sizeof *body);
  // the oracle shall see what the network sees: floats
  for (size_t i = 0; i < 3 * mesh->vertices; i++) {
    positions[i] = (float)mesh->positions[i];
    mesh->positions[i] = (double)positions[i];
  }
  body->name = name;
  body->kind = kind;
  body->link = link;
  body->near = near;
  body->offset = offset;
  body->mesh.positions = positions;
  body->mesh.vertex_count = mesh->vertices;
  body->mesh.indices = mesh->indices;
  body->mesh.triangle_count = mesh->triangles;
  if (!oracle_mesh_init(&body->exact, mesh->positions, mesh->vertices, mesh->indices,
                        mesh->triangles, 1))
    scene->failed = 1;
  mesh->indices = NULL;
  shapes_free(mesh);
  return scene->body_count++;
}
// Appends a serial chain on a link; returns its first new link.
TASK_DEF int task_add_chain(task_scene *scene, const task_joint *joints, int count, int parent) {
  int first = scene->joint_count + 1;
  for (int i = 0; i < count; i++) {
    task_joint *joint = &scene->joints[scene->joint_count];
    *joint = joints[i];
    joint->parent = i ? scene->joint_count : parent;
    const double *o = joint->origin;
    const double *r = joint->rpy;
    scene->origins[scene->joint_count++] = task_pose(o[0], o[1], o[2], r[0], r[1], r[2]);
  }
  return first;
}
// The poses of all links, the world first: (joint_count + 1).
TASK_DEF void task_links(const task_scene *scene, const double *joints, oracle_pose *links) {
  links[0] = task_pose(0, 0, 0, 0, 0, 0);
  for (int i = 0; i < scene->joint_count; i++) {
    const task_joint *joint = &scene->joints[i];
    oracle_pose frame = task_compose(&links[joint->parent], &scene->origins[i]);
    oracle_pose move = {{0, 0, 0}, {0, 0, 0, 1}};
    for (int k = 0; joint->slides && k < 3; k++) move.position[k] = joints[i] * joint->axis[k];
    if (!joint->slides) oracle_axis_angle(joint->axis, joints[i], move.rotation);
    links[i + 1] = task_compose(&frame, &move);
  }
}
TASK_DEF oracle_pose task_body_pose(const task_scene *scene, int body, const oracle_pose *links) {
  const task_body *b = &scene->bodies[body];
  return b->link ? task_compose(&links[b->link], &b->offset) : b->offset;
}
// user: a task_scene. joints: (joint_count). poses: (body_count), those that stand still too.
// Absent bodies lie 10 m below the floor.
TASK_DEF void task_place(void *user, const float *joints, nsvcd_pose *poses) {
  const task_scene *scene = (const task_scene *)user;
  double q[TASK_MAX_JOINTS];
  oracle_pose links[TASK_MAX_JOINTS + 1];
  for (int i = 0; i < scene->joint_count; i++) q[i] = (double)joints[i];
  task_links(scene, q, links);
  for (int i = 0; i < scene->body_count; i++) {
    oracle_pose pose = task_body_pose(scene, i, links);
    if (scene->bodies[i].kind == TASK_ABSENT) pose = task_pose(0, 0, -10, 0, 0, 0);
    for (int k = 0; k < 3; k++) poses[i].position[k] = (float)pose.position[k];
    for (int k = 0; k < 4; k++) poses[i].rotation[k] = (float)pose.rotation[k];
  }
}

// ------------------------------------------------------------------------------------------- pairs
// Left out, as they cannot meet: what stands still among itself; neighbouring links, which overlap
// by design; a thing and the hand that holds it; the foot and the floor; what is farther from a
// robot's first joint than a body's reach.

// A bound on how far a body's points get from the first joint of its chain, in `root`. Infinite
// where a joint slides.
TASK_DEF double task_reach(const task_scene *scene, const task_body *body, double *root) {
  double center[3], reach;
  int link = body->link;
  oracle_transform(&body->offset, body->exact.center, center);
  reach = oracle_length(center) + body->exact.radius;
  memset(root, 0, 3 * sizeof *root);
  for (; link; link = scene->joints[link - 1].parent) {
    if (scene->joints[link - 1].slides) return HUGE_VAL;
    if (scene->joints[link - 1].parent)
      reach += oracle_length(scene->origins[link - 1].position);
    else
      memcpy(root, scene->origins[link - 1].position, 3 * sizeof *root);
  }
  return reach;
}
// Can the robot's body get to the one that stands still, were its joints free of limits?
TASK_DEF int task_reaches(const task_scene *scene, const task_body *body, const task_body *still) {
  double root[3];
  double m[9];
  double d[3];
  double local[3];
  double gap = 0;
  double reach = task_reach(scene, body, root);
  oracle_matrix(still->offset.rotation, m);
  oracle_sub(root, still->offset.position, d);
  oracle_rotate_back(m, d, local);
  for (int k = 0; k < 3; k++) {
    double out = fmax(fmax(still->exact.low[k] - local[k], local[k] - still->exact.high[k]), 0);
    gap += out * out;
  }
  return sqrt(gap) <= reach;
}
TASK_DEF int task_moves(const task_body *body) {
  return body->kind == TASK_ROBOT || body->kind == TASK_HELD;
}
// Is link `above` among the `near` links before `link`, or the same?
TASK_DEF int task_is_near(const task_scene *scene, int above, int link, int near) {
  for (; link != above && link && near; near--) link = scene->joints[link - 1].parent;
  return link == above;
}
TASK_DEF int task_can_meet(const task_scene *scene, const task_body *a, const task_body *b) {
  if (a->kind == TASK_ABSENT || b->kind == TASK_ABSENT || (!task_moves(a) && !task_moves(b)))
    return 0;
  if (a->kind == TASK_FLOOR || b->kind == TASK_FLOOR) {
    if (a->link <= scene->foot && b->link <= scene->foot) return 0;
  }
  if (!task_moves(a)) return task_reaches(scene, b, a);
  if (!task_moves(b)) return task_reaches(scene, a, b);
  return !task_is_near(scene, a->link, b->link, b->near) &&
         !task_is_near(scene, b->link, a->link, a->near);
}
TASK_DEF void task_find_pairs(task_scene *scene) {
  scene->pair_count = 0;
  for (int a = 0; a < scene->body_count; a++)
    for (int b = a + 1; b < scene->body_count; b++) {
      if (!task_can_meet(scene, &scene->bodies[a], &scene->bodies[b])) continue;
      if (scene->pair_count == TASK_MAX_PAIRS) {
        scene->failed = 1;
        return;
      }
      int swap = !task_moves(&scene->bodies[b]);
      scene->pairs[scene->pair_count][0] = swap ? b : a;
      scene->pairs[scene->pair_count++][1] = swap ? a : b;
    }
}

// ------------------------------------------------------------------------------------------- judge

// radians or metres of a joint between two poses: a chord at 1 m is then 0.05 mm off its arc
#define TASK_FINE 0.02
#define TASK_REACHED 1e-3    // radians or metres of each joint: what counts as the goal
#define TASK_TOLERANCE 1e-5  // metres: a pair that comes nearer than this counts as a collision

typedef struct task_verdict {
  int free, in_limits, at_goal;  // all three: success
  int pair[2];                   // if not free: the first bodies found to meet,
  double time;                   // and when, in [0,1] over the samples
} task_verdict;

// Does the pair keep `clearance` from each other? a, b: (count) poses in the world, position linear
// and rotation slerp in between. Runs of samples between which the second body's sphere is far from
// the first one's box are skipped.
TASK_DEF int task_pair_free(const task_body *fixed, const task_body *moving, const oracle_pose *a,
                            const oracle_pose *b, int count, double clearance,
                            oracle_pose *relative, double *time) {
  const oracle_options options = {TASK_TOLERANCE, fmax(clearance, TASK_TOLERANCE), 0, 0};
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  int run = 0;  // poses in `relative`
  for (int i = 0; i < count; i++) {
    int next = i + 1 < count ? i + 1 : i;
    double center[3];
    double gap = 0;
    double step;
    relative[run] = task_relative(&a[i], &b[i]);
    oracle_transform(&relative[run], moving->exact.center, center);
    for (int k = 0; k < 3; k++) {
      double d = fmax(fmax(fixed->exact.low[k] - center[k], center[k] - fixed->exact.high[k]), 0);
      gap += d * d;
    }
    step = oracle_path_bound(&fixed->exact, &a[i], &a[next]) +
           oracle_path_bound(&moving->exact, &b[i], &b[next]);
    int near = sqrt(gap) - moving->exact.radius <= clearance + step;
    run = near || run ? run + 1 : 0;  // the pose after the last near one ends the run
    if (!run || (near && i + 1 < count)) continue;
    oracle_result r =
        oracle_sweep(&moving->exact, relative, (size_t)run, &fixed->exact, &origin, &options);
    if (time) *time = count > 1 ? (i + 1 - run + r.time * (run - 1)) / (count - 1) : 0;
    if (r.status != ORACLE_FREE || r.lower < clearance) return 0;
    run = 0;
  }
  return 1;
}
// Joint values (samples, joint_count), linear in between: do all pairs keep `clearance`? No memory
// counts as no.
TASK_DEF int task_keeps(const task_scene *scene, const double *joints, int samples,
                        double clearance, task_verdict *verdict) {
  int joint_count = scene->joint_count;
  int count = 1;
  int at = 0;
  int pair = 0;
  for (int s = 0; s + 1 < samples; s++) {
    double most = 0;
    for (int j = 0; j < joint_count; j++)
      most = fmax(most, fabs(joints[(s + 1) * joint_count + j] - joints[s * joint_count + j]));
    count += (int)fmax(1, ceil(most / TASK_FINE));
  }
  double *times = (double *)malloc((size_t)count * sizeof *times);  // times of the fine poses
  oracle_pose *world =
      (oracle_pose *)malloc((size_t)count * (size_t)(scene->body_count + 1) * sizeof *world);
  oracle_pose *relative = world + (size_t)count * (size_t)scene->body_count;
  if (!times || !world) return free(times), free(world), 0;
  for (int s = 0; s < samples; s++) {
    double most = 0;
    double q[TASK_MAX_JOINTS];
    oracle_pose links[TASK_MAX_JOINTS + 1];
    const double *q0 = joints + s * joint_count;
    const double *q1 = s + 1 < samples ? q0 + joint_count : q0;
    for (int j = 0; j < joint_count; j++) most = fmax(most, fabs(q1[j] - q0[j]));
    int steps = (int)fmax(1, ceil(most / TASK_FINE));
    for (int i = 0; i < steps; i++, at++) {
      for (int j = 0; j < joint_count; j++) q[j] = q0[j] + (q1[j] - q0[j]) * i / steps;
      task_links(scene, q, links);
      times[at] = s + (double)i / steps;
      for (int b = 0; b < scene->body_count; b++)
        world[b * count + at] = task_body_pose(scene, b, links);
    }
  }
  for (; pair < scene->pair_count; pair++) {
    int a = scene->pairs[pair][0];
    int b = scene->pairs[pair][1];
    double time;
    if (task_pair_free(&scene->bodies[a], &scene->bodies[b], world + a * count, world + b * count,
                       count, clearance, relative, &time))
      continue;
    if (verdict) {
      verdict->pair[0] = a;
      verdict->pair[1] = b;
      verdict->time = samples > 1 ? times[(int)(time * (count - 1))] / (samples - 1) : 0;
    }
    break;
  }
  free(times);
  free(world);
  return pair == scene->pair_count;
}
TASK_DEF int task_in_limits(const task_scene *scene, const double *joints) {
  for (int j = 0; j < scene->joint_count; j++)  // floats may be off by their rounding
    if (!(joints[j] >= scene->joints[j].low - 1e-5 && joints[j] <= scene->joints[j].high + 1e-5))
      return 0;
  return 1;
}
// A whole trajectory (samples, joint_count), joints linear in between, against the selected
// problem. Returns 1 for success. verdict may be NULL.
TASK_DEF int task_check(const task_scene *scene, const float *joints, int samples,
                        task_verdict *verdict) {
  task_verdict v = {0, 1, 1, {0, 0}, 0};
  int count = scene->joint_count;
  const float *goal = scene->problems[scene->selected].goal;
  const float *start = scene->problems[scene->selected].start;
  double *q = (double *)malloc((size_t)(samples * count) * sizeof *q);
  for (int i = 0; q && i < samples * count; i++) q[i] = (double)joints[i];
  for (int s = 0; q && s < samples; s++) v.in_limits &= task_in_limits(scene, q + s * count);
  for (int j = 0; j < count; j++) {  // "reaches the goal" includes: from the start
    v.at_goal &= fabs((double)(joints[(samples - 1) * count + j] - goal[j])) <= TASK_REACHED;
    v.at_goal &= fabs((double)(joints[j] - start[j])) <= TASK_REACHED;
  }
  v.free = q && task_keeps(scene, q, samples, 0, &v);
  free(q);
  if (verdict) *verdict = v;
  return v.free && v.in_limits && v.at_goal;
}

// ------------------------------------------------------------------------------ inverse kinematics

// Where `body` is, as seen from body `base` (-1: the world), less the target: position, then
// rotation vector.
TASK_DEF void task_error(const task_scene *scene, const double *joints, int body, int base,
                         const oracle_pose *target, double *error) {
  oracle_pose links[TASK_MAX_JOINTS + 1], pose;
  task_links(scene, joints, links);
  pose = task_body_pose(scene, body, links);
  if (base >= 0) {
    oracle_pose frame = task_body_pose(scene, base, links);
    pose = task_relative(&frame, &pose);
  }
  oracle_sub(pose.position, target->position, error);
  double angle = oracle_quat_arc(target->rotation, pose.rotation, error + 3);
  for (int k = 0; k < 3; k++) error[3 + k] *= angle;
}
// Solves the symmetric positive definite a x = b in place: Cholesky.
TASK_DEF void task_solve6(double a[6][6], double *b) {
  for (int i = 0; i < 6; i++)
    for (int j = 0; j <= i; j++) {
      double sum = a[i][j];
      for (int k = 0; k < j; k++) sum -= a[i][k] * a[j][k];
      a[i][j] = i == j ? sqrt(sum) : sum / a[j][j];
    }
  for (int i = 0; i < 6; i++) {
    for (int k = 0; k < i; k++) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (int i = 5; i >= 0; i--) {
    for (int k = i + 1; k < 6; k++) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
}
// Damped least squares from the joints given, which it improves within their limits. Returns 1 once
// `body` is at the target, as seen from body `base` (-1: the world), to 1e-6.
TASK_DEF int task_ik(const task_scene *scene, double *joints, int body, int base,
                     const oracle_pose *target) {
  double e[6], moved[6], jacobian[6][TASK_MAX_JOINTS];
  for (int iteration = 0; iteration < 60; iteration++) {
    double norm = 0;
    double a[6][6];
    task_error(scene, joints, body, base, target, e);
    for (int k = 0; k < 6; k++) norm += e[k] * e[k];
    if (norm < 1e-12) return 1;
    for (int j = 0; j < scene->joint_count; j++) {
      double keep = joints[j];
      joints[j] += 1e-6;
      task_error(scene, joints, body, base, target, moved);
      joints[j] = keep;
      for (int k = 0; k < 6; k++) jacobian[k][j] = (moved[k] - e[k]) / 1e-6;
    }
    for (int i = 0; i < 6; i++)
      for (int k = 0; k < 6; k++) {
        // the damping fades as the target comes near
        a[i][k] = i == k ? 1e-6 + 1e-2 * fmin(norm, 1) : 0;
        for (int j = 0; j < scene->joint_count; j++) a[i][k] += jacobian[i][j] * jacobian[k][j];
      }
    task_solve6(a, e);
    for (int j = 0; j < scene->joint_count; j++) {
      double step = 0;
      for (int k = 0; k < 6; k++) step -= jacobian[k][j] * e[k];
      joints[j] += fmax(-0.3, fmin(0.3, step));
      joints[j] = fmax(scene->joints[j].low, fmin(scene->joints[j].high, joints[j]));
    }
  }
  return 0;
}
// Joint values about `around`, each at most `spread` away (0: anywhere), within the limits.
TASK_DEF void task_random_joints(task_scene *scene, const double *around, double spread,
                                 double *joints) {
  for (int j = 0; j < scene->joint_count; j++) {
    double low = scene->joints[j].low;
    double high = scene->joints[j].high;
    if (around) {
      low = fmax(low, around[j] - spread);
      high = fmin(high, around[j] + spread);
    }
    joints[j] = shapes_uniform(&scene->rng, low, high);
  }
}
// Rounds joints to floats, and takes them back: what is checked shall be what is handed out.
TASK_DEF void task_round(const task_scene *scene, double *joints, float *out) {
  for (int j = 0; j < scene->joint_count; j++) joints[j] = (double)(out[j] = (float)joints[j]);
}
#define TASK_STEPS 12  // steps of an insertion
// Backs out from joints at `target` along `direction` (in base's frame, metres) in a straight line.
// Returns 1 and the joints reached if all of it is free by `clearance`.
TASK_DEF int task_back_out(const task_scene *scene, const double *joints, int body, int base,
                           const oracle_pose *target, const double *direction, double clearance,
                           double *reached) {
  double path[(TASK_STEPS + 1) * TASK_MAX_JOINTS];
  int count = scene->joint_count;
  size_t row = (size_t)count * sizeof(double);
  memcpy(path, joints, row);
  for (int s = 1; s <= TASK_STEPS; s++) {
    oracle_pose pose = *target;
    for (int k = 0; k < 3; k++) pose.position[k] += direction[k] * s / TASK_STEPS;
    memcpy(path + s * count, path + (s - 1) * count, row);
    if (!task_ik(scene, path + s * count, body, base, &pose)) return 0;
  }
  memcpy(reached, path + TASK_STEPS * count, row);
  return task_keeps(scene, path, TASK_STEPS + 1, clearance, NULL);
}

// ------------------------------------------------------------------------------------------ robots

TASK_DEF oracle_pose task_at(double x, double y, double z) {
  return task_pose(x, y, z, 0, 0, 0);
}
TASK_DEF void task_capsule(shapes_mesh *mesh, double ax, double ay, double az, double bx, double by,
                           double bz, double radius) {
  const double up[3] = {0, 0, 1};
  const double d[3] = {bx - ax, by - ay, bz - az};
  double axis[3];
  double q[4] = {0, 0, 0, 1};
  double length = oracle_length(d);
  size_t first = mesh->vertices;
  oracle_cross(up, d, axis);
  double sine = oracle_length(axis) / length;
  if (sine > 0) {
    for (int k = 0; k < 3; k++) axis[k] /= sine * length;
    oracle_axis_angle(axis, atan2(sine, d[2] / length), q);
  }
  shapes_capsule(mesh, radius, length, 12);
  shapes_place(mesh, first, q, (ax + bx) / 2, (ay + by) / 2, (az + bz) / 2);
}

#define TASK_TIP 0.19  // metres along z of the UR5's last link: the tips of the fingers

// The UR5 by its Denavit-Hartenberg table; link frames lie on the joints' axes. Six bodies. Chosen:
// the shoulder's housing is part of the upright foot, which a turn of joint 1 does not change; the
// jaw stands open at a width that takes every dish, as the hand is one body.
TASK_DEF void task_add_ur5(task_scene *scene, int parent) {
  const double p = TASK_PI;
  const task_joint joints[6] = {
      {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, -2 * p, 2 * p, p, 0, 0},
      {{0, 0, 0.089159}, {p / 2, 0, 0}, {0, 0, 1}, -2 * p, 2 * p, p, 0, 0},
      {{-0.425, 0, 0}, {0, 0, 0}, {0, 0, 1}, -p, p, p, 0, 0},
      {{-0.39225, 0, 0}, {0, 0, 0}, {0, 0, 1}, -2 * p, 2 * p, p, 0, 0},
      {{0, 0, 0.10915}, {p / 2, 0, 0}, {0, 0, 1}, -2 * p, 2 * p, p, 0, 0},
      {{0, 0, 0.09465}, {-p / 2, 0, 0}, {0, 0, 1}, -2 * p, 2 * p, p, 0, 0}};
  const oracle_pose none = task_at(0, 0, 0);
  shapes_mesh mesh;
  int first = task_add_chain(scene, joints, 6, parent);
  size_t at;
  memset(&mesh, 0, sizeof mesh);
  scene->foot = first;
  shapes_cylinder(&mesh, 0.07, 0.18, 16);  // 3 cm of it stand in what carries it
  task_add(scene, "foot", TASK_ROBOT, first, 1, task_at(0, 0, 0.06), &mesh);
  task_capsule(&mesh, 0, 0, 0.13585, -0.425, 0, 0.13585, 0.06);
  task_capsule(&mesh, 0, 0, 0.11, 0, 0, 0.14, 0.055);
  task_add(scene, "upper arm", TASK_ROBOT, first + 1, 1, none, &mesh);
  task_capsule(&mesh, 0, 0, 0.0165, -0.39225, 0, 0.0165, 0.06);
  task_add(scene, "forearm", TASK_ROBOT, first + 2, 1, none, &mesh);
  task_capsule(&mesh, 0, 0, 0.03, 0, 0, 0.10915, 0.04);
  task_add(scene, "wrist 1", TASK_ROBOT, first + 3, 1, none, &mesh);
  task_capsule(&mesh, 0, 0, 0, 0, 0, 0.09465, 0.04);  // comes within 1 cm of the forearm, by design
  task_add(scene, "wrist 2", TASK_ROBOT, first + 4, 2, none, &mesh);
  shapes_cylinder(&mesh, 0.0375, 0.05, 16);
  shapes_place(&mesh, 0, NULL, 0, 0, 0.0573);
  shapes_box_at(&mesh, 0, 0, 0.1073, 0.07, 0.06, 0.055);
  for (int s = -1; s <= 1; s += 2) {
    at = mesh.vertices;
    shapes_box(&mesh, 0.01, 0.03, 0.062, 1);
    shapes_place(&mesh, at, NULL, s * 0.027, 0, TASK_TIP - 0.031);
  }
  task_add(scene, "hand", TASK_ROBOT, first + 5, 2, none, &mesh);
}
// A configuration from which the hand looks down: elbow up, the arm towards `azimuth`, the jaw
// turned by `turn`.
TASK_DEF void task_ur5_down(double azimuth, double turn, double *joints) {
  const double nominal[6] = {azimuth - TASK_PI - 0.2, -1.3, 1.7, -1.97, -1.57, turn};
  memcpy(joints, nominal, sizeof nominal);
}

// ARMADA's arm: side 0 left, 1 right, its mirror image. Returns its first link. Three bodies.
// Chosen: where the boxes sit on their links, so that each spans from joint to joint.
TASK_DEF int task_add_armada_arm(task_scene *scene, int side) {
  const double p = TASK_PI;
  const double h = TASK_PI / 2;
  task_joint joints[6] = {{{0.02, 0.1036, 0.8358}, {0, 0, 0}, {0, 0, 1}, -1.571, 0.873, 10, 0, 0},
                          {{-0.02205, 0, 0.0528}, {-h, 0, h}, {0, 0, 1}, -1.571, 1.396, 10, 0, 0},
                          {{0.023, 0, 0.0565}, {-h, 0, -h}, {0, 0, 1}, -3.142, 1.396, 10, 0, 0},
                          {{-0.25, 0, 0.08318}, {0, 0, h}, {0, 0, 1}, -0.785, 1.309, 10, 0, 0},
                          {{0.014, 0.0001, 0}, {-h, 0, -h}, {0, 0, 1}, -3.665, 3.665, 15, 0, 0},
                          {{0.012203, 0, 0.2634}, {h, 0, h}, {0, 0, 1}, -2.182, 2.182, 15, 0, 0}};
  const double right_roll[6] = {0, h, h, p, -h, h};
  const double right_yaw[6] = {0, -h, h, -h, -h, h};
  const double mirror = side ? -1 : 1;
  shapes_mesh mesh;
  memset(&mesh, 0, sizeof mesh);
  for (int i = 0; side && i < 6; i++) {
    double low = joints[i].low;
    joints[i].low = -joints[i].high;
    joints[i].high = -low;
    joints[i].rpy[0] = right_roll[i];
    joints[i].rpy[2] = right_yaw[i];
  }
  if (side) {
    joints[0].origin[1] *= -1;
    joints[3].axis[2] = -1;
  }
  int first = task_add_chain(scene, joints, 6, 0);
  shapes_box(&mesh, 0.325, 0.12, 0.12, 2);
  task_add(scene, side ? "right upper arm" : "left upper arm", TASK_ROBOT, first + 2, 3,
           task_at(-0.125, 0, 0.04), &mesh);
  shapes_box(&mesh, 0.044, 0.058, 0.29, 2);
  task_add(scene, side ? "right forearm" : "left forearm", TASK_ROBOT, first + 4, 2,
           task_at(0.006, 0, 0.12), &mesh);
  shapes_box(&mesh, 0.05, 0.165, 0.053, 2);
  task_add(scene, side ? "right hand" : "left hand", TASK_ROBOT, first + 5, 1,
           task_at(mirror * 0.021, 0.02, -0.0165), &mesh);
  return first;
}

// ---------------------------------------------------------------------------- what all tasks share

// metres: start, goal and the way out of the goal keep this from everything. Chosen.
#define TASK_CLEAR 0.003
// starts, or ways to reach a goal, that are tried before the whole scene is drawn anew. Chosen.
#define TASK_SAMPLES 100

// Makes problem `index` the one that bodies and pairs are arranged for. A dish rests in the rack
// once its problem is over, and is absent before. The other tasks have one problem.
TASK_DEF void task_select(task_scene *scene, int index) {
  scene->selected = index;
  for (int i = 0; scene->problem_count > 1 && i < scene->problem_count; i++) {
    task_body *dish = &scene->bodies[scene->held[i]];
    dish->kind = i < index ? TASK_SCENE : i == index ? TASK_HELD : TASK_ABSENT;
    dish->link = i == index ? scene->joint_count : 0;
    dish->offset = i < index ? scene->settled[i] : scene->grasps[i];
  }
  task_find_pairs(scene);
}
TASK_DEF int task_configuration_free(const task_scene *scene, const double *joints,
                                     double clearance) {
  return task_in_limits(scene, joints) && task_keeps(scene, joints, 1, clearance, NULL);
}
// Takes joints as the goal of problem `index` if they are free there and `direction` leads straight
// out.
TASK_DEF int task_take_goal(task_scene *scene, int index, double *joints, int body, int base,
                            const oracle_pose *target, const double *direction) {
  double reached[TASK_MAX_JOINTS];
  task_problem *problem = &scene->problems[index];
  task_round(scene, joints, problem->goal);
  if (!task_configuration_free(scene, joints, TASK_CLEAR)) return 0;
  if (!task_back_out(scene, joints, body, base, target, direction, TASK_CLEAR / 2, reached))
    return 0;
  task_round(scene, reached, problem->approach);
  return 1;
}

// ---------------------------------------------------------------------------------- dish insertion

#define TASK_DISHES 6
#define TASK_SLOTS 4
#define TASK_PITCH 0.075  // metres from slot to slot
#define TASK_WIRE 0.004   // radius
#define TASK_RAIL 0.035   // height at which dishes stand

static const char *const task_dish_names[TASK_DISHES] = {
    "dinner plate", "dessert plate", "soup plate", "bowl", "saucer", "oval platter"};

// About z, the middle of its height at 0.
TASK_DEF void task_dish(shapes_mesh *mesh, int kind) {
  const double radius[TASK_DISHES] = {0.130, 0.100, 0.115, 0.090, 0.080, 0.130};
  const double height[TASK_DISHES] = {0.024, 0.020, 0.036, 0.040, 0.018, 0.026};
  double r = radius[kind];
  double h = height[kind];
  if (kind == 3)
    shapes_bowl(mesh, r, h, 0.005, 20);
  else
    shapes_plate(mesh, r, h, 0.005, 24);
  for (size_t i = 0; kind == 5 && i < mesh->vertices; i++) mesh->positions[3 * i + 1] *= 0.75;
  shapes_place(mesh, 0, NULL, 0, 0, -h / 2);
}
// Slots along x; dishes stand on two rails along x, between upright prongs.
TASK_DEF void task_rack(shapes_mesh *mesh) {
  double end = TASK_SLOTS * TASK_PITCH / 2 + 0.012;
  for (int s = -1; s <= 1; s += 2) {
    double y = s * 0.05;
    double rail[2][3] = {{-end, y, TASK_RAIL}, {end, y, TASK_RAIL}};
    double cross[2][3] = {{s * end, -0.08, TASK_RAIL}, {s * end, 0.08, TASK_RAIL}};
    shapes_rod_between(mesh, rail[0], rail[1], TASK_WIRE, 6);
    shapes_rod_between(mesh, cross[0], cross[1], TASK_WIRE, 6);
    for (int i = 0; i <= TASK_SLOTS; i++) {
      double x = (i - TASK_SLOTS / 2.0) * TASK_PITCH;
      double prong[2][3] = {{x, y, TASK_RAIL}, {x, s * 0.06, 0.125}};
      shapes_rod_between(mesh, prong[0], prong[1], TASK_WIRE, 6);
    }
    for (int i = -1; i <= 1; i += 2) {
      double leg[2][3] = {{i * end, s * 0.08, 0.001}, {i * end, s * 0.08, TASK_RAIL}};
      shapes_rod_between(mesh, leg[0], leg[1], 1.5 * TASK_WIRE, 6);
    }
  }
}
// Lets a dish down from `pose` until it touches the rack. No physics: it does not tip. A tenth of
// the tolerance of the search above the touch, so that it is free.
TASK_DEF oracle_pose task_rest(const oracle_mesh *dish, const oracle_pose *pose,
                               const oracle_mesh *rack, const oracle_pose *rack_pose) {
  const oracle_options options = {TASK_TOLERANCE, 0, 1, 1};
  const double drop = 0.2;
  oracle_pose way[2] = {*pose, *pose};
  way[1].position[2] -= drop;
  oracle_result r = oracle_sweep(dish, way, 2, rack, rack_pose, &options);
  way[0].position[2] -= r.status == ORACLE_COLLIDES ? r.time * drop - 2 * TASK_TOLERANCE : 0;
  return way[0];
}
// A start for problem `index`: the dish held beside the rack, at a height from which the straight
// way crosses it. Chosen: 35 to 100 degrees off the rack, every other joint within 0.4 rad of
// looking down.
TASK_DEF int task_dish_start(task_scene *scene, int index, double azimuth) {
  double nominal[6], q[6];
  oracle_pose links[TASK_MAX_JOINTS + 1];
  for (int attempt = 0; attempt < TASK_SAMPLES; attempt++) {
    double off = shapes_uniform(&scene->rng, 0.6, 1.75) * (shapes_pick(&scene->rng, 2) ? 1 : -1);
    task_ur5_down(azimuth + off, shapes_uniform(&scene->rng, -1.5, 1.5), nominal);
    task_random_joints(scene, nominal, 0.4, q);
    q[0] = nominal[0];
    task_links(scene, q, links);
    double z = task_body_pose(scene, scene->held[index], links).position[2];
    if (z < 0.16 || z > 0.40) continue;
    task_round(scene, q, scene->problems[index].start);
    if (task_configuration_free(scene, q, 0.01)) return 1;
  }
  return 0;
}
// Start, goal and resting place of problem `index`, its dish into `slot`.
TASK_DEF int task_dish_problem(task_scene *scene, int index, int slot, int rack, double azimuth) {
  const double lift = 0.01;
  const double up[3] = {0, 0, 0.13};  // chosen: released 1 cm above its rest
  const int dish = scene->held[index];
  const oracle_pose *rack_pose = &scene->bodies[rack].offset;
  // The hand looks down, its jaw closes along the rack.
  oracle_pose above =
      task_pose((slot - (TASK_SLOTS - 1) / 2.0) * TASK_PITCH, 0, 0.3, TASK_PI, 0, 0);
  oracle_pose turn = scene->grasps[index];
  oracle_pose target = task_compose(rack_pose, &above);
  memset(turn.position, 0, sizeof turn.position);
  target = task_compose(&target, &turn);
  target = scene->settled[index] =
      task_rest(&scene->bodies[dish].exact, &target, &scene->bodies[rack].exact, rack_pose);
  target.position[2] += lift;
  task_select(scene, index);
  for (int attempt = 0; attempt < 8; attempt++) {
    double nominal[6], q[6];
    task_ur5_down(azimuth, shapes_uniform(&scene->rng, -2, 2), nominal);
    task_random_joints(scene, nominal, 0.2, q);
    q[5] = nominal[5];
    if (task_ik(scene, q, dish, -1, &target) &&
        task_take_goal(scene, index, q, dish, -1, &target, up))
      return task_dish_start(scene, index, azimuth);
  }
  return 0;
}
// One draw of rack, dishes and slots. Returns 0 if the rack is out of reach or no start is free.
TASK_DEF int task_dish_draw(task_scene *scene, int rack) {
  double azimuth = shapes_uniform(&scene->rng, -0.6, 0.6);
  double far = shapes_uniform(&scene->rng, 0.45, 0.6);
  double yaw = shapes_uniform(&scene->rng, -TASK_PI / 2, TASK_PI / 2);
  int slots[TASK_SLOTS];
  scene->bodies[rack].offset = task_pose(far * cos(azimuth), far * sin(azimuth), 0, 0, 0, yaw);
  for (int i = 0; i < TASK_SLOTS; i++) {
    int j = shapes_pick(&scene->rng, i + 1);
    slots[i] = slots[j];
    slots[j] = i;
  }
  for (int i = 0; i < scene->problem_count; i++)
    if (!task_dish_problem(scene, i, slots[i], rack, azimuth)) return 0;
  return 1;
}
// A UR5 puts three of six dishes into a rack: three problems. Returns 0 without memory, or if 100
// draws do not do.
TASK_DEF int task_dish_episode(task_scene *scene, uint64_t seed) {
  int order[TASK_DISHES];
  int found = 0;
  shapes_mesh mesh;
  memset(&mesh, 0, sizeof mesh);
  task_begin(scene, "dish insertion", seed);
  task_add_ur5(scene, 0);
  shapes_box(&mesh, 1.2, 1.8, 0.04, 8);
  task_add(scene, "table", TASK_FLOOR, 0, 0, task_at(0.2, 0, -0.02), &mesh);
  task_rack(&mesh);
  int rack = task_add(scene, "rack", TASK_SCENE, 0, 0, task_at(0, 0, 0), &mesh);
  for (int i = 0; i < TASK_DISHES; i++) {
    int j = shapes_pick(&scene->rng, i + 1);
    order[i] = order[j];
    order[j] = i;
  }
  scene->problem_count = 3;
  for (int i = 0; i < 3; i++) {
    task_dish(&mesh, order[i]);
    // Seen from the hand, the dish's axis is x; 15 mm of its rim are between the fingers. An oval
    // one is held on its long side.
    double rim = 0;
    for (size_t v = 0; v < mesh.vertices; v++) rim = fmax(rim, mesh.positions[3 * v]);
    scene->grasps[i] = task_pose(0, 0, TASK_TIP - 0.015 + rim, 0, TASK_PI / 2, 0);
    scene->held[i] =
        task_add(scene, task_dish_names[order[i]], TASK_ABSENT, 0, 1, task_at(0, 0, -10), &mesh);
  }
  for (int draw = 0; draw < 100 && !found && !scene->failed; draw++)
    found = task_dish_draw(scene, rack);
  if (found && !scene->failed) return task_select(scene, 0), 1;
  return task_free(scene), 0;
}

// ------------------------------------------------------------------------------ bimanual insertion

#define TASK_MAX_CORNERS 16

// A cross-section: `corners` of a polygon, all sides of which are moved outwards by `grow`. half:
// half extents.
typedef struct task_section {
  int corners;
  double half[2];
} task_section;

TASK_DEF void task_outline(const task_section *section, double grow, double (*out)[2]) {
  int n = section->corners;
  for (int i = 0; i < n; i++) {  // a regular polygon whose inscribed circle has radius 1, stretched
    double angle = 2 * TASK_PI * (i + 0.5) / n;
    double r = 1 / cos(TASK_PI / n);
    out[i][0] = (section->half[0] + grow) * r * cos(angle);
    out[i][1] = (section->half[1] + grow) * r * sin(angle);
  }
}
// A closed body of `rings` outlines, one above the other or one in the other, grown by grow (rings)
// at heights z (rings).
TASK_DEF void task_rings(shapes_mesh *mesh, const task_section *section, int rings,
                         const double *grow, const double *z) {
  const uint32_t n = (uint32_t)section->corners;
  const uint32_t last = (uint32_t)(rings - 1) * n;
  double p[TASK_MAX_CORNERS][2];
  for (int ring = 0; ring < rings; ring++) {
    task_outline(section, grow[ring], p);
    for (uint32_t i = 0; i < n; i++) shapes_vertex(mesh, p[i][0], p[i][1], z[ring]);
  }
  for (uint32_t i = 0; i < last; i++) {
    uint32_t next = i / n * n + (i + 1) % n;
    shapes_quad(mesh, i, next, next + n, i + n);
  }
  for (uint32_t i = 1; i + 1 < n; i++) {
    shapes_triangle(mesh, 0, i + 1, i);
    shapes_triangle(mesh, last, last + i, last + i + 1);
  }
}
// The tip at the origin, pointing along z, chamfered.
TASK_DEF void task_peg(shapes_mesh *mesh, const task_section *section, double length) {
  const double chamfer = 0.004;
  const double z[3] = {-length, -chamfer, 0};
  const double grow[3] = {0, 0, -chamfer};
  task_rings(mesh, section, 3, grow, z);
}
// A block with a blind hole: the mouth at the origin, opening along z. Up the outside, over the
// rim, down the hole.
TASK_DEF void task_block(shapes_mesh *mesh, const task_section *section, double clearance,
                         double wall, double depth, double floor) {
  const double z[4] = {-depth - floor, 0, 0, -depth};
  const double grow[4] = {clearance + wall, clearance + wall, clearance, clearance};
  task_rings(mesh, section, 4, grow, z);
}
// Draws the right arm's joints until the block is in front of the chest, its hole towards the left
// hand; then solves for the left arm with the peg at `peg`, as seen from the block, from the best
// of some draws.
TASK_DEF int task_bimanual_pose(task_scene *scene, const oracle_pose *peg, double *joints) {
  const int peg_body = scene->held[0];
  const int block = scene->held[1];
  oracle_pose links[TASK_MAX_JOINTS + 1], pose;
  double m[9];
  double q[TASK_MAX_JOINTS];
  double e[6];
  double least = HUGE_VAL;
  int good = 0;
  for (int attempt = 0; attempt < 2000 && !good; attempt++) {
    task_random_joints(scene, NULL, 0, joints);
    task_links(scene, joints, links);
    pose = task_body_pose(scene, block, links);
    oracle_matrix(pose.rotation, m);
    good = pose.position[0] > 0.22 && pose.position[0] < 0.45 && fabs(pose.position[1]) < 0.1 &&
           m[5] > 0.8 && pose.position[2] > 0.55 && pose.position[2] < 0.95;
  }
  memcpy(q, joints, sizeof q);
  for (int attempt = 0; attempt < 100 && good; attempt++) {
    task_error(scene, q, peg_body, block, peg, e);
    double error = 3 * oracle_length(e) + oracle_length(e + 3);
    if (error < least) {
      least = error;
      memcpy(joints, q, 6 * sizeof *q);
    }
    task_random_joints(scene, NULL, 0, q);
    memcpy(q + 6, joints + 6, 6 * sizeof *q);
  }
  if (!good) return 0;
  pose = task_compose(&pose, peg);
  return task_ik(scene, joints, peg_body, -1, &pose);
}
// ARMADA puts a peg into the hole of a block that it holds in the other hand. Returns 0 without
// memory, or if 2000 draws do not do. Chosen: 4 to 8 mm of room on every side, 30 to 50 mm into the
// hole; at the start the peg's tip is 8 to 18 cm beside the hole's axis, so that it must go round
// the rim.
TASK_DEF int task_bimanual_episode(task_scene *scene, uint64_t seed) {
  const int corners[4] = {16, 4, 6, 4};
  shapes_mesh mesh;
  shapes_rng *rng = &scene->rng;
  int found = 0;
  memset(&mesh, 0, sizeof mesh);
  task_begin(scene, "bimanual insertion", seed);
  shapes_box(&mesh, 0.11, 0.31, 1, 4);
  task_add(scene, "torso", TASK_ROBOT, 0, 0, task_at(0, 0, 0.5), &mesh);
  task_add_armada_arm(scene, 0);
  task_add_armada_arm(scene, 1);
  int shape = shapes_pick(rng, 4);
  double r = shapes_uniform(rng, 0.011, 0.018);
  double clearance = shapes_uniform(rng, 0.004, 0.008);
  double inserted = shapes_uniform(rng, 0.03, 0.05);
  double depth = inserted + 0.01;
  double floor = 0.055;
  double length = 0.16;
  task_section section = {corners[shape], {r, shape == 3 ? 1.7 * r : r}};
  // Both hands hold their thing by its end, straight on but for a tilt, at any angle about its
  // axis.
  for (int side = 0; side < 2; side++) {
    double tilt = shapes_uniform(rng, -0.3, 0.3);
    double twist = shapes_uniform(rng, -TASK_PI, TASK_PI);
    oracle_pose tool = task_pose(side ? -0.021 : 0.021, 0.06, -0.0165, -TASK_PI / 2 + tilt, 0, 0);
    oracle_pose end = task_pose(0, 0, side ? depth + floor : length, 0, 0, twist);
    if (side)
      task_block(&mesh, &section, clearance, 0.01, depth, floor);
    else
      task_peg(&mesh, &section, length);
    scene->held[side] = task_add(scene, side ? "block" : "peg", TASK_HELD, 6 + 6 * side, 0,
                                 task_compose(&tool, &end), &mesh);
  }
  scene->problem_count = 1;
  task_find_pairs(scene);
  for (int draw = 0; draw < 2000 && !found && !scene->failed; draw++) {
    const double out[3] = {0, 0, inserted + 0.03};
    double joints[TASK_MAX_JOINTS];
    double side = shapes_uniform(rng, -TASK_PI, TASK_PI);
    double far = shapes_uniform(rng, 0.08, 0.18);
    double tilt = shapes_uniform(rng, -0.5, 0.5);
    double up = shapes_uniform(rng, -0.02, 0.06);
    // A section looks the same after one corner's turn.
    double turn = 2 * TASK_PI / section.corners *
                  (shape == 3 ? 2 * shapes_pick(rng, 2) : shapes_pick(rng, section.corners));
    oracle_pose goal = task_pose(0, 0, -inserted, TASK_PI, 0, turn);
    oracle_pose start = task_pose(far * cos(side), far * sin(side), up, TASK_PI + tilt,
                                  shapes_uniform(rng, -0.5, 0.5), turn);
    if (!task_bimanual_pose(scene, &goal, joints)) continue;
    if (!task_take_goal(scene, 0, joints, scene->held[0], scene->held[1], &goal, out)) continue;
    for (int attempt = 0; attempt < 20 && !found; attempt++) {
      if (!task_bimanual_pose(scene, &start, joints)) continue;
      task_round(scene, joints, scene->problems[0].start);
      found = task_configuration_free(scene, joints, 0.01);
    }
  }
  if (found && !scene->failed) return 1;
  return task_free(scene), 0;
}

// ------------------------------------------------------------------------------------- mining site

#define TASK_OBSTACLES 8
#define TASK_TUNNEL 11.0       // metres long, from x = -0.6
#define TASK_TUNNEL_WIDTH 3.0  // from rock to rock, less what juts out

static const char *const task_obstacle_names[TASK_OBSTACLES] = {
    "wagon",         "loaded wagon", "tipped wagon", "fallen beam",
    "support frame", "beam stack",   "rock heap",    "crossed props"};

TASK_DEF void task_turned_box(shapes_mesh *mesh, double x, double y, double z, double dx, double dy,
                              double dz, double roll, double pitch, double yaw) {
  const oracle_pose turn = task_pose(0, 0, 0, roll, pitch, yaw);
  size_t first = mesh->vertices;
  shapes_box(mesh, dx, dy, dz, 3);
  shapes_place(mesh, first, turn.rotation, x, y, z);
}
TASK_DEF void task_rock(shapes_mesh *mesh, double x, double y, double z, double rx, double ry,
                        double rz) {
  size_t first = mesh->vertices;
  shapes_ellipsoid(mesh, rx, ry, rz, 10);
  shapes_place(mesh, first, NULL, x, y, z);
}
TASK_DEF void task_wagon(shapes_mesh *mesh) {
  size_t first = mesh->vertices;
  shapes_drawer(mesh, 1.1, 0.7, 0.5, 0.04);
  shapes_place(mesh, first, NULL, 0, 0, 0.22);
  for (int i = 0; i < 4; i++) {
    double x = i % 2 ? 0.35 : -0.35;
    double y = i / 2 ? 0.3 : -0.3;
    double hub[2][3] = {{x, y - 0.03, 0.14}, {x, y + 0.03, 0.14}};
    shapes_rod_between(mesh, hub[0], hub[1], 0.13, 14);
  }
}
// Stands on z = 0, its middle 0.55 m from the middle of the tunnel, on the side of +y.
TASK_DEF void task_obstacle(shapes_mesh *mesh, int kind) {
  const oracle_pose tipped = task_pose(0, 0, 0, 1.45, 0, 0.3);
  shapes_rng rng = {7};
  switch (kind) {
    case 0:
      task_wagon(mesh);
      break;
    case 1:
      task_wagon(mesh);
      for (int i = 0; i < 10; i++) {
        double x = shapes_uniform(&rng, -0.4, 0.4);
        double y = shapes_uniform(&rng, -0.22, 0.22);
        task_rock(mesh, x, y, shapes_uniform(&rng, 0.6, 0.78), 0.13, 0.11, 0.1);
      }
      break;
    case 2:
      task_wagon(mesh);
      shapes_place(mesh, 0, tipped.rotation, 0, 0.4, 0.36);
      break;
    case 3:  // from high up the wall down to the middle
      task_turned_box(mesh, 0, 0.05, 0.62, 0.2, 1.75, 0.2, -0.72, 0, 0.2);
      task_rock(mesh, 0.1, -0.55, 0.08, 0.28, 0.2, 0.16);
      break;
    case 4:  // the way leads through the frame, beside the brace
      shapes_box_at(mesh, 0, -0.35, 0.75, 0.18, 0.18, 1.5);
      shapes_box_at(mesh, 0, -1.85, 0.75, 0.18, 0.18, 1.5);
      shapes_box_at(mesh, 0, -0.6, 1.6, 0.2, 2.7, 0.2);
      task_turned_box(mesh, 0, 0.2, 0.7, 0.12, 1.5, 0.12, 0.85, 0, 0);
      break;
    case 5:
      for (int i = 0; i < 7; i++) {
        double y = i < 4 ? -0.33 + 0.24 * i : -0.2 + 0.24 * (i - 4);
        task_turned_box(mesh, 0.05 * (i % 3), y, i < 4 ? 0.11 : 0.32, 1.1, 0.2, 0.2, 0, 0,
                        0.05 * (i % 4) - 0.07);
      }
      break;
    case 6:
      for (int i = 0; i < 14; i++) {
        double x = shapes_uniform(&rng, -0.5, 0.5);
        double y = shapes_uniform(&rng, -0.35, 0.6);
        double r = shapes_uniform(&rng, 0.15, 0.28);
        task_rock(mesh, x, y, 0.1 + 0.4 * fmax(0, y), r, 0.8 * r, 0.8 * r);
      }
      break;
    default:
      task_turned_box(mesh, -0.08, 0.1, 0.7, 0.14, 0.14, 1.7, 0.6, 0, 0);
      task_turned_box(mesh, 0.08, 0.1, 0.7, 0.14, 0.14, 1.7, -0.6, 0, 0);
      break;
  }
}
// Handle along x with the grip at the origin, head along z, 0.42 m ahead.
TASK_DEF void task_pickaxe(shapes_mesh *mesh) {
  double head[9][3];
  task_capsule(mesh, -0.2, 0, 0, 0.44, 0, 0, 0.016);
  for (int i = 0; i < 9; i++) {
    double z = 0.05 * (i - 4);
    head[i][0] = 0.42 - 1.2 * z * z;
    head[i][1] = 0;
    head[i][2] = z;
  }
  shapes_tube(mesh, (const double(*)[3])head, 9, 0.018, 8, 0);
}
// The tunnel: floor tiles, rock on both sides with a jagged face, the coal face at the end. Cut
// into lengths that suit the encoder. Chosen: no roof, as nothing reaches it; the rock is 2 m high.
TASK_DEF void task_tunnel(task_scene *scene) {
  const double length = TASK_TUNNEL / 4;
  shapes_rng rng = {11};  // the mine is the same for every seed
  shapes_mesh mesh;
  memset(&mesh, 0, sizeof mesh);
  for (int i = 0; i < 4; i++) {
    double x = -0.6 + length * (i + 0.5);
    shapes_box(&mesh, length, TASK_TUNNEL_WIDTH + 0.6, 0.06, 10);
    task_add(scene, "floor", TASK_FLOOR, 0, 0, task_at(x, 0, -0.03), &mesh);
    for (int side = 0; side < 2; side++) {
      double p[10][2];
      for (int k = 0; k < 8; k++) {
        double jut = k % 7 ? shapes_uniform(&rng, 0, 0.2) : 0.1;
        p[k][0] = length * (k / 7.0 - 0.5);
        p[k][1] = TASK_TUNNEL_WIDTH / 2 - jut;
      }
      p[8][0] = length / 2;
      p[9][0] = -length / 2;
      p[8][1] = p[9][1] = TASK_TUNNEL_WIDTH / 2 + 0.3;
      shapes_extrude(&mesh, (const double(*)[2])p, 10, 2);
      task_add(scene, side ? "right rock" : "left rock", TASK_SCENE, 0, 0,
               task_pose(x, 0, 1, 0, 0, side ? TASK_PI : 0), &mesh);
    }
  }
  shapes_box(&mesh, 0.3, TASK_TUNNEL_WIDTH, 2, 6);
  task_add(scene, "coal face", TASK_SCENE, 0, 0, task_at(TASK_TUNNEL - 0.45, 0, 1), &mesh);
}
// A UR5 on a base that slides and turns (x, y, yaw, then the arm) carries a pickaxe past four of
// eight obstacles to the end of the tunnel. Returns 0 without memory, or if no start is free.
// Chosen: which places and sides the obstacles stand on; 3 cm of air under the base, and 6 between
// it and the level upper arm; the base's limits and speeds; the goal.
TASK_DEF int task_mining_episode(task_scene *scene, uint64_t seed) {
  const double p = TASK_PI;
  const double foot = 0.34;
  const double back[3] = {-0.4, 0, 0};
  const task_joint base[3] = {{{0, 0, foot}, {0, 0, 0}, {1, 0, 0}, -0.2, 10.2, 1, 1, 0},
                              {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, -1.2, 1.2, 1, 1, 0},
                              {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, -p, p, 1.5, 0, 0}};
  const double carry[9] = {0.2, 0, 0, -p, -1.9, 2.2, -1.87, -p / 2, 0};
  const double dig[9] = {9.5, 0.2, 0, -p, -1.9, 1.9, -p, -p / 2, p};
  const double place[4] = {2.0, 3.6, 6.1, 7.8};
  shapes_mesh mesh;
  double joints[TASK_MAX_JOINTS];
  oracle_pose links[TASK_MAX_JOINTS + 1], target;
  int order[TASK_OBSTACLES];
  int found = 0;
  memset(&mesh, 0, sizeof mesh);
  task_begin(scene, "mining site", seed);
  task_add_chain(scene, base, 3, 0);
  shapes_box(&mesh, 0.43, 0.35, 0.29, 3);
  task_add(scene, "base", TASK_ROBOT, 3, 0, task_at(-0.135, 0, -0.165), &mesh);
  task_add_ur5(scene, 3);
  task_pickaxe(&mesh);
  scene->held[0] = task_add(scene, "pickaxe", TASK_HELD, 9, 1,
                            task_pose(0, 0, TASK_TIP - 0.02, 0, 0, p / 2), &mesh);
  task_tunnel(scene);
  for (int i = 0; i < TASK_OBSTACLES; i++) {
    int j = shapes_pick(&scene->rng, i + 1);
    order[i] = order[j];
    order[j] = i;
  }
  for (int i = 0; i < 4; i++) {  // two on the left, then two on the right
    task_obstacle(&mesh, order[i]);
    task_add(scene, task_obstacle_names[order[i]], TASK_SCENE, 0, 0,
             task_pose(place[i], i < 2 ? 0.55 : -0.55, 0, 0, 0, i < 2 ? 0 : p), &mesh);
  }
  scene->problem_count = 1;
  task_find_pairs(scene);
  memcpy(joints, dig, sizeof dig);
  task_links(scene, joints, links);
  target = task_body_pose(scene, scene->held[0], links);
  if (!scene->failed && task_take_goal(scene, 0, joints, scene->held[0], -1, &target, back))
    for (int attempt = 0; attempt < TASK_SAMPLES && !found; attempt++) {
      task_random_joints(scene, carry, 0.4, joints);
      task_round(scene, joints, scene->problems[0].start);
      found = task_configuration_free(scene, joints, 0.02);
    }
  if (found) return 1;
  return task_free(scene), 0;
}

// ----------------------------------------------------------------------------------------- to plan

// The selected problem as nsvcd_plan takes it, and what it points to.
typedef struct task_statement {
  nsvcd_plan_problem problem;
  float low[TASK_MAX_JOINTS], high[TASK_MAX_JOINTS];
  nsvcd_body_pair pairs[TASK_MAX_PAIRS];
} task_statement;

// States all of a problem but the callbacks. The statement must stay where it is, and the scene and
// bodies too.
TASK_DEF void task_state(const task_scene *scene, const nsvcd_body *const *bodies,
                         task_statement *statement) {
  nsvcd_plan_problem *problem = &statement->problem;
  for (int j = 0; j < scene->joint_count; j++) {
    statement->low[j] = (float)scene->joints[j].low;
    statement->high[j] = (float)scene->joints[j].high;
  }
  // b is held fixed in a query: what stands still is the scene's first
  for (int i = 0; i < scene->pair_count; i++) {
    statement->pairs[i].a = (uint32_t)scene->pairs[i][1];
    statement->pairs[i].b = (uint32_t)scene->pairs[i][0];
  }
  memset(problem, 0, sizeof *problem);
  problem->joints = (size_t)scene->joint_count;
  problem->low = statement->low;
  problem->high = statement->high;
  problem->start = scene->problems[scene->selected].start;
  problem->goal = scene->problems[scene->selected].goal;
  problem->bodies = bodies;
  problem->body_count = (size_t)scene->body_count;
  problem->pairs = statement->pairs;
  problem->pair_count = (size_t)scene->pair_count;
}

#endif
