# SPDX-License-Identifier: MIT
"""Does this body, moving along this trajectory, hit that body? neuralsvcd.h for Python, by ctypes.

    rack = Body("dish_rack.obj")                  # or STL, PLY, GLB; scale=0.001: of millimetres
    path = [[0, -0.4, 0.3], [0, 0, 0]]            # positions; or poses (k, 7), or matrices (k, 4, 4)
    answer = sweep("mug.obj", rack, path, ask="first")
    if answer.verdict == "hit": print(answer.time.high)   # when first; without `ask`: when there is a contact

What is free, or hits, is proven, of all times between the poses too, but where the network is asked: answer.by says so.
help(neuralsvcd.sweep) and the like have all arguments, in units; neuralsvcd.h has what each means in full, by the same names.
examples/python/tour.ipynb is a tour.

WHAT TO ASK
  Do two bodies meet, and when, and how near do they come?   sweep
  Where are two bodies at rest near each other?              contacts
  Is a robot's motion free? Find one that is.                Robot.check, Robot.route, Robot.reach
  What does a body meet among many? Let things fall.         World.sweep, World.list, World.step
  Prove an answer to somebody else.                          certify, and nsvcd_verify.verify there
  Optimize a trajectory.                                     plan, sweep_gradient

MESHES AND BODIES
  A Body is a mesh, encoded for questions; it does not change. Where a body or a mesh is wanted there may also be the path of an
  OBJ, STL, PLY or GLB file, (vertices, faces), or what has .vertices and .faces, like a trimesh.Trimesh, or .triangles, like an
  open3d mesh. It is then encoded for that call alone: what is asked about again is to be a Body.

    crate = Body.box([0.4, 0.3, 0.2])
    ball = Body.sphere(0.1)
    pole = Body.capsule([0, 0, 0], [0, 0, 1], 0.05)
    level = Body(Mesh.heights([[0, 0, 0], [0, 1, 0], [0, 0, 0]], step=0.5), open=True)

  Body.cloud(points, radius) and Body.hull(points) are others. Mesh.load, parse, box, hull and heights make a Mesh, of vertices
  (n, 3) and faces (m, 3), counter-clockwise seen from outside; mesh.cut takes a part, mesh.mass has its volume and inertia.
  Body.save and load, bytes(body) and Body.from_bytes, pickle and copy keep what was encoded. body.facts tells whether it is
  closed: nothing is inside of what is not, and it should be said to be open.

POSES AND MOTIONS
  Metres and radians. A pose is x y z and a unit quaternion x y z w, (7,); a position alone, (3,); or a rigid matrix (4, 4), which
  takes points as columns. A motion is k of these, (k, 7), (k, 3) or (k, 4, 4), uniform in time from 0 to 1, or at times_a and
  times_b: positions linear, rotations slerp in between. One pose is a body at rest; None is one at the origin. A pose may also be
  an SE3 of pinocchio or spatialmath, or a Pose or Transform of ROS. Quaternions are w x y z in MuJoCo: poses(qpos, order="wxyz").
  Rotations apart from positions: poses(data.geom_xpos, rotations=data.geom_xmat); examples/python/mujoco_scene.py makes bodies of
  geoms. What is returned is x y z w: poses(answer.safe.a, to="wxyz").
  Arrays may be of any numeric type and stride. They are copied: meshes and poses as float32, with a warning where rounding moves
  them much, far from the origin; of robots, joints' values as float64.

ANSWERS
  answer.verdict is free, hit or undecided, a word that is compared as a string; so is route.status. `if answer:` is true of what
  is not free, and so with World.sweep and Robot.check; `if route:` of one that was found; `if report:`, of nsvcd_verify, of a
  proof that all is free. Other tuples, a Certificate, are always true. answer.why says why something is undecided: it came too
  near to tell, or the work was spent (work=). answer.time brackets a contact, answer.distance the least distance (ask="distance",
  to=0.001), answer.contacts tells where, answer.safe where the bodies may go. answer.plot(a, b, path) draws it, if matplotlib is
  there.

MANY AT ONCE
  Of n motions (n, k, 7), (n, k, 3) or (n, k, 4, 4), sweep answers in one call, with an array of records:

    paths = np.tile(path, (1000, 1, 1))
    paths[:, :, 0] = np.linspace(-0.5, 0.5, 1000)[:, None]
    answers = sweep("mug.obj", rack, paths, ask="first", threads=2)
    hits = answers.verdict == "hit"
    earliest = answers.time.high[hits].min()

  Bodies, times and scales may be n as well.

ROBOTS
  Robot.from_urdf reads joints, parts and pairs; or a Robot is made of Joint, Part and pairs. A configuration is an array (F), or
  maps the names of joints to values. robot.check(points) proves a motion of the joints themselves, by polylines or Bezier pieces;
  robot.route(start, goals) finds one within speeds and accelerations, whose route.at(times) are its joints.

    arm = Robot.from_urdf("../robot/arm.urdf", srdf="../robot/arm.srdf", obstacles="../robot/shelf.urdf")
    checked = arm.check({"pan": [0, 1], "lift": -0.5, "elbow": 0.5, "wrist_1": 0, "wrist_2": 0, "wrist_3": 0})
    if checked.verdict == "hit": print(arm.pair_names(checked.pair))
    if checked.joint is not None: print(arm.joint_names[checked.joint], "leaves its limits")

WORLDS
  A World has bodies at their places, by ids. world.sweep(id or body, path) asks about one and all others; world.slide moves one as
  far as is free, and world.step many, with masses and friction, as Movers: arrays, a row for each.

    world = World(100)
    floor, box = world.add(Body.box([9, 9, 1]), [0, 0, -0.5], fixed=True), world.add(crate, [0, 0, 1])
    movers = Movers([box], mass=1, friction=0.5)
    for frame in range(60): world.step(movers, 1 / 60)

PROOFS
  certify(a, b, path) writes bytes that prove to whoever has the meshes that they meet, or never do. nsvcd_verify, which shares
  nothing with this package, says what they prove: nsvcd_verify.verify(bytes, a, b, poses(path)).

ERRORS
  Error is what the library refuses: error.code is why, a Code; error.where names the argument, or the file, and error.line its
  line; error.index which of many. ValueError is a wrong shape or an unknown word, TypeError what is no number, no mesh or no Body,
  OSError a file that cannot be read. What a callback raises comes out as it is.

THREADS
  The interpreter's lock is released while the library works. Threads may share everything but a Robot and Movers; a World has
  whoever changes it wait. sweep(..., threads=2) shares many motions among threads of its own. Short questions, one by one, from
  several threads wait for the lock: ask them in one call.

COSTS
  A question takes some microseconds, of which Python's part is 10 to 12; in one call with many, half a microsecond
  (examples/python/overhead.py). ask="first" takes three to five times as long, ask="distance" ten to twenty; of either, one in
  hundreds takes milliseconds. Encoding takes far longer: what is asked about again is to be a Body.

NAMES
  meshes       Mesh, Mass, MeshLike
  bodies       Body, Facts, BodyLike
  questions    sweep, contacts, sweep_gradient, poses; Ask, Method, Model, Precision
  answers      Answer, Verdict, By, Why, Range, Contact, SafePlace, Opinion, Gradient, NO_TRIANGLE
  robots       Robot, Joint, JointKind, Joints, Part, Motion, Checked, Proximity, Reached, Route, RouteStatus, LEAVE_OUT
  worlds       World, Movers, Step, Slide, WorldAnswer, WorldContact, Resident
  certificates certify, Certificate, Tree, TreeLike
  trajectories plan, spline, Plan, PlanStatus, Stage, Progress
  errors       Error, Code
"""
from ._library import __version__ as __version__
from .answers import Answer as Answer, Contact as Contact, Opinion as Opinion, Range as Range, SafePlace as SafePlace
from .bodies import Body as Body, BodyLike as BodyLike, Facts as Facts
from .certificates import Certificate as Certificate, Tree as Tree, TreeLike as TreeLike, certify as certify
from .errors import Error as Error
from .meshes import Mass as Mass, Mesh as Mesh, MeshLike as MeshLike
from .motions import poses as poses
from .movers import Movers as Movers, Step as Step, WorldContact as WorldContact
from .plans import (
    Plan as Plan, Progress as Progress, Stage as Stage, plan as plan, spline as spline)
from .robots import (
    Checked as Checked, Joint as Joint, Joints as Joints, Motion as Motion, Part as Part, Proximity as Proximity,
    Reached as Reached, Robot as Robot, Route as Route)
from .sweeps import (
    Gradient as Gradient, contacts as contacts, sweep as sweep, sweep_gradient as sweep_gradient)
from .words import (
    Ask as Ask, By as By, Code as Code, JointKind as JointKind, LEAVE_OUT as LEAVE_OUT, Method as Method,
    Model as Model, NO_TRIANGLE as NO_TRIANGLE, PlanStatus as PlanStatus, Precision as Precision,
    RouteStatus as RouteStatus, Verdict as Verdict, Why as Why)
from .worlds import (
    Resident as Resident, Slide as Slide, World as World, WorldAnswer as WorldAnswer)
