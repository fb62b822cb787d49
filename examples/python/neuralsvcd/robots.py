# SPDX-License-Identifier: MIT
"""Motions of joints: checked, found, merged."""
from __future__ import annotations

import ctypes
import math
import operator
from collections.abc import Callable, Mapping, Sequence
from ctypes import byref, c_double, c_float, c_int, c_size_t, c_uint32, c_uint64, c_void_p
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .words import Code, JointKind, _KindWord, LEAVE_OUT, _number_of, _ROUTES, RouteStatus, Verdict, _VERDICTS, Why, _WHYS
from ._structs import (
    _Allowance, _CheckAnswer, _CheckOptions, _Cone, _Joint, _JointMotion, _NearestFreeOptions, _PairCounts, _Part,
    _PartialMotion, _Proximity, _ProximityOptions, _ReachAnswer, _ReachOptions, _ReachProblem, _RouteAnswer,
    _RouteOptions, _RouteProblem, _Scene, _STOP)
from ._library import _library
from .errors import _check, Error
from ._arrays import (
    _address, _cancels, _doubles, Doubles, FilePath, _filled, Floats, _floats, _IDENTITY, _indices, _memory, _number,
    _vector, Vector)
from .bodies import Body, _body_of, BodyLike
from .motions import _pose_of
from .answers import Range
from .urdfs import _read_urdf

Joints = Union[ArrayLike, Mapping[str, ArrayLike]]


class Joint(NamedTuple):
    """nsvcd_joint. Joint i carries link i + 1; link 0 is the world.

    parent         the link that it is on
    origin, axis   where it is in that link, a pose (7); any length but 0
    low, high      limits, radians or metres; not read of CONTINUOUS
    speed, acceleration  what a route keeps to; 0: 1
    mimic          the index of the joint that this one mimics; its value is always multiplier * that of the other + offset
    name           by which joints may be given: {"elbow": 1.5, ...}
    """
    parent: int
    origin: ArrayLike = _IDENTITY
    axis: ArrayLike = (0.0, 0.0, 1.0)
    kind: _KindWord = JointKind.REVOLUTE
    low: float = -math.pi
    high: float = math.pi
    speed: float = 0
    acceleration: float = 0
    mimic: Optional[int] = None
    multiplier: float = 1
    offset: float = 0
    name: str = ""


class Part(NamedTuple):
    """A body on a link: nsvcd_part. The body may be what stands for a mesh; a Robot encodes it."""
    body: BodyLike
    link: int = 0
    pose: ArrayLike = _IDENTITY
    scale: float = 0
    name: str = ""


class Motion(NamedTuple):
    """nsvcd_partial_motion: a motion of some of a robot's joints, on a clock of its own.

    joints         their indices, in the order of the points' columns
    points, degree, times  as `Robot.check` takes them
    delay          seconds, added to its times
    """
    joints: ArrayLike
    points: ArrayLike
    degree: int = 1
    times: Optional[ArrayLike] = None
    delay: float = 0


class Checked(NamedTuple):
    """nsvcd_check_answer.

    As a condition it is that the motion is not to be made: it is not free, or a joint leaves its limits.

    verdict       FREE: at all times of the joints' own motion, whether or not they keep their limits
    why           it is UNDECIDED
    pair          of a HIT, or of what is UNDECIDED: its index, or None
    piece, fraction  where in the motion, or None; of a HIT, which need not be the first
    point, normal of a HIT
    joint         one that leaves its limits, or None
    placed, sweeps  what it took
    free_until    seconds: free before that; with `to_time` a HIT follows at once
    cone          that an axis leaves, or may leave: its index, or None; there is no pair then, and no point
    """
    verdict: Verdict
    why: Why
    pair: Optional[int]
    piece: Optional[int]
    fraction: float
    point: Optional[Vector]
    normal: Optional[Vector]
    joint: Optional[int]
    placed: int
    sweeps: int
    free_until: float
    cone: Optional[int]

    def __bool__(self) -> bool:
        return self.verdict is not Verdict.FREE or self.joint is not None


class Proximity(NamedTuple):
    """nsvcd_proximity: two parts of a pair that are near each other.

    verdict, why   HIT: they touch
    distance       a bracket, metres
    depth          of a HIT: a push_out of the first by this along the normal parts them; inf: none was found. Else 0
    point, normal  on the second part, and from it to the first
    slope          (F): how the distance grows with each joint, or the depth shrinks
    """
    pair: int
    verdict: Verdict
    why: Why
    distance: Range
    depth: float
    point: Vector
    normal: Vector
    slope: Doubles


class Reached(NamedTuple):
    """nsvcd_reach_answer.

    solutions  (n, F): configurations that have the tool at its target, the nearest to the start first
    starts, reached, touching  how many starts there were, came to the target, and were not proven free there
    best       (F): the first solution; else one that touches; else the one nearest to the target
    position_error, angle_error  metres, radians: how far the tool is off its target there
    check      what is wrong with the best if it touches, else None
    """
    solutions: Doubles
    starts: int
    reached: int
    touching: int
    best: Doubles
    position_error: float
    angle_error: float
    check: Optional[Checked]


class Route(NamedTuple):
    """nsvcd_route_answer. route.at(times) are its joints, route.plot(robot) draws it.

    As a condition it is that one was found.

    status         found; limit, stopped: it was given up; start, goal: that is not free, and `check` says why
    goal           the index of the one that is reached, or None
    points, times  (2 pieces + 1, F) and (pieces + 1) seconds: Bezier pieces of degree 2, for `Robot.check`; None unless FOUND
    stops          times in between at which it rests
    duration, unhindered  seconds that it takes, and that the straight line would take if nothing were in its way
    nodes, checks, proven, looks  what it took
    """
    status: RouteStatus
    goal: Optional[int]
    points: Optional[Doubles]
    times: Optional[Doubles]
    stops: int
    duration: float
    unhindered: float
    check: Checked
    nodes: int
    checks: int
    proven: int
    looks: int

    def __bool__(self) -> bool:
        return self.status is RouteStatus.FOUND

    def plot(self, robot: Robot, count: int = 6, *, axes: Any = None) -> Any:
        """Draws a robot at so many times of the route into axes of matplotlib, projection="3d"; None: into a new figure.

        Returns the axes: axes.figure.savefig("route.png"). ImportError: there is no matplotlib.
        """
        from .pictures import _plot_route
        return _plot_route(self, robot, count, axes)

    def at(self, times: ArrayLike) -> Doubles:
        """The joints at times (n), seconds: (n, F)."""
        if self.points is None or self.times is None:
            raise ValueError("no route was found")
        t = np.clip(np.asarray(times, np.float64), 0, self.duration)
        if len(self.times) == 1:
            return np.broadcast_to(self.points[0], (*t.shape, len(self.points[0]))).copy()
        piece = np.clip(np.searchsorted(self.times, t, "right") - 1, 0, len(self.times) - 2)
        s = ((t - self.times[piece]) / (self.times[piece + 1] - self.times[piece]))[..., None]
        a, b, c = (self.points[2 * piece + k] for k in range(3))
        return np.asarray((1 - s) ** 2 * a + 2 * s * (1 - s) * b + s ** 2 * c)


def _index_or_none(index: int) -> Optional[int]:
    return None if index == LEAVE_OUT else index


def _checked(c: Any) -> Checked:
    is_hit = _VERDICTS[c.verdict] is Verdict.HIT and c.pair != LEAVE_OUT
    return Checked(_VERDICTS[c.verdict], _WHYS[c.why], _index_or_none(c.pair), _index_or_none(c.piece), c.fraction,
                   _vector(c.contact.point) if is_hit else None, _vector(c.contact.normal) if is_hit else None,
                   _index_or_none(c.joint), c.placed, c.sweeps, c.free_until, _index_or_none(c.cone))


def _motion_of(points: ArrayLike, joints: int, degree: int, times: Optional[ArrayLike], kept: list[Any]) -> Any:
    """A motion of so many joints; what it points to is kept."""
    rows = _doubles(np.atleast_2d(np.asarray(points)), (None, joints), "points")
    degree = _number(c_size_t, degree, "degree")
    if degree < 1 or (len(rows) - 1) % degree:
        raise ValueError(f"points: pieces of degree {degree} have a multiple of that, and 1, not {len(rows)}")
    pieces = (len(rows) - 1) // degree
    kept.append(rows)
    motion = _JointMotion(pieces, degree, _address(rows))
    if times is not None and pieces:
        kept.append(_doubles(times, (pieces + 1,), "times"))
        motion.times = _address(kept[-1])
    return motion


class Robot:
    """Joints, parts on their links, and which parts can meet: nsvcd_scene and its checker. One thread at a time.

        arm = Robot.from_urdf("arm.urdf", srdf="arm.srdf", obstacles="shelf.urdf")
        route = arm.route({"pan": -2.6, "lift": -0.7, ...}, goal)
        if route: send(route.at(np.arange(0, route.duration, 0.01)))

    Configurations are arrays (F) of all joints, radians and metres, in float64; or, where joints have names, what maps each
    name to its value, or to (n) of them; joints that mimic others may be left out.

    pairs  (P, 2) of parts, on links that differ; None: all but those that one joint separates, as `find_pairs` says.
           Also those that touch in all samples, which is no proof that they always do
    clearances  (P) metres that each of these pairs keeps, beside what `check` and `route` are asked for; None: 0
    allowances  (pair, joints, metres): where pairs may touch: as near as that to where they are in a configuration
    cones  (part, axis, direction, radians): an axis of a part, and where it is to point, in the world, to within that
    """

    def __init__(self, joints: Sequence[Joint], parts: Sequence[Part], pairs: Optional[ArrayLike] = None, *,
                 clearances: Optional[ArrayLike] = None, allowances: Sequence[tuple[int, ArrayLike, float]] = (),
                 cones: Sequence[tuple[int, ArrayLike, ArrayLike, float]] = ()) -> None:
        if (clearances is not None or allowances) and pairs is None:
            raise TypeError("clearances, allowances: of which pairs?")
        self._clearances: Optional[NDArray[np.float32]] = None
        self.joint_count, self.part_count = len(joints), len(parts)
        self.joint_names = tuple(joint.name for joint in joints)
        self.part_names = tuple(part.name for part in parts)
        self._mimics = [(k, j.mimic, j.multiplier, j.offset) for k, j in enumerate(joints) if j.mimic is not None]
        self._bodies = [_body_of(part.body, "body") for part in parts]
        self._size = min((body._size * (part.scale or 1) for body, part in zip(self._bodies, parts)), default=math.inf)
        self._joints = (_Joint * max(len(joints), 1))(*(
            _Joint(_number_of(JointKind(j.kind)), _number(c_uint32, j.parent, "parent"), _pose_of(j.origin, "origin", self._size),
                   (c_float * 3)(*_floats(j.axis, (3,), "axis").tolist()), j.low, j.high, j.speed, j.acceleration,
                   0 if j.mimic is None else _number(c_uint32, j.mimic + 1, "mimic"), j.multiplier, j.offset)
            for j in joints))
        self._parts = (_Part * max(len(parts), 1))(*(
            _Part(body._address, _number(c_uint32, part.link, "link"), _pose_of(part.pose, "pose", self._size), part.scale)
            for body, part in zip(self._bodies, parts)))
        if clearances is not None and pairs is not None:
            self._clearances = _floats(clearances, (len(_indices(pairs, 2, "pairs")),), "clearances")
        self._near = [_doubles(joints, (self.joint_count,), "allowances") for _, joints, _ in allowances]
        self._allowances = (_Allowance * max(len(allowances), 1))(*(
            _Allowance(_number(c_size_t, pair, "allowances"), _address(near), metres)
            for (pair, _, metres), near in zip(allowances, self._near)))
        self._cones = (_Cone * max(len(cones), 1))(*(
            _Cone(_number(c_uint32, part, "cones"),
                  *((c_float * 3)(*_floats(x, (3,), "cones").tolist()) for x in (axis, direction)), angle)
            for part, axis, direction, angle in cones))
        self._cone_count = len(cones)
        self._open(np.empty((0, 2), np.uint32) if pairs is None else pairs)
        if pairs is None:
            asked, _, touching = self.find_pairs()
            self._open(np.concatenate([asked, touching]))

    @classmethod
    def from_urdf(cls, path: FilePath, *, srdf: Optional[FilePath] = None, obstacles: Union[FilePath, Sequence[Part]] = (),
                  fixed: Mapping[str, float] = {}, package: Mapping[str, FilePath] = {}, ignore: Sequence[str] = (),
                  velocity: Optional[float] = None, round: Optional[float] = None, balls: int = 128) -> Robot:
        """The robot of a URDF, as `svcd plan` has it. What is not understood is refused, by link or joint: nothing is left
        out. Joints and parts have their names; fixed joints vanish: what is on them is on the link before.

        srdf       whose disabled pairs are not asked; else all pairs but those that a single joint connects are
        obstacles  a URDF without joints that move, or Parts on link 0: each is asked with all that moves
        fixed      joints that stand at a value, and so do those that mimic them
        package    where package://NAME is; by default at, beside or above the URDF, or where ROS has it
        ignore     elements and attributes that are not known, and may be left out
        velocity   of joints that have none; 1, with a warning
        round      metres that the corners of what is round may stand out; 0.5 % of the radius, of balls 1 %
        balls      of each part that moves, for routes: see Body

        ValueError: what is refused, and which of these lets it pass: "--fixed gripper" is fixed={"gripper": 0}. Error and
        OSError: of a mesh.
        """
        scene = _read_urdf(path, srdf, obstacles, fixed, package, ignore, velocity, round, balls)
        return cls([Joint(**joint) for joint in scene.joints], [Part(**part) for part in scene.parts],
                   np.array(scene.pairs, np.uint32).reshape(-1, 2))

    def pair_names(self, pair: int) -> tuple[str, str]:
        """The names of the two parts of a pair, as an answer has it: Checked.pair, Proximity.pair."""
        a, b = self._pairs[operator.index(pair)].tolist()
        return self.part_names[a], self.part_names[b]

    def _rows(self, given: Any, name: str) -> Any:
        """Configurations, also where they are given by the names of joints."""
        if isinstance(given, (list, tuple)) and given and all(isinstance(row, Mapping) for row in given):
            return np.stack([self._rows(row, name) for row in given])
        if not isinstance(given, Mapping):
            return given
        unknown = [str(joint) for joint in given if joint not in self.joint_names]
        missing = {joint for joint in self.joint_names} - set(given) - {self.joint_names[k] for k, *_ in self._mimics}
        if unknown or missing:
            raise ValueError(f"{name}: " + ", ".join([*(f"no joint {joint}" for joint in unknown),
                                                      *(f"{joint} is missing" for joint in self.joint_names if joint in missing)]))
        columns = np.broadcast_arrays(*(np.float64(given.get(joint, 0)) for joint in self.joint_names))
        rows = np.stack(columns, -1)
        for k, leader, multiplier, offset in self._mimics:
            if self.joint_names[k] not in given:
                rows[..., k] = multiplier * rows[..., leader] + offset
        return rows

    def _open(self, pairs: ArrayLike) -> None:
        self._pairs = _indices(pairs, 2, "pairs")
        self._scene = _Scene(ctypes.addressof(self._joints), self.joint_count, ctypes.addressof(self._parts),
                             self.part_count, _address(self._pairs), len(self._pairs),
                             None if self._clearances is None else _address(self._clearances),
                             ctypes.addressof(self._allowances), len(self._near), ctypes.addressof(self._cones), self._cone_count)
        size = _library.nsvcd_checker_size(byref(self._scene))
        self._memory = _memory(size)
        self._checker = c_void_p()
        _check(_library.nsvcd_checker_open(byref(self._scene), _address(self._memory), size, byref(self._checker)))

    def _held(self, held: Optional[ArrayLike]) -> Optional[NDArray[np.bool_]]:
        if held is None:
            return None
        if isinstance(held, (list, tuple, set)) and all(isinstance(name, str) for name in held):
            if unknown := [name for name in held if name not in self.joint_names]:
                raise ValueError(f"held: no joint {', '.join(map(str, unknown))}")
            held = [name in held for name in self.joint_names]
        stays = np.array(held, dtype=np.bool_)
        if stays.shape != (self.joint_count,):
            raise ValueError(f"held: expected {self.joint_count} values")
        return stays

    def _link(self, link: Union[int, str], name: str) -> Any:
        if isinstance(link, str):
            if link not in self.part_names + self.joint_names:
                raise ValueError(f"{name}: no part and no joint {link}")
            is_part = link in self.part_names
            link = self._parts[self.part_names.index(link)].link if is_part else self.joint_names.index(link) + 1
        return _number(c_uint32, link, name)

    def _drawn(self) -> list[tuple[Body, float]]:
        return [(body, part.scale or 1) for body, part in zip(self._bodies, self._parts)]

    @property
    def pairs(self) -> NDArray[np.uint32]:
        """Those that are asked: (P, 2)."""
        return self._pairs.copy()

    def find_pairs(self, draws: int = 0, seed: int = 0) -> tuple[NDArray[np.uint32], ...]:
        """Three arrays (n, 2) of pairs: that can meet, that one joint separates, and that touch in all of so many draws of the
        joints, 0: 64: nsvcd_find_pairs."""
        most = self.part_count * self.part_count
        found = np.empty((max(most, 1), 2), np.uint32)
        counts = _PairCounts()
        _check(_library.nsvcd_find_pairs(self._checker, _number(c_size_t, draws, "draws"),
                                         _number(c_uint64, seed, "seed"), _address(found), most, byref(counts)))
        ends = np.cumsum([counts.asked, counts.adjacent, counts.touching]).tolist()
        return tuple(found[first:last].copy() for first, last in zip([0, *ends], ends))

    def proximities(self, joints: Joints, *, max_distance: float = 0, to: float = 0, max_depth: float = 0,
                    work: int = 0) -> list[Proximity]:
        """All pairs that are near in a configuration (F), in the order of `pairs`: nsvcd_proximities.

        max_distance  metres: how near counts; 0: 0.05
        to            metres: how wide a bracket of a distance may be; 0: 20 um
        max_depth     metres: depths up to this are found; 0: 20 mm
        work          units of each question; 0: 100000
        Error: VALUE (not finite), MIMIC (a joint is not where what it mimics has it), POSE, SCALE.
        """
        row = _doubles(self._rows(joints, "joints"), (self.joint_count,), "joints")
        rows = (_Proximity * max(len(self._pairs), 1))()
        count = c_size_t()
        options = _filled(_ProximityOptions, max_distance=max_distance, to=to, max_depth=max_depth, work=work)
        _check(_library.nsvcd_proximities(self._checker, _address(row), byref(options), rows, len(self._pairs), byref(count)))
        return [Proximity(g.pair, _VERDICTS[g.verdict], _WHYS[g.why], Range(g.distance.low, g.distance.high), g.depth,
                          _vector(g.contact.point), _vector(g.contact.normal), np.array(g.slope[:self.joint_count]))
                for g in rows[:count.value]]

    def nearest_free(self, joints: Joints, *, clearance: float = 0, farthest: float = 0, seed: int = 0) -> Optional[Doubles]:
        """A configuration (F) near by that is proven free, or None: nsvcd_nearest_free. What lies in between need not be free.

        clearance  metres that the parts of a pair keep
        farthest   how far it may be, Euclidean, radians and metres alike; 0: 0.5
        Error: VALUE, MIMIC, CLEARANCE, FARTHEST, POSE, SCALE.
        """
        row = _doubles(self._rows(joints, "joints"), (self.joint_count,), "joints")
        out = np.empty(self.joint_count)
        is_found = c_int()
        options = _filled(_NearestFreeOptions, clearance=clearance, seed=seed)
        options.farthest = farthest
        _check(_library.nsvcd_nearest_free(self._checker, _address(row), byref(options), _address(out), byref(is_found)))
        return out if is_found.value else None

    def reach(self, start: Joints, target: ArrayLike, link: Union[int, str], tool: ArrayLike = _IDENTITY, *,
              target_link: Union[int, str] = 0,
              half: ArrayLike = (0, 0, 0), free_axis: ArrayLike = (0, 0, 0), most: int = 16, position_tolerance: float = 0,
              angle_tolerance: float = 0, apart: float = 0, starts: int = 0, seed: int = 0, clearance: float = 0,
              may_touch: bool = False, held: Optional[ArrayLike] = None) -> Reached:
        """Configurations, at most `most`, that have a tool, a pose on a link, at a target: nsvcd_reach.

        start       (F) where the search begins, and what solutions are near to
        target      a pose, (7), (3) or (4, 4), on target_link; 0: in the world
        link        its number, or the name of a part or a joint that it goes with
        tool        a pose in that link's frame
        half        (3) metres: the tool's origin may be in a box about the target's, along its axes; half of its sides
        free_axis   (3) of the tool: it may turn about this
        position_tolerance, angle_tolerance  metres, radians: how far it may be off; 0: 1e-6
        apart       solutions are at least so far apart, radians and metres alike; 0: 0.1
        starts      of the search, at most; 0: 200
        clearance   metres that the parts of a pair keep
        may_touch   solutions need not be free
        held        joints that stay where the start has them: (F) of bool, or their names
        Error: VALUE, MIMIC, LINK (or no joint moves the tool against the target), RADIUS (half), AXIS (free_axis), TOLERANCE,
        DISTANCE (apart), CLEARANCE, COUNT (most), POSE, QUATERNION, SCALE.
        """
        row = _doubles(self._rows(start, "start"), (self.joint_count,), "start")
        out = np.empty((most, self.joint_count))
        problem, answer = _ReachProblem(start=_address(row)), _ReachAnswer()
        problem.link, problem.target_link = self._link(link, "link"), self._link(target_link, "target_link")
        problem.tool, problem.target = _pose_of(tool, "tool", self._size), _pose_of(target, "target", self._size)
        problem.half[:] = _floats(half, (3,), "half").tolist()
        problem.free_axis[:] = _floats(free_axis, (3,), "free_axis").tolist()
        stays = self._held(held)
        problem.held = None if stays is None else _address(stays)
        options = _filled(_ReachOptions, starts=starts, seed=seed, clearance=clearance, may_touch=int(may_touch))
        options.position_tolerance, options.angle_tolerance, options.apart = position_tolerance, angle_tolerance, apart
        _check(_library.nsvcd_reach(self._checker, byref(problem), byref(options), _address(out), most, byref(answer)))
        touches = not answer.solutions and answer.touching > 0
        return Reached(out[:answer.solutions].copy(), answer.starts, answer.reached, answer.touching,
                       np.array(answer.best[:self.joint_count]), answer.position_error, answer.angle_error,
                       _checked(answer.check) if touches else None)

    def handed_over(self, joints: Joints, part: Union[int, str], link: Union[int, str]) -> Part:
        """A part as another link would carry it from where it is in a configuration (F), for a Robot to come: nsvcd_reparent.

        part, link  numbers, or the name of a part, and of a part or a joint that the link goes with
        Error: LINK, VALUE, MIMIC, POSE.
        """
        row = _doubles(self._rows(joints, "joints"), (self.joint_count,), "joints")
        out = _Part()
        if isinstance(part, str):
            if part not in self.part_names:
                raise ValueError(f"part: no part {part}")
            part = self.part_names.index(part)
        _check(_library.nsvcd_reparent(self._checker, _address(row), _number(c_size_t, part, "part"),
                                        self._link(link, "link"), byref(out)))
        return Part(self._bodies[part], out.link, [*out.pose.position, *out.pose.rotation], out.scale, self.part_names[part])

    def forward_kinematics(self, joints: Joints) -> Floats:
        """Where the parts are in a configuration (F): poses (B, 7)."""
        row = _doubles(self._rows(joints, "joints"), (self.joint_count,), "joints")
        poses = np.empty((self.part_count, 7), np.float32)
        _library.nsvcd_forward_kinematics(self._checker, _address(row), _address(poses))
        return poses

    def merge(self, motions: Sequence[Motion], rest: Optional[Joints] = None) -> Motion:
        """Motions of different joints, each on a clock of its own, as one of all joints: nsvcd_merge_motions.

        rest  (F) where joints are that none of them moves; None: there are none
        `check(m.points, degree=m.degree, times=m.times, to_time=0.001)` of the result m finds the first conflict.
        """
        kept: list[Any] = []
        rows = (_PartialMotion * max(len(motions), 1))()
        for row, motion in zip(rows, motions):
            joints = np.asarray(motion.joints, np.uint32).reshape(-1)
            kept.append(joints)
            row.motion = _motion_of(motion.points, len(joints), motion.degree, motion.times, kept)
            row.joints, row.joint_count = _address(joints), len(joints)
            row.delay = motion.delay
        moved = {joint for motion in motions for joint in np.asarray(motion.joints).reshape(-1).tolist()}
        if rest is None and (left := [name or str(k) for k, name in enumerate(self.joint_names) if k not in moved]):
            raise Error(Code.ARGUMENT, "rest", reason=f"nobody moves {', '.join(left)}: where it is has to be told")
        resting = None if rest is None else _doubles(self._rows(rest, "rest"), (self.joint_count,), "rest")
        size = _library.nsvcd_merge_motions_size(rows, len(motions), self.joint_count)
        memory = _memory(size)
        merged = _JointMotion()
        _check(_library.nsvcd_merge_motions(rows, len(motions), self.joint_count,
                                            None if resting is None else _address(resting), _address(memory), size,
                                            byref(merged)))
        count = merged.pieces * merged.degree + 1
        points = np.frombuffer((c_double * (count * self.joint_count)).from_address(merged.points)).copy()
        times = np.frombuffer((c_double * (merged.pieces + 1)).from_address(merged.times)).copy()
        return Motion(np.arange(self.joint_count), points.reshape(count, self.joint_count), merged.degree,
                      times if merged.pieces else None)

    def check(self, points: Joints, *, degree: int = 1, times: Optional[ArrayLike] = None, clearance: float = 0,
              finest: float = 0, work: int = 0, to_time: float = 0) -> Checked:
        """Is a motion free, as the joints make it, at all times? nsvcd_check.

        points     (F): a configuration; (pieces degree + 1, F): Bezier pieces, a polyline if the degree is 1
        times      (pieces + 1), seconds; None: each piece takes one
        clearance  metres: parts that come as near as this are a hit
        finest     metres: steps are not cut further if links deviate by less; 0: 10 um
        work       units of each proof of a pair; 0: 100000
        to_time    seconds: of what is not free, also seek until when it is, to this precision; 0: not sought
        Error: VALUE, DEGREE, TIMES, MIMIC, CLEARANCE, FINEST, TO (to_time), POSE, SCALE.
        """
        kept: list[Any] = []
        motion = _motion_of(self._rows(points, "points"), self.joint_count, degree, times, kept)
        options = _filled(_CheckOptions, clearance=clearance, finest=finest, work=work)
        options.to_time = to_time
        answer = _CheckAnswer()
        _check(_library.nsvcd_check(self._checker, byref(motion), byref(options), byref(answer)))
        return _checked(answer)

    def route(self, start: Joints, goals: Union[Joints, Sequence[Joints]], *, guess: Optional[Joints] = None, clearance: float = 0,
              seed: int = 0, nodes: int = 0, tries: int = 0, edge: float = 0, looks: int = 0, shortcuts: int = 0,
              smoothings: int = 0, stop: Optional[Callable[[], Any]] = None, held: Optional[ArrayLike] = None) -> Route:
        """A motion from the start (F) to a goal (F), or one of several (G, F), proven free: nsvcd_route.

        guess      (n, F) a way that may be free, its ends left out
        clearance  metres that the parts of a pair keep
        seed       others find other routes
        nodes      of both trees, at most; 0: 20000
        tries      motions asked about in search of a way, at most; 0: 4 times the nodes
        edge       radians or metres of an edge, at most; 0: 1
        looks      motions looked at before that, at most, if all that moves has balls; 0: 200000; LEAVE_OUT: none
        shortcuts, smoothings  tries to shorten and to smooth; 0: 20 and 200; LEAVE_OUT: none
        stop       asked before each proof and look; something true ends the search
        held       joints that stay where the start has them, as the goals do: (F) of bool, or their names
        Error: VALUE, MIMIC, HELD, CLEARANCE, ROUTE (nodes, shortcuts, edge), COUNT, POSE, SCALE. That there is no route is a
        RouteStatus.
        """
        rows = [_doubles(self._rows(start, "start"), (self.joint_count,), "start"),
                _doubles(np.atleast_2d(np.asarray(self._rows(goals, "goals"))), (None, self.joint_count), "goals")]
        problem = _RouteProblem(_address(rows[0]), _address(rows[1]), len(rows[1]))
        if guess is not None:
            rows.append(_doubles(self._rows(guess, "guess"), (None, self.joint_count), "guess"))
            problem.guess, problem.guess_count = _address(rows[2]), len(rows[2])
        stays = self._held(held)
        problem.held = None if stays is None else _address(stays)
        caught: list[BaseException] = []
        if stop:
            asked = stop
            problem.stop = _STOP(lambda _: _cancels(lambda _: asked(), caught, None, None))
        options = _filled(_RouteOptions, seed=seed, clearance=clearance, nodes=nodes, tries=tries, looks=looks, shortcuts=shortcuts,
                          smoothings=smoothings)
        options.edge = edge
        size = _library.nsvcd_route_size(self._checker, byref(problem), byref(options))
        memory = _memory(size)
        answer = _RouteAnswer()
        code = _library.nsvcd_route(self._checker, byref(problem), byref(options), _address(memory), size,
                                    byref(answer))
        if caught:
            raise caught[0]
        _check(code)
        points: Optional[Doubles] = None
        times: Optional[Doubles] = None
        status = _ROUTES[answer.status]
        is_found = status is RouteStatus.FOUND
        if is_found:
            count = answer.motion.pieces
            shape = (2 * count + 1, self.joint_count)
            numbers = (c_double * math.prod(shape)).from_address(answer.motion.points)
            points = np.frombuffer(numbers).reshape(shape).copy()
            times = np.frombuffer((c_double * (count + 1)).from_address(answer.motion.times)).copy()
        return Route(status, answer.goal if is_found else None, points, times, answer.stops,
                     answer.duration, answer.unhindered, _checked(answer.check), answer.nodes, answer.checks,
                     answer.proven, answer.looks)
