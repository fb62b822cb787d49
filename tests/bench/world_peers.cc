// world_peers.cc - Bullet's answers to what bench_world.c asks: the same casts in the same level, and
// the same bodies that fall on it. `make bench-world` builds it where Debian's libbullet-dev is.
//
//   build/world_peers casts                    translations: a ray, a sphere, a capsule, a box, a plank
//   build/world_peers frames [MOVERS [FRAMES]] of convex hulls, with both margins, and with CCD
//
// The level is a btBvhTriangleMeshShape. Casts go to it alone (rayTestSingle, objectQuerySingle),
// without a broad phase, as nsvcd_sweep does. What Bullet cannot be asked is left out: its casts do
// not turn, what is cast is convex, and movers are the hulls of their meshes. Frames are those of
// btDiscreteDynamicsWorld with its defaults, one step a frame; bodies may sleep.
#define WORLD_PEERS
#include "bench_world.c"

#include <btBulletDynamicsCommon.h>

#include <vector>

static btTransform transform_of(const nsvcd_pose &pose) {
  const float *p = pose.position;
  const float *q = pose.rotation;
  return btTransform(btQuaternion(q[0], q[1], q[2], q[3]), btVector3(p[0], p[1], p[2]));
}

static nsvcd_pose pose_of(const btTransform &t) {
  const btQuaternion q = t.getRotation();
  const double rotation[4] = {q.x(), q.y(), q.z(), q.w()};
  return pose_at(t.getOrigin().x(), t.getOrigin().y(), t.getOrigin().z(), rotation);
}

// The level, as Bullet has it. It lives as long as the program.
static btBvhTriangleMeshShape *level_shape(const shapes_mesh &mesh) {
  static std::vector<btScalar> points;
  static std::vector<int> indices;
  points.assign(mesh.positions, mesh.positions + 3 * mesh.vertices);
  indices.assign(mesh.indices, mesh.indices + 3 * mesh.triangles);
  static btTriangleIndexVertexArray triangles((int)mesh.triangles, indices.data(), 3 * sizeof(int),
                                              (int)mesh.vertices, points.data(),
                                              3 * sizeof(btScalar));
  return new btBvhTriangleMeshShape(&triangles, true);
}

// ------------------------------------------------------------------------------------------ casts

// What stands for a body of a cast; with a mesh, if it has no radius.
struct cast_peer {
  const btConvexShape *shape;  // none: a ray
  oracle_mesh exact;
};

// The fraction of the way at which it hits, or 1.
static double bullet_cast(btCollisionObject *level, const btConvexShape *shape,
                          const btTransform &from, const btTransform &to) {
  if (!shape) {
    btCollisionWorld::ClosestRayResultCallback found(from.getOrigin(), to.getOrigin());
    btCollisionWorld::rayTestSingle(from, to, level, level->getCollisionShape(),
                                    level->getWorldTransform(), found);
    return (double)found.m_closestHitFraction;
  }
  btCollisionWorld::ClosestConvexResultCallback found(from.getOrigin(), to.getOrigin());
  btCollisionWorld::objectQuerySingle(shape, from, to, level, level->getCollisionShape(),
                                      level->getWorldTransform(), found, 0);
  return (double)found.m_closestHitFraction;
}

// Does the oracle say that they meet, on a way on which Bullet sees nothing?
static bool is_met(const cast_peer &peer, const oracle_mesh &level, const nsvcd_pose path[2]) {
  if (!peer.exact.triangle_count) return false;
  const oracle_pose ways[2] = {pose_widened(&path[0]), pose_widened(&path[1])};
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  return oracle_sweep(&peer.exact, ways, 2, &level, &origin, NULL).status == ORACLE_COLLIDES;
}

static void print_peer_cast(const bench &b, const cast &c, btCollisionObject *level,
                            const oracle_mesh &exact, const cast_peer &peer) {
  static double ours[ASKED], theirs[ASKED], later[ASKED];
  shapes_rng rng = {7};
  size_t hits = 0;
  size_t their_hits = 0;
  size_t missed = 0;
  size_t confirmed = 0;
  size_t invented = 0;
  size_t both = 0;
  for (size_t k = 0; k < ASKED; k++) {
    nsvcd_pose path[2];
    nsvcd_answer answer;
    draw_cast(&b, &c, &rng, path);
    memcpy(path[1].rotation, path[0].rotation, sizeof path[0].rotation);
    ours[k] = ask_cast(&b, &c, path, &answer);
    const btTransform from = transform_of(path[0]);
    const btTransform to = transform_of(path[1]);
    double fraction = 1;
    theirs[k] = 1e9;
    for (int run = 0; run < RUNS; run++) {
      const double start = seconds();
      fraction = bullet_cast(level, peer.shape, from, to);
      theirs[k] = fmin(theirs[k], 1e6 * (seconds() - start));
    }
    const double metres = (double)(to.getOrigin() - from.getOrigin()).length();
    const bool is_hit = answer.verdict == NSVCD_HIT;
    const bool is_missed = is_hit && fraction >= 1;
    hits += is_hit;
    their_hits += fraction < 1;
    missed += is_missed;
    invented += answer.verdict == NSVCD_FREE && fraction < 1;
    confirmed += is_missed && is_met(peer, exact, path);
    if (is_hit && fraction < 1)
      later[both++] = 1e3 * (fraction - (double)answer.time.high) * metres;
  }
  meter_sort(later, both);
  printf("%s\n", c.name);
  print_times("  ours", ours, ASKED, 100.0 * (double)hits / ASKED);
  print_times("  Bullet", theirs, ASKED, 100.0 * (double)their_hits / ASKED);
  printf(
      "    of %zu that hit Bullet misses %zu (%zu of these meet by the oracle), and of those "
      "that "
      "are free it stops %zu; its contacts are later by %.2f mm in the median, from %.2f to "
      "%.2f\n",
      hits, missed, confirmed, invented, both ? later[both / 2] : 0, both ? later[0] : 0,
      both ? later[both - 1] : 0);
}

static int exact_of(const shapes_mesh &mesh, oracle_mesh *exact) {
  return oracle_mesh_init(exact, mesh.positions, mesh.vertices, mesh.indices, mesh.triangles, 1);
}

// Bullet rounds the edges of a box by its margin, within it.
static void print_peer_casts(const bench &b, btBvhTriangleMeshShape *shape) {
  cast casts[CASTS];
  make_casts(&b, casts);
  btCollisionObject level;
  level.setCollisionShape(shape);
  btSphereShape sphere(0.05f);
  btCapsuleShapeZ capsule(0.3f, 1.2f);
  btBoxShape box(btVector3(0.25f, 0.25f, 0.25f));
  btBoxShape sharp(btVector3(0.25f, 0.25f, 0.25f));
  btBoxShape plank(btVector3(0.6f, 0.06f, 0.02f));
  sharp.setMargin(0.001f);
  plank.setMargin(0.001f);
  oracle_mesh exact;
  shapes_mesh meshes[2] = {};
  cast_peer peers[CASTS] = {{NULL, {}}, {&sphere, {}}, {&capsule, {}},
                            {&box, {}}, {&plank, {}},  {&sharp, {}}};
  shapes_box(&meshes[0], 0.5, 0.5, 0.5, 1);
  shapes_box(&meshes[1], 1.2, 0.12, 0.04, 1);
  if (!exact_of(b.mesh, &exact) || !exact_of(meshes[0], &peers[3].exact) ||
      !exact_of(meshes[1], &peers[4].exact))
    exit(REFUSED);
  peers[5].exact = peers[3].exact;
  casts[5] = casts[3];
  casts[3].name = "box of 0.5 m, 1 to 10 cm; Bullet's with its default margin";
  casts[4].name = "plank of 1.2 m, to 10 cm, that does not turn; Bullet's with a margin of 1 mm";
  casts[5].name = "box of 0.5 m, 1 to 10 cm; Bullet's with a margin of 1 mm";
  printf("first contacts; the last column: of 100, how many hit. Bullet's level has no margin\n");
  for (int k = 0; k < CASTS; k++) print_peer_cast(b, casts[k], &level, exact, peers[k]);
  for (int k = 0; k < CASTS - 1; k++) nsvcd_body_free(casts[k].body, NULL);
  for (int k = 0; k < 2; k++) {
    oracle_mesh_free(&peers[3 + k].exact);
    shapes_free(&meshes[k]);
  }
  oracle_mesh_free(&exact);
}

// ----------------------------------------------------------------------------------------- frames

// Metres from a mover to the nearest other body, in the middle of all; what is farther than 0.2 m
// is left out.
static double median_gap(const scene &s) {
  std::vector<nsvcd_body_pair> pairs(64 * (s.movers + 1));
  std::vector<double> gaps(s.movers + 2, 0.2);
  size_t count;
  if (nsvcd_world_pairs(s.world, 0.1f, pairs.data(), pairs.size(), &count)) exit(REFUSED);
  for (size_t k = 0; k < count && k < pairs.size(); k++) {
    const size_t a = pairs[k].a;
    const size_t b = pairs[k].b;
    nsvcd_world_body one, other;
    if (nsvcd_world_get(s.world, a, &one) || nsvcd_world_get(s.world, b, &other)) exit(REFUSED);
    const oracle_pose at = pose_widened(&one.pose);
    const oracle_pose there = pose_widened(&other.pose);
    oracle_search search;
    oracle_search_begin(&search, &s.exact[a - 1], &s.exact[b - 1]);
    const double gap = oracle_search_run(&search, &at, &there, fmax(gaps[a], gaps[b]));
    gaps[a] = fmin(gaps[a], gap);
    gaps[b] = fmin(gaps[b], gap);
  }
  // ids from 1 on, the first is the level's
  meter_sort(gaps.data() + 2, s.movers);
  return gaps[2 + s.movers / 2];
}

struct settings {
  const char *name;
  float margin;
  bool ccd;
};

static btConvexHullShape *hull_of(const shapes_mesh &mesh, float margin) {
  btConvexHullShape *hull = new btConvexHullShape();
  for (size_t k = 0; k < mesh.vertices; k++) {
    const double *p = mesh.positions + 3 * k;
    hull->addPoint(btVector3((float)p[0], (float)p[1], (float)p[2]), false);
  }
  hull->recalcLocalAabb();
  hull->optimizeConvexHull();
  hull->setMargin(margin);
  return hull;
}

static void place(const scene &s, const std::vector<btRigidBody *> &bodies) {
  for (size_t k = 0; k < s.movers; k++) {
    const nsvcd_pose pose = pose_of(bodies[k]->getWorldTransform());
    if (nsvcd_world_move(s.world, s.all[k].id, &pose)) exit(REFUSED);
  }
}

static btRigidBody *mover_of(const bench &b, const scene &s, size_t k, btConvexHullShape *hull,
                             const settings &how) {
  const nsvcd_slide_options &o = s.all[k].how;
  nsvcd_world_body given;
  double low[3], high[3];
  if (nsvcd_world_get(s.world, s.all[k].id, &given)) exit(REFUSED);
  btRigidBody::btRigidBodyConstructionInfo info(
      1, NULL, hull, btVector3(o.inertia[0], o.inertia[1], o.inertia[2]));
  info.m_startWorldTransform = transform_of(given.pose);
  info.m_friction = sqrtf(0.5f);                // of two bodies they are multiplied
  info.m_angularDamping = 1 - powf(0.98f, 60);  // in a second
  btRigidBody *body = new btRigidBody(info);
  shapes_bounds(&b.props[k % PROPS], low, high);
  const double least = fmin(high[0] - low[0], fmin(high[1] - low[1], high[2] - low[2]));
  if (how.ccd) {
    body->setCcdMotionThreshold((float)(0.5 * least));
    body->setCcdSweptSphereRadius((float)(0.25 * least));
  }
  return body;
}

static void print_peer_frames(const bench &b, btBvhTriangleMeshShape *level, size_t movers,
                              size_t frames, const settings &how) {
  scene s;
  scene_begin(&b, movers, &s);
  level->setMargin(how.margin);
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase pairs;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &pairs, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -9.81f));
  btRigidBody::btRigidBodyConstructionInfo ground_info(0, NULL, level);
  ground_info.m_friction = sqrtf(0.5f);
  btRigidBody ground(ground_info);
  world.addRigidBody(&ground);
  std::vector<btConvexHullShape *> hulls;
  std::vector<btRigidBody *> bodies;
  std::vector<double> times(frames);
  for (int k = 0; k < PROPS; k++) hulls.push_back(hull_of(b.props[k], how.margin));
  for (size_t k = 0; k < movers; k++) {
    bodies.push_back(mover_of(b, s, k, hulls[k % PROPS], how));
    world.addRigidBody(bodies[k]);
  }
  for (size_t k = 0; k < frames; k++) {
    const double start = busy_seconds();
    world.stepSimulation(1.0f / 60, 0);
    times[k] = 1e3 * (busy_seconds() - start);
  }
  double sum = 0;
  size_t asleep = 0;
  size_t below = 0;
  for (size_t k = 0; k < frames; k++) sum += times[k];
  for (size_t k = 0; k < movers; k++) {
    const btVector3 &at = bodies[k]->getWorldTransform().getOrigin();
    asleep += !bodies[k]->isActive();
    below += at.z() < level_height(at.x(), at.y());
  }
  const double last = times[frames - 1];
  meter_sort(times.data(), frames);
  place(s, bodies);
  printf(
      "%zu movers, %zu frames, Bullet, %s: median %.2f  mean %.2f  99 %% %.2f  worst %.2f  "
      "last "
      "%.2f ms; %zu sleep at the end, %zu pairs overlap, %zu are below the level; the gap to "
      "what is nearest %.1f mm in the median\n",
      movers, frames, how.name, times[frames / 2], sum / (double)frames, times[frames * 99 / 100],
      times[frames - 1], last, asleep, overlaps_of(s.world, s.exact, movers), below,
      1e3 * median_gap(s));
  for (size_t k = 0; k < movers; k++) {
    world.removeRigidBody(bodies[k]);
    delete bodies[k];
  }
  world.removeRigidBody(&ground);
  for (size_t k = 0; k < hulls.size(); k++) delete hulls[k];
  scene_end(&s);
}

int main(int argc, char **argv) {
  static const settings all[] = {{"margin 40 mm, its default, CCD", 0.04f, true},
                                 {"margin 1 mm, CCD", 0.001f, true},
                                 {"margin 1 mm, no CCD", 0.001f, false}};
  static bench b;
  const char *what = argc > 1 ? argv[1] : "";
  begin(&b);
  btBvhTriangleMeshShape *level = level_shape(b.mesh);
  if (!*what || !strcmp(what, "casts")) print_peer_casts(b, level);
  if (!*what || !strcmp(what, "frames")) {
    const size_t frames = argc > 3 ? (size_t)strtoul(argv[3], NULL, 10) : 300;
    const size_t sizes[2] = {argc > 2 ? (size_t)strtoul(argv[2], NULL, 10) : 50, 1000};
    for (int k = 0; k < (argc > 2 ? 1 : 2); k++)
      for (const settings &how : all) print_peer_frames(b, level, sizes[k], frames, how);
  }
  delete level;
  end(&b);
  return DONE;
}
