# SPDX-License-Identifier: MIT
"""Does this body, moving along this trajectory, hit that body? neuralsvcd.h for Python, by ctypes.

    rack = Body("dish_rack.obj")             # or STL, PLY, GLB; scale=0.001: of millimetres
    answer = sweep(mug, rack, path, ask="first")  # path: (k, 7), or matrices (k, 4, 4)
    if answer.verdict == "hit": print(answer.time.high)  # when first; without `ask`: when there is a contact

Units are metres and radians, time is in [0, 1]. A pose is x y z and a unit quaternion x y z w; a
motion is an array (k, 7) of poses, uniform in time, position linear and rotation slerp in between.
Wherever there are poses, rigid 4x4 matrices may be instead: poses.
Arrays may be of any numeric type and stride: they are copied, as float32. What an answer is worth,
and what each option and field means in full, is said in neuralsvcd.h under the same names.

Threads may share everything here but Movers. The library has its memory for each thread, and while it
works, other Python threads run. What it refuses is raised as Error; arrays of the wrong shape or type are
ValueError and TypeError.
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
    Checked as Checked, Joint as Joint, Joints as Joints, Motion as Motion, Part as Part, Proximity as Proximity, Reached as Reached,
    Robot as Robot, Route as Route)
from .sweeps import (
    Gradient as Gradient, contacts as contacts, sweep as sweep, sweep_gradient as sweep_gradient)
from .words import (
    Ask as Ask, By as By, Code as Code, JointKind as JointKind, LEAVE_OUT as LEAVE_OUT, Method as Method,
    Model as Model, NO_TRIANGLE as NO_TRIANGLE, PlanStatus as PlanStatus, Precision as Precision,
    RouteStatus as RouteStatus, Verdict as Verdict, Why as Why)
from .worlds import (
    Resident as Resident, Slide as Slide, World as World, WorldAnswer as WorldAnswer)
