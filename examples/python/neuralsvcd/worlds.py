# SPDX-License-Identifier: MIT
"""Many bodies at their places."""
from __future__ import annotations

import contextlib
import math
import threading
from collections.abc import Iterator, Sequence
from ctypes import byref, c_float, c_size_t, c_void_p
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .words import _AskWord, Code, Method, Verdict, _VERDICTS, Why, _WHYS
from ._structs import (
    _SlideAnswer, _SlideOptions, _StepAnswer, _StepOptions, _struct, _WorldAnswer, _WorldBody, _WorldContact,
    _WorldQuestion)
from ._library import _library
from .errors import _check, _check_of, _fault_of, _Names, Error
from ._arrays import _address, _filled, Floats, _floats, _IDENTITY, _memory, _number, Pose, _pose_tuple, _vector, Vector
from .bodies import Body, _body_of, BodyLike
from .motions import _motion, _pose_of, _warn_of_rounding
from .answers import _packed, Range
from .batches import _workspace
from .sweeps import _asked
from .movers import Movers, Step, _world_contacts, WorldContact


class Resident(NamedTuple):
    """A body of a World: nsvcd_world_body."""
    body: Body
    pose: Pose
    scale: float
    pivot: Vector
    groups: int
    passes: int
    fixed: bool
    sensor: bool


class WorldAnswer(NamedTuple):
    """nsvcd_world_answer. As a condition it is answer.verdict != "free", as of Answer.

    verdict    hit: it hits some body; undecided: it hits none, and of some that is not known; free: of all
    why        ... it is not
    body       that is hit first, or else is undecided first; None: it is free
    time       free of all bodies before low, in contact with one at high
    safe_time, safe  "first": where the mover may go: this pose, and the way there, are proven to be free of all bodies
    depth, push_out  with a slop: how the mover was pushed out, of all that it touched at once
    contacts   "first": with all bodies that touch at the safe pose, one each, or with manifold=True all, up to 32
    questions  about two bodies, and
    work       units that their proofs took
    """
    verdict: Verdict
    why: Why
    body: Optional[int]
    time: Range
    safe_time: float
    safe: Pose
    depth: float
    push_out: Vector
    contacts: list[WorldContact]
    questions: int
    work: int

    def __bool__(self) -> bool:
        return self.verdict is not Verdict.FREE


class Slide(NamedTuple):
    """What became of a body in a frame: nsvcd_slide_answer.

    velocity  (6) float32, at the end: metres a second, then radians a second; the caller adds gravity to it and hands it back
    spent     of the frame, that it could make use of
    rests     it did not move at all, and its speed is 0
    ground    the body that it stands on, or None, and the ground's normal
    caught    the driven body that it could not get out of the way of, or None
    contacts  where it touches at the end, or within the margin
    """
    pose: Pose
    velocity: Floats
    spent: float
    rests: bool
    ground: Optional[int]
    ground_normal: Vector
    caught: Optional[int]
    contacts: list[WorldContact]
    questions: int
    work: int


_WORLD_FIELDS, _SLIDE_FIELDS = _packed(_WorldAnswer), _packed(_SlideAnswer)


class _Door:
    """Any number of threads ask, or one changes: the others wait."""

    def __init__(self) -> None:
        self._free = threading.Condition()
        self._asking = 0

    @contextlib.contextmanager
    def asks(self) -> Iterator[None]:
        with self._free:
            self._asking += 1
        try:
            yield
        finally:
            with self._free:
                self._asking -= 1
                self._free.notify_all()

    @contextlib.contextmanager
    def changes(self) -> Iterator[None]:
        with self._free:
            self._free.wait_for(lambda: not self._asking)
            yield


_OF_BODY: _Names = {Code.COUNT: ("most", "the world is full: World(most) has room for more"), Code.POSE: "pose", Code.QUATERNION: "pose", Code.SCALE: "scale", Code.PIVOT: "pivot",
            Code.TRIANGLES: "body"}
_OF_ID = {Code.INDEX: "id", Code.POSE: "pose", Code.QUATERNION: "pose"}
_OF_MOVER: _Names = {Code.ASK: ("ask", "of a World it is hit or first"), Code.INDEX: "mover", Code.POSES: "poses", Code.POSE: "poses", Code.QUATERNION: "poses", Code.TIMES: "times",
             Code.SCALE: "scale", Code.PIVOT: "pivot", Code.TRIANGLES: "mover"}
_OF_SLIDE: _Names = {Code.INDEX: "id", Code.SPEED: "velocity", Code.TIMES: "seconds", Code.CLEARANCE: "clearance, margin",
             Code.AXIS: "up", Code.DISTANCE: "step", Code.VALUE: "mass, inertia, friction, restitution, slope"}
_OF_STEP: _Names = {Code.INDEX: "ids", Code.TIMES: ("seconds, calm", "seconds must be above 0, calm not below"), Code.SPEED: "quiet", Code.VALUE: "gravity"}
_OF_STEPPED: _Names = {**_OF_SLIDE, Code.INDEX: ("ids", "there is no such body, or it is fixed"), Code.POSE: "movers",
               Code.VALUE: ("mass, inertia, friction, restitution, slope, push_mass, damping, spin_damping",
                            "one of these is negative, or no number")}


class World:
    """At most so many bodies at their places, and questions about one body and all that it comes near: nsvcd_world.

        world = World(100)
        floor, crate = world.add(level, fixed=True), world.add(box, [0, 0, 1, 0, 0, 0, 1])
        movers = Movers([crate], mass=1, friction=0.5)
        for frame in range(60):
            world.step(movers, 1 / 60)

    If no two bodies overlap, none do after a slide. Bodies have ids, from 1 on, and live as long as the world has them. Any
    number of threads may ask; who changes the world, by a slide or a step too, waits until they have their answers.
    """

    def __init__(self, most: int) -> None:
        size = _library.nsvcd_world_size(_number(c_size_t, most, "most"))
        if not size:
            raise Error(Code.COUNT, "most")
        self._memory = _memory(size)
        self._world = c_void_p()
        self._bodies: dict[int, Body] = {}
        self._sizes: dict[int, float] = {}
        self._slid: dict[int, Any] = {}  # what the next slide of a body takes back
        self._door = _Door()
        _check(_library.nsvcd_world_begin(_address(self._memory), size, most, byref(self._world)))

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a World cannot be copied or pickled")

    def __len__(self) -> int:
        return len(self._bodies)

    def __contains__(self, id: object) -> bool:
        return id in self._bodies

    @property
    def ids(self) -> tuple[int, ...]:
        """Of its bodies, in ascending order."""
        with self._door.asks():
            return tuple(sorted(self._bodies))

    def add(self, body: BodyLike, pose: ArrayLike = _IDENTITY, *, scale: float = 1, pivot: ArrayLike = (0, 0, 0), groups: int = 0,
            passes: int = 0, fixed: bool = False, sensor: bool = False) -> int:
        """Adds a body and returns its id; ids of removed bodies are used again. Nothing is asked: it may overlap others.

        body    a Body, or what stands for a mesh
        pose    (7) or (4, 4): where it is
        scale   about its origin
        pivot   (3) of its frame: what it turns about. Of what moves freely, the centre of mass
        groups, passes  bits: the groups that it belongs to, by default the first, and those that it passes through
        fixed   it never moves by itself, like a level: pairs of two such bodies are not listed
        sensor  it stops nothing; `list` tells what is in it
        """
        body = _body_of(body, "body")
        given = _filled(_WorldBody, groups=groups, passes=passes, fixed=bool(fixed), sensor=bool(sensor))
        given.body, given.scale = body._address, _scale_of(scale)
        given.pose = _pose_of(pose, "pose", body._size * scale)
        given.pivot[:] = _floats(pivot, (3,), "pivot").tolist()
        id = c_size_t()
        with self._door.changes():
            _check_of(_library.nsvcd_world_add(self._world, byref(given), byref(id)), _OF_BODY)
            self._bodies[id.value], self._sizes[id.value] = body, body._size * scale
        return id.value

    def move(self, id: int, pose: ArrayLike) -> None:
        """Moves a body elsewhere. Nothing is asked."""
        with self._door.changes():
            _check_of(_library.nsvcd_world_move(self._world, _id_of(id), byref(_pose_of(pose, "pose", self._sizes.get(id, math.inf)))), _OF_ID)

    def remove(self, id: int) -> None:
        """Takes a body out."""
        with self._door.changes():
            _check_of(_library.nsvcd_world_remove(self._world, _id_of(id)), _OF_ID)
            self._slid.pop(id, None)
            del self._bodies[id], self._sizes[id]

    def get(self, id: int) -> Resident:
        """What a body is, and where."""
        got = _WorldBody()
        with self._door.asks():
            _check_of(_library.nsvcd_world_get(self._world, _id_of(id), byref(got)), _OF_ID)
            body = self._bodies[id]
        return Resident(body, _pose_tuple(got.pose), got.scale, _vector(got.pivot), got.groups, got.passes,
                        bool(got.fixed), bool(got.sensor))

    def poses(self, ids: Optional[Sequence[int]] = None) -> Floats:
        """Where bodies are, by default all, in the order of their ids: (n, 7)."""
        wanted = self.ids if ids is None else [_id_of(id) for id in ids]
        rows, got = np.empty((len(wanted), 7), np.float32), _WorldBody()
        with self._door.asks():
            for row, id in zip(rows, wanted):
                _check_of(_library.nsvcd_world_get(self._world, id, byref(got)), _OF_ID)
                row[:] = np.frombuffer(got.pose, np.float32)
        return rows

    def drive(self, id: int, to: ArrayLike) -> None:
        """Drives a body in this frame to a pose, by a line and a slerp about its pivot: a lift, a door, a robot's link. It
        stops for nobody: others that slide get out of its way, or are caught."""
        with self._door.changes():
            code = _library.nsvcd_world_drive(self._world, _id_of(id), byref(_pose_of(to, "to", self._sizes.get(id, math.inf))))
            _check_of(code, {Code.INDEX: "id", Code.POSE: "to", Code.QUATERNION: "to"})

    def arrive(self) -> None:
        """Ends the frame: all driven bodies are at their ends, and rest."""
        with self._door.changes():
            _check(_library.nsvcd_world_arrive(self._world))

    def sweep(self, mover: Union[int, BodyLike], poses: Optional[ArrayLike] = None, *, times: Optional[ArrayLike] = None,
              scale: float = 1, pivot: ArrayLike = (0, 0, 0), groups: int = 0, passes: int = 0, ignore: int = 0,
              ask: _AskWord = "hit", to: float = 0, to_time: float = 0, clearance: float = 0, slop: float = 0,
              tolerance: float = 0, manifold: bool = False, surfaces: bool = False, work: int = 0,
              segments: int = 0) -> WorldAnswer:
        """Does a mover hit any body? And which first: ask="first". Driven bodies are asked about as they move.

        mover   a body of the world by its id, or any Body, which has a scale, a pivot, groups and passes, as of `add`
        poses   (k, 7), as of `sweep` of two bodies; None: where it is in the world, or at the origin
        ignore  the id that a Body stands for: it does not meet that body, whose groups count
        ask, ..., segments  as of `sweep` of two bodies; ask: hit or first
        """
        question = _world_question(self._sizes, mover, poses, times, scale, pivot, groups, passes, ignore, _asked(
            ask, to, to_time, clearance, slop, tolerance, manifold, surfaces, Method.DEFAULT, work, segments))
        answer = _WorldAnswer()
        with self._door.asks():
            _check_of(_library.nsvcd_world_sweep(self._world, byref(question), _workspace.address, _workspace.size,
                                                 byref(answer)), _OF_MOVER)
        v: Any = _WORLD_FIELDS.unpack(answer)
        return WorldAnswer(_VERDICTS[v[0]], _WHYS[v[1]], v[2] or None, Range(v[3], v[4]), v[5], v[6:13], v[13], v[14:17],
                           _world_contacts(answer, v[17]), v[18], v[19])

    def list(self, mover: Union[int, BodyLike], poses: Optional[ArrayLike] = None, *, times: Optional[ArrayLike] = None,
             scale: float = 1, pivot: ArrayLike = (0, 0, 0), groups: int = 0, passes: int = 0, ignore: int = 0,
             clearance: float = 0, slop: float = 0, tolerance: float = 0, surfaces: bool = False, work: int = 0,
             segments: int = 0) -> tuple[int, ...]:
        """The ids of all bodies that a mover meets on its way, sensors too; what is undecided counts. Arguments are those of
        `sweep`."""
        question = _world_question(self._sizes, mover, poses, times, scale, pivot, groups, passes, ignore, _asked(
            "hit", 0, 0, clearance, slop, tolerance, False, surfaces, Method.DEFAULT, work, segments))
        count = c_size_t()
        with self._door.asks():
            ids = (c_size_t * len(self._bodies))()
            _check_of(_library.nsvcd_world_list(self._world, byref(question), _workspace.address, _workspace.size, ids, len(ids),
                                                byref(count)), _OF_MOVER)
        return tuple(ids[:count.value])

    def pairs(self, distance: float = 0) -> NDArray[np.uint32]:
        """Pairs of ids (n, 2) whose boxes, over this frame, come within a distance, metres: who may meet whom."""
        reach, count = _number(c_float, distance, "distance"), c_size_t()
        with self._door.asks():
            rows = np.empty((4 * len(self._bodies), 2), np.uint32)
            while True:
                _check_of(_library.nsvcd_world_pairs(self._world, reach, _address(rows), len(rows), byref(count)),
                          {Code.DISTANCE: "distance"})
                if count.value <= len(rows):
                    return rows[:count.value].copy()
                rows = np.empty((count.value, 2), np.uint32)

    def slide(self, id: int, velocity: ArrayLike, seconds: float, *, clearance: float = 0, margin: float = 0,
              mass: float = 0, inertia: ArrayLike = (0, 0, 0), friction: float = 0, restitution: float = 0,
              up: ArrayLike = (0, 0, 0), step: float = 0, slope: float = 0, rounds: int = 0, work: int = 0) -> Slide:
        """Moves a body for a frame at its speed: as far as is proven free, then on without the speed that points into what it met.
        At the end, and on its way there, it is farther than the clearance from every other body.

        velocity  (6) metres a second of its pivot, then radians a second, in the world; or (3), and it does not turn. Gravity and
                  other forces are the caller's to add before
        seconds   of the frame

        How it slides; of what is 0 the default is behind the semicolon:
        clearance  metres: what it never comes nearer to anything than; a two-hundredth of its radius
        margin     metres: how much farther than that it comes to rest, or a part of that; the same
        mass, inertia  kilograms, and (3) kg m^2 about its axes through its pivot. Without an inertia it does not turn by
                   what it meets; without a mass it is a character, whose impulses are speeds
        friction   of what it rubs against
        restitution  of what it hits faster than half a metre a second, up to 1
        up         (3) a character: the direction up, unit. It rides on what it stands on
        step       metres: as high a step it climbs
        slope      the least cosine between up and the normal of a ground that it stands on; 0.7
        rounds     how often in a frame it goes on after a contact; 4
        work       units of each question; 10000
        """
        options = _filled(_SlideOptions, clearance=clearance, margin=margin, mass=mass, friction=friction,
                          restitution=restitution, step=step, slope=slope, rounds=rounds, work=work)
        options.inertia[:] = _floats(inertia, (3,), "inertia").tolist()
        options.up[:] = _floats(up, (3,), "up").tolist()
        given = _floats(velocity, (3,) if np.shape(velocity) == (3,) else (6,), "velocity")
        speed = np.zeros(6, np.float32)
        speed[:len(given)] = given
        with self._door.changes():
            answer = self._slid.get(id) or _SlideAnswer()
            code = _library.nsvcd_world_slide(self._world, _id_of(id), byref(options), _number(c_float, seconds, "seconds"),
                                              _workspace.address, _workspace.size, _address(speed), byref(answer))
            _check_of(code, _OF_SLIDE)
            self._slid[id] = answer
            v: Any = _SLIDE_FIELDS.unpack(answer)
            contacts = _world_contacts(answer, v[14])
        return Slide(v[0:7], speed, v[7], bool(v[8]), v[9] or None, v[10:13], v[13] or None, contacts, v[15], v[16])

    def step(self, movers: Movers, seconds: float, *, gravity: ArrayLike = (0, 0, -9.81), quiet: float = 0,
             calm: float = 0) -> Step:
        """Moves bodies for a frame, and ends it: each is given gravity and slides, what it hits gets its part of the momentum, who is
        quiet for long enough falls asleep, and what is driven arrives: nsvcd_world_step. No two bodies overlap, if none did.

        movers   their arrays are as they are at the end. The library writes them meanwhile: other threads keep off
        seconds  of the frame
        gravity  (3) metres a second squared
        quiet    metres a second: what touches something, and of which no point is faster, falls asleep after
        calm     so many seconds; 0.15 and 0.1

        Error: its index is that of the mover at fault, if one is. INDEX (an id is no body's, a fixed body's, or there twice), VALUE,
        SPEED, TIMES, CLEARANCE, AXIS, DISTANCE: nothing has moved. POSE: that body, about to leave the coordinates, stays where it
        is, and all others have moved.
        """
        if not isinstance(movers, Movers):
            raise TypeError(f"movers: Movers are needed, not {type(movers).__name__}")
        options, answer = _filled(_StepOptions, quiet=quiet, calm=calm), _StepAnswer()
        options.gravity[:] = _floats(gravity, (3,), "gravity").tolist()
        time = _number(c_float, seconds, "seconds")
        with self._door.changes():
            if movers._world not in (None, self):
                raise ValueError("movers: of another World")
            code = _library.nsvcd_world_step(self._world, _address(movers._memory), len(movers), byref(options), time,
                                             _workspace.address, _workspace.size, byref(answer))
            if code in (0, Code.POSE):
                movers.__dict__["_world"] = self
        if code and answer.refused:
            raise _fault_of(code, _OF_STEPPED, int(np.argmax(movers.ids == answer.refused)))
        _check_of(code, _OF_STEP)
        return Step(answer.awake, answer.asleep, answer.caught, answer.contacts, answer.questions, answer.work)


def _scale_of(scale: float) -> Any:
    factor = _number(c_float, scale, "scale")
    if not factor.value:
        raise ValueError(f"scale: {scale}")  # in C that is 1
    return factor


def _id_of(id: Any) -> Any:
    return _number(c_size_t, id, "id")


def _world_question(sizes: dict[int, float], mover: Union[int, BodyLike], poses: Optional[ArrayLike], times: Optional[ArrayLike],
                    scale: float, pivot: ArrayLike, groups: int, passes: int, ignore: int, asked_of_it: Any) -> Any:
    asked = _filled(_WorldQuestion, groups=groups, passes=passes, self=ignore)
    motion = _motion(poses, times, one=True)
    asked.question = asked_of_it
    a = asked.question.a
    body: Optional[Body] = None
    if isinstance(mover, (int, np.integer)) and not isinstance(mover, bool):
        if scale != 1 or np.any(pivot) or groups or passes or ignore:
            raise TypeError("scale, pivot, groups, passes, ignore: only of a Body; that of an id has its own")
        if not mover:
            raise Error(Code.INDEX, "mover")  # 0 is nobody
        asked.self = _id_of(mover)
    else:
        body = _body_of(mover, "mover: an id")
        a.body, a.scale = body._address, _scale_of(scale)
        a.pivot[:] = _floats(pivot, (3,), "pivot").tolist()
    size = sizes.get(asked.self, math.inf) if body is None else body._size * scale
    _warn_of_rounding(motion.given, motion.poses, size, "poses")
    if motion.poses is not None:
        a.poses, a.count = _address(motion.poses), len(motion.poses)
        a.times = None if motion.times is None else _address(motion.times)
    asked.kept = motion, body
    return asked
