# SPDX-License-Identifier: MIT
"""Smooth trajectories by optimization: neuralsvcd.h's planner."""
from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Mapping, Sequence
from ctypes import byref, c_float, c_void_p
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike

from .words import LEAVE_OUT, _PLANS, PlanStatus
from ._structs import (
    _MAX_VIA_POINTS, _PLACE, _PLAN_PROGRESS, _PlanAnswer, _PlanOptions, _PlanProblem, _PlanProgress, _PlanStage,
    _struct)
from ._library import _library
from .errors import _check
from ._arrays import _address, _cancels, Floats, _floats, _indices, _memory, _filled, _numeric
from .bodies import _body_of, BodyLike
from .motions import _rows, _warn_of_rounding
from .sweeps import _question_of


def spline(control: ArrayLike, t: ArrayLike, derivative: int = 0) -> Floats:
    """The joints at times t, or their derivatives by t, of a trajectory through control points.

    control     (M + 2, F) start, M via points, goal; M up to 32
    t           of any shape; taken into [0, 1]
    derivative  0: the joints; 1, 2, 3: velocity, acceleration, jerk
    Returns t's shape, and (F).
    """
    points = _floats(control, (None, None), "control")
    if not 2 <= len(points) <= _MAX_VIA_POINTS + 2:
        raise ValueError(f"control: 2 to {_MAX_VIA_POINTS + 2} points, not {len(points)}")
    if derivative not in range(4):
        raise ValueError(f"derivative: {derivative} is not in 0..3")
    times = np.asarray(t, np.float32)
    out = np.empty((times.size, points.shape[1]), np.float32)
    for time, row in zip(times.ravel().tolist(), out):
        _library.nsvcd_spline(_address(points), len(points) - 2, len(row), time, derivative, _address(row))
    return out.reshape(*times.shape, points.shape[1])


class Stage(NamedTuple):
    """A stage of the planner: nsvcd_plan_stage. What is 0 is the default.

    via_points  of the trajectory
    segments    of the trajectory, each swept as one motion
    iterations  at most; LEAVE_OUT: leave the stage out
    draws       random trajectories in an iteration of MPPI, or gradients in a bundle of L-BFGS
    noise       their standard deviation, radians or metres
    """
    via_points: int = 0
    segments: int = 0
    iterations: int = 0
    draws: int = 0
    noise: float = 0


class Progress(NamedTuple):
    """nsvcd_plan_progress; control is (M + 2, F)."""
    seed: int
    iteration: int
    iterations: int
    refining: bool
    cost: float
    collision: float
    control: Floats


class Plan(NamedTuple):
    """nsvcd_plan_answer, and the trajectory.

    control       (M + 2, F) start, via points, goal: see spline
    status        converged: within the limits, and proven free where bodies have triangles, but for `deviation`
    collides      by the last check, or of the start or the goal where the status says so
    joint, pair   that leaves its limits; of the greatest logit; or None
    logit, time   the greatest of the last check, and when
    deviation         metres that the spline deviates by from what the last check is about, the motion that is straight and
                  slerped between its poses; measured, not proven. To have the spline clear too, ask for more clearance
    cost, smoothness  of the trajectory; the latter without collision and limits
    seeds, iterations, trajectories, sweeps  how many it took
    """
    control: Floats
    status: PlanStatus
    collides: bool
    joint: Optional[int]
    pair: Optional[int]
    logit: float
    time: float
    deviation: float
    cost: float
    smoothness: float
    seeds: int
    iterations: int
    trajectories: int
    sweeps: int


def _view(address: int, *shape: int) -> Floats:
    floats: Any = (c_float * math.prod(shape)).from_address(address)
    return np.frombuffer(floats, np.float32).reshape(shape)


def plan(bodies: Sequence[Optional[BodyLike]], pairs: ArrayLike, kinematics: Callable[[Floats], ArrayLike], start: ArrayLike,
         goal: ArrayLike, low: ArrayLike, high: ArrayLike, *,
         jacobian: Optional[Callable[[Floats], ArrayLike]] = None,
         progress: Optional[Callable[[Progress], Any]] = None, seed: int = 0, seeds: int = 0, explore: Stage = Stage(),
         refine: Stage = Stage(), velocity: float = 0, acceleration: float = 0, jerk: float = 0, collision: float = 0,
         duration: float = 0, margin: float = 0, discrete: bool = False, check: int = 0,
         sweep: Optional[Mapping[str, Any]] = None) -> Plan:
    """Finds a smooth trajectory of F joints on which no pair of bodies meets.

    bodies       B; one in no pair may be None
    pairs        (P, 2) bodies that can meet, by their indices; the one that rests, or the larger one, second
    kinematics        joints (F) -> poses (B, 7), world: forward kinematics, which must depend on nothing else. It is called
                 some ten thousand times
    start, goal  (F)
    low, high    (F) limits
    jacobian     joints (F) -> (B, 6, F): of each body by a joint, displacement of the origin and rotation vector, world
                 axes; None: by differences of kinematics
    progress     called once in an iteration; if it returns something true, the plan is CANCELLED
    seed, seeds  of all random numbers; starts, tried until one ends free: 6
    explore, refine  the stages, MPPI and L-BFGS
    velocity, acceleration, jerk  weights of the means of squares over the motion: 10, 2, 10
    collision    weight of the logits' sum: 20
    duration     seconds, which only weights the terms above: 20
    margin       logits above minus this cost: 2
    discrete     poses instead of sweeps
    check        segments of the last check: 16 times the finest stage's
    sweep        of all queries, keywords of `sweep`: {"clearance": 0.01}; ask, to and to_time are not among them

    What a callback raises ends the planning, and is raised here. A cost of collision of one's own is not bound.
    """
    first = _floats(start, (None,), "start")
    joints = len(first)
    rows = [first, *(_floats(row, (joints,), name) for row, name in ((goal, "goal"), (low, "low"), (high, "high")))]
    kept = [None if body is None else _body_of(body, "bodies") for body in bodies]
    addresses = (c_void_p * len(kept))(*(c_void_p(body._address if body else None) for body in kept))
    met = _indices(pairs, 2, "pairs")
    caught: list[BaseException] = []
    looked_at: list[str] = []
    smallest = min((body._size for body in kept if body), default=math.inf)

    def call(function: Callable[[Floats], ArrayLike], name: str, posed: Any, given: int, out: int, *shape: int) -> None:
        target = _view(out, *shape)
        try:
            told = None if caught else _numeric(posed(function(_view(given, joints).copy()), name), shape, name)
            target[:] = np.nan if told is None else told
            if told is not None and posed is _rows and not looked_at:  # the first poses, for all
                looked_at.append(name)
                _warn_of_rounding(told, target, smallest, name)
        except BaseException as error:  # ctypes would swallow it
            caught.append(error)
            target[:] = np.nan

    def tell(address: int) -> Any:
        if not progress:
            return None
        c = _PlanProgress.from_address(address)
        control = _view(c.control, c.via_points + 2, joints).copy()
        return progress(Progress(c.seed, c.iteration, c.iterations, bool(c.refining), c.cost, c.collision, control))

    problem = _PlanProblem(
        joints=joints, start=_address(rows[0]), goal=_address(rows[1]), low=_address(rows[2]), high=_address(rows[3]),
        bodies=ctypes.addressof(addresses), body_count=len(kept), pairs=_address(met), pair_count=len(met),
        kinematics=_PLACE(lambda _, given, out: call(kinematics, "kinematics", _rows, given, out, len(kept), 7)),
        progress=_PLAN_PROGRESS(lambda user, address: _cancels(tell, caught, address, user)))
    if jacobian:
        derive = jacobian
        problem.jacobian = _PLACE(lambda _, given, out: call(
            derive, "jacobian", lambda rows, _: rows, given, out, len(kept), 6, joints))
    options = _filled(_PlanOptions, seed=seed, seeds=seeds, velocity=velocity, acceleration=acceleration, jerk=jerk,
                      collision=collision, duration=duration, margin=margin, discrete=bool(discrete), check=check)
    options.explore, options.refine = (_filled(_PlanStage, **stage._asdict()) for stage in (explore, refine))
    options.sweep = _question_of(**(sweep or {}))
    size = _library.nsvcd_plan_workspace_size(byref(problem), byref(options))
    workspace = _memory(size)
    control = np.empty((_MAX_VIA_POINTS + 2, joints), np.float32)
    answer = _PlanAnswer()
    code = _library.nsvcd_plan(byref(problem), byref(options), _address(workspace), size, _address(control),
                               byref(answer))
    if caught:
        raise caught[0]
    _check(code)
    joint, pair = (None if index == LEAVE_OUT else index for index in (answer.joint, answer.pair))
    return Plan(control[:answer.via_points + 2].copy(), _PLANS[answer.status], bool(answer.collides), joint, pair,
                answer.logit, answer.time, answer.deviation, answer.cost, answer.smoothness, answer.seeds, answer.iterations,
                answer.trajectories, answer.sweeps)
