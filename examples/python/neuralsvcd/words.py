# SPDX-License-Identifier: MIT
"""Words and numbers that stand for those of neuralsvcd.h: verdicts, what is asked, why something is refused."""
from __future__ import annotations

import enum
from ctypes import c_size_t
from typing import Any, Literal, Union


class Code(enum.IntEnum):
    """Why something was refused: nsvcd_result."""
    ARGUMENT = 1
    IO = 2
    MEMORY = 3
    WORKSPACE = 4
    CANCELLED = 5
    COUNT = 6
    FORMAT = 7
    SYNTAX = 8
    INDEX = 9
    NUMBER = 10
    EMPTY = 11
    TOO_LARGE = 12
    SIZES = 13
    BOX = 14
    PATCHES = 15
    RADIUS = 16
    BODY = 17
    VERSION = 18
    TRIANGLES = 19
    LATENTS = 20
    POSES = 21
    TIMES = 22
    POSE = 23
    QUATERNION = 24
    SCALE = 25
    PIVOT = 26
    SAME = 27
    ASK = 28
    METHOD = 29
    TO = 30
    TO_TIME = 31
    CLEARANCE = 32
    SLOP = 33
    TOLERANCE = 34
    MANIFOLD = 35
    SEGMENTS = 36
    PAIRS = 37
    MODEL = 38
    PRECISION = 39
    RECALL = 40
    INFLATE = 41
    JOINT = 42
    AXIS = 43
    LIMITS = 44
    SPEED = 45
    LINK = 46
    PAIR = 47
    CONE = 48
    VALUE = 49
    DEGREE = 50
    TURN = 51
    FINEST = 52
    DISTANCE = 53
    FARTHEST = 54
    ROUTE = 55
    HELD = 56
    MIMIC = 57
    STAGE = 58
    PLAN = 59
    WORLD = 60
    BUILD = 61


class _Word(str, enum.Enum):
    """A word for each number of C's, from 0: Verdict.FREE == "free"."""

    def __str__(self) -> str:
        return str.__str__(self)

    def __format__(self, form: str) -> str:
        return str.__format__(self, form)


class Ask(_Word):
    """What is asked: nsvcd_ask. HIT, the default, tells the time of a contact, as a rule not of the first."""
    HIT = "hit"
    FIRST = "first"
    DISTANCE = "distance"


class Verdict(_Word):
    """nsvcd_verdict."""
    UNDECIDED = "undecided"
    FREE = "free"
    HIT = "hit"


class By(_Word):
    """Who says so: nsvcd_by."""
    PROOF = "proof"
    NETWORK = "network"


class Why(_Word):
    """Why not all that was asked is answered: nsvcd_why."""
    NOTHING = "nothing"
    TOO_NEAR = "too near"
    WORK = "work"
    OPEN = "open"


class Model(_Word):
    """The network's decoders: nsvcd_model."""
    DEFAULT = "default"
    TINY = "tiny"
    SMALL = "small"
    BASE = "base"


class Precision(_Word):
    """The decoder's arithmetic: nsvcd_precision."""
    FLOAT = "float"
    INT8 = "int8"


class Method(_Word):
    """How a question is answered: nsvcd_method."""
    DEFAULT = "default"
    PROOF = "proof"
    NETWORK = "network"


class PlanStatus(_Word):
    """What a plan is: nsvcd_plan_status."""
    CONVERGED = "converged"
    LIMIT = "limit"
    CANCELLED = "cancelled"
    START = "start"
    GOAL = "goal"


class JointKind(_Word):
    """nsvcd_joint_kind."""
    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"


class RouteStatus(_Word):
    """What a route is: nsvcd_route_status."""
    FOUND = "found"
    LIMIT = "limit"
    STOPPED = "stopped"
    START = "start"
    GOAL = "goal"


# What may be said of these, for type checkers.
_AskWord = Union[Ask, Literal["hit", "first", "distance"]]
_MethodWord = Union[Method, Literal["default", "proof", "network"]]
_ModelWord = Union[Model, Literal["default", "tiny", "small", "base"]]
_PrecisionWord = Union[Precision, Literal["float", "int8"]]
_KindWord = Union[JointKind, Literal["revolute", "continuous", "prismatic"]]

NO_TRIANGLE = 0xffffffff  # in the arrays of sweep
LEAVE_OUT = c_size_t(-1).value  # Stage.iterations
_PREFIXES: dict[Any, str] = {
    Code: "ERROR_", Ask: "ASK_", Verdict: "", By: "BY_", Why: "WHY_", Model: "MODEL_", Precision: "PRECISION_",
    Method: "METHOD_", PlanStatus: "PLAN_", JointKind: "JOINT_", RouteStatus: "ROUTE_"}
_VERDICTS, _BYS, _WHYS = tuple(Verdict), tuple(By), tuple(Why)
_ROUTES, _PLANS = tuple(RouteStatus), tuple(PlanStatus)


def _number_of(value: enum.Enum) -> int:
    """In C."""
    return list(type(value)).index(value) if isinstance(value, _Word) else int(value.value)
