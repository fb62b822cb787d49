# SPDX-License-Identifier: MIT
"""Does this body, moving along this trajectory, hit that body? neuralsvcd.h for Python, by ctypes.

    rack = Body("dish_rack.obj")             # or STL, PLY, GLB; scale=0.001: of millimetres
    answer = sweep(mug, rack, path, options=Options(ask="first"))  # path: (k, 7), or matrices (k, 4, 4)
    if answer.verdict == "hit": print(answer.time.high)  # when first; without options: when there is a contact

Units are metres and radians, time is in [0, 1]. A pose is x y z and a unit quaternion x y z w; a
motion is an array (k, 7) of poses, uniform in time, position linear and rotation slerp in between.
Wherever there are poses, rigid 4x4 matrices may be instead: poses_from_matrices.
Arrays may be of any numeric type and stride: they are copied, as float32. What an answer is worth,
and what each option and field means in full, is said in neuralsvcd.h under the same names.

Threads may share everything here but Movers. The library has its memory for each thread, and while it
works, other Python threads run. What it refuses is raised as Error; arrays of the wrong shape or type are
ValueError and TypeError.
"""
from __future__ import annotations

import contextlib
import ctypes
import dataclasses
import enum
import functools
import math
import operator
import os
import struct
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from ctypes import byref, c_char, c_char_p, c_double, c_float, c_int, c_size_t, c_uint32, c_uint64, c_void_p
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Answer", "Ask", "Body", "By", "Certificate", "Checked", "Code", "Contact", "Error", "Facts", "Gradient", "Joint",
    "JointKind", "LEAVE_OUT", "Mass", "Mesh", "Method", "Model", "Motion", "Movers", "NO_TRIANGLE", "Opinion", "Options", "Part", "Plan",
    "PlanOptions", "PlanStatus", "Precision", "Progress", "Range", "Reached", "Resident", "Robot", "Route", "RouteStatus",
    "SafePlace", "Slide", "SlideOptions", "Stage", "Step", "Tree", "Verdict", "Why", "World", "WorldAnswer", "WorldContact", "certify", "contacts", "cut_mesh", "load_mesh", "load_obj", "load_stl",
    "parse_mesh", "parse_obj", "parse_stl", "plan", "poses_from_matrices", "spline", "sweep", "sweep_batch", "sweep_gradient",
]

Floats = NDArray[np.float32]
FilePath = Union[str, os.PathLike[str]]
Doubles = NDArray[np.float64]
Vector = tuple[float, float, float]

# ---------------------------------------------------------------------------------- enumerations, as in neuralsvcd.h


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
    __str__ = str.__str__
    __format__ = str.__format__


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


class PlanStatus(enum.IntEnum):
    """What a plan is: nsvcd_plan_status."""
    CONVERGED = 0
    LIMIT = 1
    CANCELLED = 2
    START = 3
    GOAL = 4


class JointKind(_Word):
    """nsvcd_joint_kind."""
    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"


class RouteStatus(enum.IntEnum):
    """What a route is: nsvcd_route_status."""
    FOUND = 0
    LIMIT = 1
    STOPPED = 2
    START = 3
    GOAL = 4


NO_TRIANGLE = 0xffffffff  # in the arrays of sweep_batch
_MAX_CONTACTS = 4
_WORLD_CONTACTS = 32
_MAX_JOINTS = 128
_MAX_VIA_POINTS = 32
LEAVE_OUT = c_size_t(-1).value  # Stage.iterations

_PREFIXES: dict[Any, str] = {
    Code: "ERROR_", Ask: "ASK_", Verdict: "", By: "BY_", Why: "WHY_", Model: "MODEL_", Precision: "PRECISION_",
    Method: "METHOD_", PlanStatus: "PLAN_", JointKind: "JOINT_", RouteStatus: "ROUTE_"}
_VERDICTS, _BYS, _WHYS = tuple(Verdict), tuple(By), tuple(Why)


def _number_of(value: enum.Enum) -> int:
    """In C."""
    return list(type(value)).index(value) if isinstance(value, _Word) else int(value.value)


# ------------------------------------------------------------------------------------------- structs of neuralsvcd.h

_PROGRESS = ctypes.CFUNCTYPE(c_int, c_float, c_void_p)
_PLACE = ctypes.CFUNCTYPE(None, c_void_p, c_void_p, c_void_p)
_PLAN_PROGRESS = ctypes.CFUNCTYPE(c_int, c_void_p, c_void_p)


def _struct(name: str, /, **kinds: Any) -> Any:
    return type(name, (ctypes.Structure,), {"_fields_": list(kinds.items())})


_Mesh = _struct("nsvcd_mesh", positions=c_void_p, indices=c_void_p, vertex_count=c_size_t, triangle_count=c_size_t)
_EncodeOptions = _struct(
    "nsvcd_encode_options", patches=c_size_t, patch_radius=c_float, convex_radius=c_float, open=c_int, latents=c_int,
    no_triangles=c_int, coarse=c_int, balls=c_size_t, progress=_PROGRESS, user=c_void_p)
_BodyFacts = _struct(
    "nsvcd_body_facts", size=c_size_t, patches=c_size_t, centre=c_float * 3, radius=c_float, extent=c_float,
    low=c_float * 3, high=c_float * 3, mean_patch_radius=c_float,
    triangles=c_size_t, stored_triangles=c_size_t, quantization_error=c_float, convex_radius=c_float, balls=c_size_t,
    ball_error=c_float, latents=c_int, components=c_size_t, open_components=c_size_t, open_edges=c_size_t, open=c_int)
_Pose = _struct("nsvcd_pose", position=c_float * 3, rotation=c_float * 4)
_NetworkOptions = _struct("nsvcd_network_options", pairs=c_size_t, model=c_int, precision=c_int, recall=c_float,
                          inflate=c_float)
_Mover = _struct("nsvcd_mover", body=c_void_p, poses=c_void_p, count=c_size_t, times=c_void_p, scale=c_float,
                 pivot=c_float * 3)
_Question = _struct(
    "nsvcd_question", a=_Mover, b=_Mover, ask=c_int, to=c_float, to_time=c_float, clearance=c_float, slop=c_float,
    tolerance=c_float, manifold=c_int, method=c_int, work=c_size_t, segments=c_size_t, network=_NetworkOptions,
    surfaces=c_int, stop=c_void_p, user=c_void_p)
_Range = _struct("nsvcd_range", low=c_float, high=c_float)
_Contact = _struct(
    "nsvcd_contact", point=c_float * 3, normal=c_float * 3, gap=c_float, time=c_float, triangle_a=c_uint32,
    triangle_b=c_uint32, patch_a=c_uint32, patch_b=c_uint32, id=c_uint32)
_SafePlace = _struct("nsvcd_safe_pose", time=c_float, a=_Pose, b=_Pose)
_Opinion = _struct(
    "nsvcd_opinion", asked=c_int, logit=c_float, distance=c_float, time=c_float, patch_a=c_uint32, patch_b=c_uint32,
    candidates=c_size_t, limited=c_int)
_Answer = _struct(
    "nsvcd_answer", verdict=c_int, by=c_int, why=c_int, inside=c_int, time=_Range, distance=_Range, safe=_SafePlace,
    depth=c_float, push_out=c_float * 3, contact_count=c_size_t, contacts=_Contact * _MAX_CONTACTS, nearest=_Contact,
    opinion=_Opinion, work=c_size_t)
_BodyPair = _struct("nsvcd_body_pair", a=c_uint32, b=c_uint32)
_PlanProgress = _struct(
    "nsvcd_plan_progress", seed=c_size_t, iteration=c_size_t, iterations=c_size_t, refining=c_int, cost=c_float,
    collision=c_float, control=c_void_p, via_points=c_size_t)
_PlanProblem = _struct(
    "nsvcd_plan_problem", joints=c_size_t, low=c_void_p, high=c_void_p, start=c_void_p, goal=c_void_p, bodies=c_void_p,
    body_count=c_size_t, pairs=c_void_p, pair_count=c_size_t, kinematics=_PLACE, jacobian=_PLACE, collision=c_void_p,
    progress=_PLAN_PROGRESS, user=c_void_p)
_PlanStage = _struct("nsvcd_plan_stage", via_points=c_size_t, segments=c_size_t, iterations=c_size_t, draws=c_size_t,
                     noise=c_float)
_PlanOptions = _struct(
    "nsvcd_plan_options", seed=c_uint64, seeds=c_size_t, explore=_PlanStage, refine=_PlanStage, velocity=c_float,
    acceleration=c_float, jerk=c_float, collision=c_float, duration=c_float, margin=c_float,
    discrete=c_int, check=c_size_t, sweep=_Question)
_PlanAnswer = _struct(
    "nsvcd_plan_answer", status=c_int, collides=c_int, joint=c_size_t, pair=c_size_t, logit=c_float, time=c_float,
    deviation=c_float, cost=c_float, smoothness=c_float, via_points=c_size_t, seeds=c_size_t, iterations=c_size_t, trajectories=c_size_t,
    sweeps=c_size_t)
_STOP = ctypes.CFUNCTYPE(c_int, c_void_p)
_Joint = _struct("nsvcd_joint", kind=c_int, parent=c_uint32, origin=_Pose, axis=c_float * 3, low=c_double,
                 high=c_double, speed=c_double, acceleration=c_double, mimic=c_uint32, multiplier=c_double, offset=c_double)
_Part = _struct("nsvcd_part", body=c_void_p, link=c_uint32, pose=_Pose, scale=c_float)
_Scene = _struct("nsvcd_scene", joints=c_void_p, joint_count=c_size_t, parts=c_void_p, part_count=c_size_t,
                 pairs=c_void_p, pair_count=c_size_t, clearances=c_void_p, allowances=c_void_p, allowance_count=c_size_t,
                 cones=c_void_p, cone_count=c_size_t)
_Allowance = _struct("nsvcd_allowance", pair=c_size_t, joints=c_void_p, distance=c_double)
_Cone = _struct("nsvcd_cone", part=c_uint32, axis=c_float * 3, direction=c_float * 3, angle=c_double)
_JointMotion = _struct("nsvcd_joint_motion", pieces=c_size_t, degree=c_size_t, points=c_void_p, times=c_void_p)
_PartialMotion = _struct("nsvcd_partial_motion", motion=_JointMotion, joints=c_void_p, joint_count=c_size_t, delay=c_double)
_CheckOptions = _struct("nsvcd_check_options", clearance=c_float, finest=c_float, work=c_size_t, stop=_STOP,
                        user=c_void_p, to_time=c_double)
_CheckAnswer = _struct(
    "nsvcd_check_answer", verdict=c_int, why=c_int, pair=c_size_t, piece=c_size_t, fraction=c_double, contact=_Contact,
    joint=c_size_t, placed=c_size_t, sweeps=c_size_t, free_until=c_double, cone=c_size_t)
_Proximity = _struct("nsvcd_proximity", pair=c_size_t, verdict=c_int, why=c_int, distance=_Range, depth=c_float, contact=_Contact,
               slope=c_double * _MAX_JOINTS)
_ProximityOptions = _struct("nsvcd_proximity_options", max_distance=c_float, to=c_float, max_depth=c_float, work=c_size_t)
_NearestFreeOptions = _struct("nsvcd_nearest_free_options", clearance=c_float, farthest=c_double, seed=c_uint64, stop=_STOP,
                         user=c_void_p)
_PairCounts = _struct("nsvcd_pair_counts", asked=c_size_t, adjacent=c_size_t, touching=c_size_t)
_ReachProblem = _struct(
    "nsvcd_reach_problem", start=c_void_p, link=c_uint32, tool=_Pose, target_link=c_uint32, target=_Pose, half=c_float * 3,
    free_axis=c_float * 3, stop=_STOP, user=c_void_p, held=c_void_p)
_ReachOptions = _struct("nsvcd_reach_options", position_tolerance=c_double, angle_tolerance=c_double, apart=c_double, starts=c_size_t,
                        seed=c_uint64, clearance=c_float, may_touch=c_int)
_ReachAnswer = _struct(
    "nsvcd_reach_answer", solutions=c_size_t, starts=c_size_t, reached=c_size_t, touching=c_size_t, best=c_double * _MAX_JOINTS,
    position_error=c_double, angle_error=c_double, check=_CheckAnswer)
_RouteProblem = _struct("nsvcd_route_problem", start=c_void_p, goals=c_void_p, goal_count=c_size_t, guess=c_void_p,
                        guess_count=c_size_t, stop=_STOP, abandon=_STOP, user=c_void_p, held=c_void_p)
_RouteOptions = _struct("nsvcd_route_options", seed=c_uint64, clearance=c_float, nodes=c_size_t, tries=c_size_t,
                        edge=c_double, looks=c_size_t, shortcuts=c_size_t, smoothings=c_size_t)
_RouteAnswer = _struct(
    "nsvcd_route_answer", status=c_int, goal=c_size_t, motion=_JointMotion, stops=c_size_t, duration=c_double,
    unhindered=c_double, check=_CheckAnswer, nodes=c_size_t, checks=c_size_t, proven=c_size_t,
    looks=c_size_t)
_CertifyOptions = _struct("nsvcd_certify_options", answer=c_void_p, visits=c_size_t)
_Certificate = _struct(
    "nsvcd_certificate", verdict=c_int, why=c_int, inside=c_int, time=c_double, size=c_size_t, visits=c_size_t)
_WorldBody = _struct("nsvcd_world_body", body=c_void_p, pose=_Pose, scale=c_float, pivot=c_float * 3, groups=c_uint32,
                     passes=c_uint32, fixed=c_int, sensor=c_int)
_WorldContact = _struct("nsvcd_world_contact", body=c_size_t, contact=_Contact, impulse=c_float)
_WorldQuestion = _struct("nsvcd_world_question", question=_Question, self=c_size_t, groups=c_uint32, passes=c_uint32)
_WorldAnswer = _struct(
    "nsvcd_world_answer", verdict=c_int, why=c_int, body=c_size_t, time=_Range, safe_time=c_float, safe=_Pose, depth=c_float,
    push_out=c_float * 3, contact_count=c_size_t, contacts=_WorldContact * _WORLD_CONTACTS, questions=c_size_t, work=c_size_t)
_SlideOptions = _struct(
    "nsvcd_slide_options", clearance=c_float, margin=c_float, mass=c_float, inertia=c_float * 3, friction=c_float,
    restitution=c_float, up=c_float * 3, step=c_float, slope=c_float, rounds=c_size_t, work=c_size_t)
_Velocity = _struct("nsvcd_velocity", linear=c_float * 3, angular=c_float * 3)
_SlideAnswer = _struct(
    "nsvcd_slide_answer", pose=_Pose, spent=c_float, rests=c_int, ground=c_size_t, ground_normal=c_float * 3, caught=c_size_t,
    contact_count=c_size_t, contacts=_WorldContact * _WORLD_CONTACTS, questions=c_size_t, work=c_size_t, told=_SlideOptions,
    given=_Velocity, seconds=c_float, clock=c_uint64)
_WorldMover = _struct(
    "nsvcd_world_mover", id=c_size_t, how=_SlideOptions, velocity=_Velocity, push_mass=c_float, damping=c_float,
    spin_damping=c_float, asleep=c_int, sleepless=c_int, calm=c_float, answer=_SlideAnswer)
_StepOptions = _struct("nsvcd_step_options", gravity=c_float * 3, quiet=c_float, calm=c_float)
_StepAnswer = _struct("nsvcd_step_answer", awake=c_size_t, asleep=c_size_t, caught=c_size_t, contacts=c_size_t, questions=c_size_t,
                      work=c_size_t, refused=c_size_t)
_Mass = _struct("nsvcd_mass", volume=c_float, centre=c_float * 3, inertia=c_float * 3, is_of_box=c_int)
_STRUCTS = (_WorldMover, _StepOptions, _StepAnswer, _Mass, _WorldBody, _WorldContact, _WorldQuestion, _WorldAnswer, _SlideOptions, _Velocity, _SlideAnswer, _CertifyOptions, _Certificate, _Joint, _Part, _Scene, _Allowance, _Cone, _JointMotion, _PartialMotion, _CheckOptions, _CheckAnswer, _Proximity, _ProximityOptions, _NearestFreeOptions,
            _PairCounts, _ReachProblem, _ReachOptions, _ReachAnswer, _RouteProblem, _RouteOptions, _RouteAnswer, _Mesh, _EncodeOptions, _BodyFacts, _Pose, _NetworkOptions, _Mover, _Question, _Range, _Contact,
            _SafePlace, _Opinion, _Answer, _BodyPair, _PlanProgress, _PlanProblem, _PlanStage, _PlanOptions, _PlanAnswer)
_Layout = _struct("neuralsvcd_layout", name=c_char_p, place=c_size_t, size=c_size_t)

_PROTOTYPES = {
    "nsvcd_result_string": (c_char_p, c_int),
    "nsvcd_obj_parse": (c_int, c_char_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_mesh_cut": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p),
    "nsvcd_mesh_hull": (c_int, c_void_p, c_size_t, c_void_p, c_void_p),
    "nsvcd_mesh_of_heights": (c_int, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_mesh_mass": (c_int, c_void_p, c_void_p),
    "nsvcd_mesh_free": (None, c_void_p, c_void_p),
    "nsvcd_encode": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_body_free": (None, c_void_p, c_void_p),
    "nsvcd_body_load": (c_int, c_void_p, c_size_t, c_void_p),
    "nsvcd_body_scale": (c_int, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_body_describe": (_BodyFacts, c_void_p),
    "nsvcd_body_patch": (c_int, c_void_p, c_uint32, c_void_p, c_void_p),
    "nsvcd_sweep_workspace_size": (c_size_t, c_void_p),
    "nsvcd_sweep": (c_int, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_sweep_batch": (c_int, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "nsvcd_contacts": (c_int, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_void_p),
    "nsvcd_sweep_gradient": (c_int, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_spline": (None, c_void_p, c_size_t, c_size_t, c_float, c_size_t, c_void_p),
    "nsvcd_plan_workspace_size": (c_size_t, c_void_p, c_void_p),
    "nsvcd_plan": (c_int, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "nsvcd_stl_parse": (c_int, c_char_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_checker_size": (c_size_t, c_void_p),
    "nsvcd_checker_open": (c_int, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_forward_kinematics": (None, c_void_p, c_void_p, c_void_p),
    "nsvcd_check": (c_int, c_void_p, c_void_p, c_void_p, c_void_p),
    "nsvcd_merge_motions_size": (c_size_t, c_void_p, c_size_t, c_size_t),
    "nsvcd_merge_motions": (c_int, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_proximities": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_nearest_free": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p),
    "nsvcd_find_pairs": (c_int, c_void_p, c_size_t, c_uint64, c_void_p, c_size_t, c_void_p),
    "nsvcd_reparent": (c_int, c_void_p, c_void_p, c_size_t, c_uint32, c_void_p),
    "nsvcd_reach": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_route_size": (c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_route": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_tree_size": (c_size_t, c_void_p),
    "nsvcd_tree_build": (c_int, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_certify_workspace_size": (c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_certify": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_size": (c_size_t, c_size_t),
    "nsvcd_world_begin": (c_int, c_void_p, c_size_t, c_size_t, c_void_p),
    "nsvcd_world_add": (c_int, c_void_p, c_void_p, c_void_p),
    "nsvcd_world_move": (c_int, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_remove": (c_int, c_void_p, c_size_t),
    "nsvcd_world_get": (c_int, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_drive": (c_int, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_arrive": (c_int, c_void_p),
    "nsvcd_world_sweep": (c_int, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_list": (c_int, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_pairs": (c_int, c_void_p, c_float, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_slide": (c_int, c_void_p, c_size_t, c_void_p, c_float, c_void_p, c_size_t, c_void_p, c_void_p),
    "nsvcd_world_step": (c_int, c_void_p, c_void_p, c_size_t, c_void_p, c_float, c_void_p, c_size_t, c_void_p),
    "neuralsvcd_mesh_parse": (c_char_p, c_char_p, c_char_p, c_size_t, c_void_p, c_void_p, c_void_p, c_void_p),
    "neuralsvcd_layouts": (c_void_p, c_void_p),
}


def _expected_layouts() -> dict[str, tuple[int, int]]:
    """What neuralsvcd_layouts of _neuralsvcd.c must say, if all above is as in neuralsvcd.h."""
    expected = {"NSVCD_NO_TRIANGLE": (NO_TRIANGLE, 0), "NSVCD_MAX_CONTACTS": (_MAX_CONTACTS, 0),
                "NSVCD_WORLD_CONTACTS": (_WORLD_CONTACTS, 0),
                "NSVCD_MAX_VIA_POINTS": (_MAX_VIA_POINTS, 0), "NSVCD_NONE": (LEAVE_OUT, 0),
                "NSVCD_MAX_JOINTS": (_MAX_JOINTS, 0)}
    for values, prefix in _PREFIXES.items():
        expected.update({f"NSVCD_{prefix}{value.name}": (_number_of(value), 0) for value in values})
    for kind in _STRUCTS:
        expected[kind.__name__] = (0, ctypes.sizeof(kind))
        for name, _ in kind._fields_:
            member = getattr(kind, name)
            expected[f"{kind.__name__}.{name}"] = (member.offset, member.size)
    return expected


def _load_library() -> ctypes.CDLL:
    """The library beside this file, as a wheel has it, or the one that `make python` has built."""
    here = Path(__file__).resolve().parent
    places = [here / "_neuralsvcd.abi3.so", here.parents[2] / "build" / "_neuralsvcd.so"]
    path = next((place for place in places if place.exists()), None)
    if path is None:
        raise ImportError(f"neuralsvcd: the library is not built: make python; looked for {places[0]}, {places[1]}")
    library = ctypes.CDLL(str(path))
    for name, (result, *arguments) in _PROTOTYPES.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
    count = c_size_t()
    first = library.neuralsvcd_layouts(byref(count))
    table = (_Layout * count.value).from_address(first)
    found = {entry.name.decode(): (entry.place, entry.size) for entry in table}
    expected = _expected_layouts()
    wrong = sorted(name for name in {*found, *expected} if found.get(name) != expected.get(name))
    if wrong:
        raise ImportError(f"neuralsvcd: {path} is of another neuralsvcd.h than this module: {', '.join(wrong)}")
    return library


_library = _load_library()

# -------------------------------------------------------------------------------------------------------------- errors


class Error(Exception):
    """What the library refuses.

    code   why
    where  of a file its name, of an argument that, or ""
    line   of a file that is text, from 1; 0: none is at fault
    index  of sweep_batch: the first motion at fault; of World.step: the mover; else None
    reason in words, where a reader knows more than the code says, else ""
    """

    def __init__(self, code: int, where: str = "", line: int = 0, index: Optional[int] = None,
                 reason: str = "") -> None:
        super().__init__(code, where, line, index, reason)
        self.code = Code(code)
        self.where = where
        self.line = line
        self.index = index
        self.reason = reason

    def __str__(self) -> str:
        place = [self.where] if self.where else []
        if self.line:
            place.append(f"line {self.line}")
        if self.index is not None:
            place.append(f"index {self.index}")
        return ": ".join([*place, self.reason or _library.nsvcd_result_string(self.code).decode()])


def _check(code: int) -> None:
    if code:
        raise Error(code)


def _check_of(code: int, names: dict[Code, str]) -> None:
    """As _check. Which argument is at fault is told by the code, for each call."""
    if code:
        raise Error(code, names.get(Code(code), ""))


_OF_POINTS = {Code.SCALE: "step"}


def _check_radius(radius: float) -> None:
    if not radius > 0:
        raise Error(Code.RADIUS, "radius")


_OF_MOVERS = {Code.POSES: "poses", Code.POSE: "poses", Code.QUATERNION: "poses", Code.TIMES: "times", Code.SCALE: "scale"}


def _check_question(code: int, question: Any, index: Optional[int] = None) -> None:
    """As _check. Of what a and b both have it names the one at fault: a, if the question is refused with b at rest."""
    if code in _OF_MOVERS:
        resting = _Question.from_buffer_copy(question)
        resting.b = resting.b.body, None, 0, None, 2 if resting.a.scale == 1 else 1  # or it is the same twice
        side = "b" if _library.nsvcd_sweep_workspace_size(byref(resting)) else "a"
        raise Error(code, f"{_OF_MOVERS[Code(code)]}_{side}", index=index)
    if code:
        raise Error(code, index=index)


# -------------------------------------------------------------------------------------------- from Python to C, checked


def _numeric(value: ArrayLike, shape: tuple[Optional[int], ...], name: str) -> NDArray[Any]:
    """As an array of real numbers of this shape, where None stands for any length."""
    array = np.asarray(value)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: an array of numbers is needed, not of {array.dtype}")
    fits = array.ndim == len(shape)
    for want, have in zip(shape, array.shape):
        fits = fits and want in (None, have)
    if not fits:
        wanted = ", ".join("n" if length is None else str(length) for length in shape)
        raise ValueError(f"{name}: an array ({wanted}) is needed, not {array.shape}")
    return array


def _floats(value: ArrayLike, shape: tuple[Optional[int], ...], name: str) -> Floats:
    """A copy in C order, so that nothing changes it while the library reads it."""
    return np.array(_numeric(value, shape, name), np.float32, order="C")


def _indices(value: ArrayLike, columns: int, name: str) -> NDArray[np.uint32]:
    array = _numeric(value, (None, columns), name)
    if array.dtype.kind == "f":
        raise TypeError(f"{name}: an array of integers is needed, not of {array.dtype}")
    if array.size and not (0 <= array.min() and array.max() <= 0xffffffff):
        raise Error(Code.INDEX, name)
    return np.array(array, np.uint32, order="C")


def _address(array: Any) -> int:
    """Of a numpy array that can be written. array.ctypes.data takes three times as long."""
    return ctypes.addressof(c_char.from_buffer(array)) if array.size else int(array.ctypes.data)


def _memory(size: int) -> NDArray[np.uint8]:
    """Bytes, aligned as the library wants them."""
    return np.empty(size // 8 + 1, np.uint64).view(np.uint8)[:size]


def _number(kind: Any, value: Any, name: str) -> Any:
    """A number of a C type. ctypes itself would cut off what does not fit."""
    if kind is c_float:
        rounded = c_float(value)
        if value and not rounded.value:
            raise ValueError(f"{name}: {value} is 0 as a float")
        return rounded
    if isinstance(value, _Word):
        return _number_of(value)
    most = 0x7fffffff if kind is c_int else kind(-1).value
    number = operator.index(value)
    if not 0 <= number <= most:
        raise ValueError(f"{name}: {number} is not in 0..{most}")
    return number


def _filled(structure: Any, **values: Any) -> Any:
    """A struct with these fields. Those that hold structs themselves are given as Options and the like."""
    out = structure()
    for name, kind in structure._fields_:
        value = values.get(name)
        if value is None:
            continue
        setattr(out, name, value._c if issubclass(kind, ctypes.Structure) else _number(kind, value, name))
    return out


class _Workspace(threading.local):
    """Memory for any question, of each thread."""

    def __init__(self) -> None:
        self.size = _library.nsvcd_sweep_workspace_size(None)
        self.memory = _memory(self.size)
        self.address = _address(self.memory)


_workspace = _Workspace()

# -------------------------------------------------------------------------------------------------------------- meshes


class Mass(NamedTuple):
    """A mesh as a solid of one density: nsvcd_mass.

    volume     cubic metres
    centre     (3) float32, of mass: the pivot of what moves freely
    inertia    (3) float32, of a kilogram, square metres, about the mesh's axes through that centre; times the mass, and the scale
               squared, it is that of SlideOptions and Movers
    is_of_box  the mesh is open, inside out or flat, and all of this is that of its box
    """
    volume: float
    centre: Floats
    inertia: Floats
    is_of_box: bool


class Mesh(NamedTuple):
    """Triangles, counter-clockwise seen from outside.

    vertices   (n, 3) float32, metres
    triangles  (m, 3) uint32, of vertices
    """
    vertices: Floats
    triangles: NDArray[np.uint32]

    @classmethod
    def hull(cls, points: ArrayLike) -> Mesh:
        """The convex hull of (n, 3) points, metres: a closed mesh, whose vertices are points among these: nsvcd_mesh_hull.
        Error: EMPTY (all are in one plane), NUMBER, TOO_LARGE."""
        given, mesh = _floats(points, (None, 3), "points"), _Mesh()
        _check_of(_library.nsvcd_mesh_hull(_address(given), len(given), None, byref(mesh)), _OF_POINTS)
        return _taken(mesh)

    @classmethod
    def heights(cls, heights: ArrayLike, step: ArrayLike = 1) -> Mesh:
        """A height field, to be encoded as `open`: nsvcd_mesh_of_heights. Sample [row, column] is the vertex (column * step,
        row * step, height), z up.

        heights  (rows, columns) metres; NaN: there is no sample, and so a hole
        step     metres between samples, along x and y or (2) along each
        Error: EMPTY (there is no triangle), SCALE (step), NUMBER, TOO_LARGE.
        """
        given, mesh = _floats(heights, (None, None), "heights"), _Mesh()
        steps = _floats(np.repeat(step, 2) if np.ndim(step) == 0 else step, (2,), "step")
        _check_of(_library.nsvcd_mesh_of_heights(_address(given), *given.shape, _address(steps), None, byref(mesh)), _OF_POINTS)
        return _taken(mesh)

    def mass(self) -> Mass:
        """Its volume, centre of mass and moments of inertia, exact, to rounding, if it is closed: nsvcd_mesh_mass.
        Error: EMPTY, INDEX, NUMBER."""
        mesh, mass = _c_mesh(*self), _Mass()
        _check(_library.nsvcd_mesh_mass(byref(mesh), byref(mass)))
        return Mass(mass.volume, np.array(mass.centre, np.float32), np.array(mass.inertia, np.float32), bool(mass.is_of_box))


def _c_mesh(vertices: ArrayLike, triangles: ArrayLike) -> Any:
    kept = _floats(vertices, (None, 3), "vertices"), _indices(triangles, 3, "triangles")
    mesh = _Mesh(_address(kept[0]), _address(kept[1]), len(kept[0]), len(kept[1]))
    mesh.kept = kept
    return mesh


def _taken(mesh: Any) -> Mesh:
    """A copy of a mesh of the library's, which is given back."""
    def copied(address: int, rows: int, kind: Any) -> NDArray[Any]:
        return np.frombuffer((kind * (3 * rows)).from_address(address), kind).reshape(rows, 3).copy()
    try:
        return Mesh(copied(mesh.positions, mesh.vertex_count, c_float),
                    copied(mesh.indices, mesh.triangle_count, c_uint32))
    finally:
        _library.nsvcd_mesh_free(byref(mesh), None)


def _parsed(parse: Any, text: Union[str, bytes], where: str) -> Mesh:
    data = text.encode() if isinstance(text, str) else bytes(text)
    mesh, line = _Mesh(), c_size_t()
    code = parse(data, len(data), None, byref(mesh), byref(line))
    if code:
        raise Error(code, where, line.value)
    return _taken(mesh)


def parse_obj(text: Union[str, bytes], where: str = "") -> Mesh:
    """The mesh that OBJ text describes. `where` names it in an Error, which has the line at fault."""
    return _parsed(_library.nsvcd_obj_parse, text, where)


def parse_stl(data: Union[str, bytes], where: str = "") -> Mesh:
    """The mesh in STL data, binary or text."""
    return _parsed(_library.nsvcd_stl_parse, data, where)


_CODES = {_library.nsvcd_result_string(code).decode(): code for code in Code}


def parse_mesh(data: Any, where: str = "", scale: float = 1, origin: ArrayLike = (0, 0, 0)) -> Mesh:
    """The mesh in the bytes of an OBJ, STL, PLY or GLB file, as svcd reads it: by what they are, and by the name.

    scale, origin  as load_mesh has them
    """
    placed = np.array([*_numeric(origin, (3,), "origin"), scale], np.float64)
    if not np.isfinite(placed).all():
        raise ValueError(f"origin: {origin}" if math.isfinite(scale) else f"scale: {scale}")
    if not scale > 0:
        raise ValueError(f"scale: {scale}")
    given = memoryview(data).tobytes()
    mesh, form, line = _Mesh(), c_char_p(), c_size_t()
    name = os.fsencode(where).replace(b"\0", b"")
    why = _library.neuralsvcd_mesh_parse(name, given, len(given), _address(placed), byref(mesh), byref(form),
                                         byref(line))
    if why is None:
        return _taken(mesh)
    reason, taken_for = why.decode(), (form.value or b"").decode()
    is_plain = where.lower().endswith("." + taken_for.lower())
    raise Error(_CODES.get(reason, Code.SYNTAX), where, line.value,
                reason=reason if is_plain else f"{reason} (read as {taken_for})")


def load_mesh(path: FilePath, scale: float = 1, origin: ArrayLike = (0, 0, 0)) -> Mesh:
    """The mesh in an OBJ, STL, PLY or GLB file. OSError if it cannot be read.

    scale   to metres: 0.001 of millimetres
    origin  (3) in the file's units: the place that becomes the mesh's origin, taken off in double; of a map
    """
    where = os.fspath(path)
    mesh = parse_mesh(Path(path).read_bytes(), where, scale, origin)
    _warn_of_size(mesh, scale, where)
    return mesh


def _warn_of_size(mesh: Mesh, scale: float, where: str) -> None:
    """What is larger than 30 m or smaller than 1 mm is hardly meant: warned of as by `svcd info`."""
    extent = float(np.ptp(mesh.vertices, axis=0).max())
    if extent > 30:
        warnings.warn(f"{where}: a body of {extent:.4g} m: are these millimetres? try scale={scale / 1000:g}",
                      stacklevel=3)
    elif extent < 0.001:
        warnings.warn(f"{where}: a body of {extent:.4g} m: is it too small by a thousand? try scale={scale * 1000:g}",
                      stacklevel=3)


def load_stl(path: FilePath) -> Mesh:
    """The mesh in an STL file. OSError if it cannot be read."""
    return parse_stl(Path(path).read_bytes(), os.fspath(path))


def load_obj(path: FilePath) -> Mesh:
    """The mesh in an OBJ file. OSError if it cannot be read."""
    return parse_obj(Path(path).read_bytes(), os.fspath(path))


def cut_mesh(vertices: ArrayLike, triangles: ArrayLike, low: ArrayLike, high: ArrayLike) -> Mesh:
    """The part of a mesh within a box from low (3) to high (3), metres; to be encoded as `open`."""
    corners = _floats(low, (3,), "low"), _floats(high, (3,), "high")
    mesh, part = _c_mesh(vertices, triangles), _Mesh()
    _check(_library.nsvcd_mesh_cut(byref(mesh), *map(_address, corners), None, byref(part)))
    return _taken(part)


# -------------------------------------------------------------------------------------------------------------- bodies


class Facts(NamedTuple):
    """What a body is: nsvcd_body_facts.

    size               bytes
    patches            parts of its surface
    centre, radius     of a sphere that contains it, metres
    extent             no point of the mesh is farther from the origin, metres
    low, high          a box that contains the mesh, metres; zeros: no triangles are stored
    mean_patch_radius  metres
    triangles          of the mesh; 0: none are stored
    stored_triangles           triangles and parts of them that are stored
    quantization_error            0: answers are about the mesh's own floats; else triangles are within this of its, metres
    convex_radius              how far it goes beyond its mesh, metres
    balls              that cover it, for routes; 0: none are stored
    ball_error         no point of a ball is farther than this from the body, metres
    latents            the network can answer
    components         parts of the surface
    open_components    of these: not closed, once what does no harm is mended; 0: it is a solid
    open_edges         of these
    open               it was said to be open
    """
    size: int
    patches: int
    centre: Vector
    radius: float
    extent: float
    low: Vector
    high: Vector
    mean_patch_radius: float
    triangles: int
    stored_triangles: int
    quantization_error: float
    convex_radius: float
    balls: int
    ball_error: float
    latents: bool
    components: int
    open_components: int
    open_edges: int
    open: bool


class Body:
    """An encoded mesh. It does not change; threads may share it; it can be pickled and copied.

    vertices      (n, 3) metres; or a path, without triangles, of an OBJ, STL, PLY or GLB file: see load_mesh
    triangles     (m, 3) integers
    scale, origin of a file: see load_mesh
    patches       1 to 65536; 0: by the number of triangles
    patch_radius  metres; with patches = 0: as many as have about this radius; 0: unasked
    convex_radius         the body is all that is within so many metres of the mesh. If > 0, triangles may be points (one
                  vertex thrice) and segments, and there are no latents
    open          the mesh is not closed: nothing counts as inside it
    latents       for the network, the planner and gradients too
    no_triangles  for them alone
    balls         up to 1024 of them cover the mesh, for routes by looks: 128 suit a robot's link; 0: none
    coarse        in fewer bytes: answers are then about triangles within facts.quantization_error of the mesh's
    progress      called now and then with what is done, in [0, 1]. If it returns something true, Error(CANCELLED);
                  what it raises ends the encoding
    """

    __slots__ = ("_memory", "_address", "__weakref__")
    _memory: NDArray[np.uint8]
    _address: int

    def __init__(self, vertices: Union[ArrayLike, os.PathLike[str]], triangles: Optional[ArrayLike] = None, *,
                 scale: float = 1, origin: Optional[ArrayLike] = None, patches: int = 0, patch_radius: float = 0, convex_radius: float = 0, open: bool = False,
                 latents: bool = False, no_triangles: bool = False, coarse: bool = False, balls: int = 0,
                 progress: Optional[Callable[[float], Any]] = None) -> None:
        if isinstance(vertices, (str, os.PathLike)):
            if triangles is not None:
                raise TypeError("triangles: a file has its own")
            path = os.fspath(vertices)
            read = parse_mesh(Path(path).read_bytes(), path, scale, (0, 0, 0) if origin is None else origin)
            _warn_of_size(read, scale, path)
            mesh = _c_mesh(*read)
        elif triangles is None or scale != 1 or origin is not None:
            raise TypeError("triangles are missing" if triangles is None else "scale, origin: only of a file")
        else:
            mesh = _c_mesh(vertices, triangles)
        options = _filled(_EncodeOptions, patches=patches, patch_radius=patch_radius, convex_radius=convex_radius, open=open,
                          latents=latents, no_triangles=no_triangles, coarse=coarse, balls=balls)
        caught: list[BaseException] = []
        if progress:
            options.progress = _PROGRESS(functools.partial(_cancels, progress, caught))
        body = c_void_p()
        code = _library.nsvcd_encode(byref(mesh), byref(options), None, None, 0, byref(body))
        if caught:
            raise caught[0]
        _check(code)
        try:
            size = _library.nsvcd_body_describe(body).size
            memory = _memory(size)
            ctypes.memmove(_address(memory), body, size)
        finally:
            _library.nsvcd_body_free(body, None)
        self._keep(memory)

    @classmethod
    def sphere(cls, radius: float) -> Body:
        _check_radius(radius)
        return cls([[0, 0, 0]], [[0, 0, 0]], convex_radius=radius)

    @classmethod
    def capsule(cls, start: ArrayLike, end: ArrayLike, radius: float) -> Body:
        _check_radius(radius)
        return cls(np.array([start, end]), [[0, 1, 1]], convex_radius=radius)

    @classmethod
    def cloud(cls, points: ArrayLike, radius: float) -> Body:
        """All that is within a radius of (n, 3) points, metres."""
        _check_radius(radius)
        return cls(points, np.repeat(np.arange(len(np.asarray(points))), 3).reshape(-1, 3), convex_radius=radius)

    def _keep(self, memory: NDArray[np.uint8]) -> None:
        self._address = _address(memory)
        memory.flags.writeable = False
        self._memory = memory

    @classmethod
    def from_bytes(cls, data: Any) -> Body:
        """A body from what bytes(body) gave, or any other buffer. Every byte is checked; the buffer is not kept."""
        given = memoryview(data).cast("B")
        memory = _memory(len(given))
        memory[:] = given
        body = c_void_p()
        _check(_library.nsvcd_body_load(_address(memory), len(memory), byref(body)))
        self = cls.__new__(cls)
        self._keep(memory[:_library.nsvcd_body_describe(body).size])
        return self

    @classmethod
    def load(cls, path: FilePath) -> Body:
        """A body from a file of save, or of `svcd encode`."""
        return cls.from_bytes(Path(path).read_bytes())

    def save(self, path: FilePath) -> None:
        """Writes the body into a file."""
        Path(path).write_bytes(self._memory.data)

    def __bytes__(self) -> bytes:
        return self._memory.tobytes()

    def __reduce__(self) -> tuple[Any, ...]:
        return Body.from_bytes, (bytes(self),)

    def __repr__(self) -> str:
        return f"<neuralsvcd.Body: {self.facts.patches} patches, {self.facts.size} bytes>"

    def scaled(self, scale: ArrayLike) -> Body:
        """A copy, scaled about the origin: by one factor, of which a question needs no copy, or by (3), one along each axis.
        Factors that differ stretch it, and negative ones mirror; then it has no latents.
        Error: SCALE (a 0, too small or large; or a stretched body has a convex radius), TRIANGLES (it has none)."""
        memory = _memory(len(self._memory))
        scaled = c_void_p()
        factors = _floats(np.repeat(scale, 3) if np.ndim(scale) == 0 else scale, (3,), "scale")
        _check(_library.nsvcd_body_scale(self._address, _address(factors), _address(memory), len(memory), byref(scaled)))
        body = Body.__new__(Body)
        body._keep(memory)
        return body

    @property
    def facts(self) -> Facts:
        facts = _library.nsvcd_body_describe(self._address)
        return Facts(facts.size, facts.patches, _vector(facts.centre), facts.radius, facts.extent,
                     _vector(facts.low), _vector(facts.high), facts.mean_patch_radius,
                     facts.triangles, facts.stored_triangles, facts.quantization_error, facts.convex_radius,
                     facts.balls, facts.ball_error, bool(facts.latents), facts.components, facts.open_components, facts.open_edges,
                     bool(facts.open))

    def patch(self, index: int) -> tuple[Vector, float]:
        """Centre and radius of the sphere about a patch, metres, body frame."""
        if not 0 <= operator.index(index) < self.facts.patches:
            raise IndexError(f"no patch {index}")
        centre, radius = (c_float * 3)(), c_float()
        _library.nsvcd_body_patch(self._address, index, byref(centre), byref(radius))
        return _vector(centre), radius.value


def _vector(c: Any) -> Vector:
    return c[0], c[1], c[2]


def _cancels(progress: Callable[[Any], Any], caught: list[BaseException], done: Any, _: Any) -> int:
    """For C: 1 if the callback wants an end. ctypes would swallow what it raises."""
    try:
        return 1 if caught or progress(done) else 0
    except BaseException as error:  # KeyboardInterrupt too
        caught.append(error)
        return 1


# ------------------------------------------------------------------------------------------------------------- queries


class _Options:
    """A dataclass with the fields of a struct, and that struct."""
    _struct: ClassVar[Any]
    _c: Any

    def __post_init__(self) -> None:
        object.__setattr__(self, "_c", _filled(self._struct, **vars(self)))

    def __reduce__(self) -> tuple[Any, ...]:  # the struct is made anew
        given: Any = self
        return type(self), tuple(getattr(self, field.name) for field in dataclasses.fields(given))


@dataclass(frozen=True)
class Options(_Options):
    """What is asked, and how: nsvcd_question. What is 0 is the default. Words may be given as such: ask="first".

    ask        hit: do they hit at all? first: and when first? distance: and how near do they come?
    to         metres. first: nothing moves farther than this from time.low to time.high; distance: how wide the bracket
               may be; 0: a thousandth of the smaller body's radius
    to_time    first: the same as a share of the motion, up to 1
    clearance  metres: to come as near as this is a hit
    slop       metres: a contact at the start that is no deeper does not count
    tolerance  metres: what comes closer and does not meet may be left undecided
    manifold   first: up to four contacts, which hold the body, are told, where else one is
    method     proof where both bodies have triangles, else network, which knows neither first, nor a clearance or a
               slop, and of a distance, where it is named, has an opinion: Answer.opinion.distance
    work       units that a proof may take; 10000000, of a distance 100000
    segments   a motion is cut into at most so many, a multiple of 16 up to 64; 64
    Of the network:
    pairs      of patches that it looks at, 1 to 256; 8
    model, precision, recall  its decoder; recall: 0, 0.99, 0.999 or 0.9999
    inflate      of patches, a share of their radii, so that the logit rises before contact; 0, or, asked for a distance, 1
    """
    ask: Union[Ask, str] = Ask.HIT
    to: float = 0
    to_time: float = 0
    clearance: float = 0
    slop: float = 0
    tolerance: float = 0
    manifold: bool = False
    method: Union[Method, str] = Method.DEFAULT
    work: int = 0
    segments: int = 0
    pairs: int = 0
    model: Union[Model, str] = Model.DEFAULT
    precision: Union[Precision, str] = Precision.FLOAT
    recall: float = 0
    inflate: float = 0
    _struct = _Question

    def __post_init__(self) -> None:
        for name, kind in (("ask", Ask), ("method", Method), ("model", Model), ("precision", Precision)):
            given = getattr(self, name)
            if given not in set(kind):
                raise ValueError(f"{name}: {given!r} is none of {', '.join(kind)}")
            object.__setattr__(self, name, kind(given))
        super().__post_init__()
        self._c.network = _filled(_NetworkOptions, **vars(self))


_DEFAULTS = Options()

Pose = tuple[float, float, float, float, float, float, float]


class Range(NamedTuple):
    """What is known of a number: nsvcd_range. inf: it is not known."""
    low: float
    high: float


class Contact(NamedTuple):
    """Two triangles, and where they meet or are nearest: nsvcd_contact.

    point    world, metres
    normal   unit, from b to a, world; or 0
    gap      metres between the triangles; 0: they meet
    time     in [0, 1]
    triangle_a, triangle_b  as numbered in the meshes; None: none are named
    patch_a, patch_b        that list them
    id       of a manifold: of the corner, or the two edges, that touch; the same as long as they do
    """
    point: Vector
    normal: Vector
    gap: float
    time: float
    triangle_a: Optional[int]
    triangle_b: Optional[int]
    patch_a: int
    patch_b: int
    id: int


class SafePlace(NamedTuple):
    """Where the bodies may go: nsvcd_safe_pose. Poses x y z, quaternion x y z w, lifted off what they touch."""
    time: float
    a: Pose
    b: Pose


class Opinion(NamedTuple):
    """What the network thinks: nsvcd_opinion.

    logit       of collision, positive is yes
    distance    metres, of the same pair: by how much it misses, or, negative, how deep it is; inf: no decoder was needed
    time        in [0, 1]: when the most suspicious pair comes closest
    patch_a, patch_b  that pair
    candidates  pairs of patches whose spheres meet, and that no plane parts
    limited     there were more than options.pairs let through
    """
    logit: float
    distance: float
    time: float
    patch_a: int
    patch_b: int
    candidates: int
    limited: bool


class Answer(NamedTuple):
    """nsvcd_answer. As a condition it is answer.verdict != "free": what is undecided counts.

    verdict   free, hit or undecided
    by        proof or network: who says so
    why       not all that was asked is answered: too near, work, or open: one seems to be inside of what is
              nearly a solid; or nothing: all of it is
    inside    a hit, for one lies inside the other at the start
    time      in [0, 1], of the first contact: free before low, in contact at high. Only "first" brings these together:
              else low is 0, and high the time of a contact, before which there may be others
    distance  metres: the least; of a hit, up to time.high
    safe      where the bodies may go: poses at time.low
    depth     metres: of a contact at the start, the smallest push_out of a off b, up to options.slop or so, that ends it;
              0: there is no such contact; inf: it is not known
    push_out      metres, world: by what a was lifted off b for options.slop
    contacts  of a hit whose triangles are known, at time.high: one, or a manifold, in the order of their ids
    nearest   the triangles that distance.high is about, whatever the verdict
    opinion   of the network, where it was asked
    work      units that the proof took
    """
    verdict: Verdict
    by: By
    why: Why
    inside: bool
    time: Range
    distance: Range
    safe: SafePlace
    depth: float
    push_out: Vector
    contacts: list[Contact]
    nearest: Contact
    opinion: Optional[Opinion]
    work: int

    def __bool__(self) -> bool:
        return self.verdict is not Verdict.FREE


def _leaves(kind: Any, offset: int = 0) -> list[tuple[int, str]]:
    """The numbers of a struct: offset and format of each, vectors as one."""
    if not issubclass(kind, ctypes.Structure):
        return [(offset, f"{kind._length_}{kind._type_._type_}" if issubclass(kind, ctypes.Array) else kind._type_)]
    return [leaf for name, member in kind._fields_ if name != "contacts"
            for leaf in _leaves(member, offset + getattr(kind, name).offset)]


def _packed(kind: Any) -> struct.Struct:
    """All fields at once but for `contacts`: field by field takes twice the time."""
    layout = ""
    for offset, leaf in [*_leaves(kind), (ctypes.sizeof(kind), "")]:
        layout += f"{offset - struct.calcsize(layout)}x{leaf}"
    return struct.Struct(layout)


_FIELDS, _CONTACT = _packed(_Answer), _packed(_Contact)
_CONTACTS = _Answer.contacts.offset


def _contact_of(v: Any) -> Contact:
    return Contact(v[0:3], v[3:6], v[6], v[7], None if v[8] == NO_TRIANGLE else v[8],
                   None if v[9] == NO_TRIANGLE else v[9], v[10], v[11], v[12])


def _answer_of(c: Any) -> Answer:
    v: Any = _FIELDS.unpack(c)
    contacts = [_contact_of(_CONTACT.unpack_from(c, _CONTACTS + k * _CONTACT.size)) for k in range(v[27])]
    opinion = Opinion(v[42], v[43], v[44], v[45], v[46], v[47], bool(v[48])) if v[41] else None
    return Answer(_VERDICTS[v[0]], _BYS[v[1]], _WHYS[v[2]], bool(v[3]), Range(v[4], v[5]), Range(v[6], v[7]),
                  SafePlace(v[8], v[9:12] + v[12:16], v[16:19] + v[19:23]), v[23], v[24:27], contacts,
                  _contact_of(v[28:41]), opinion, v[49])


def poses_from_matrices(matrices: ArrayLike) -> Doubles:
    """Poses (..., 7) of rigid matrices (..., 4, 4), which take points as columns; nsvcd_verify is to be given these too.

    ValueError where one is not rigid to 1e-4.
    """
    return np.asarray(_posed(_numeric(matrices, (None,) * (np.ndim(matrices) - 2) + (4, 4), "matrices"), "matrices"))


def _posed(poses: Any, name: str) -> Any:
    """Poses, also where they are given as matrices."""
    given = np.asarray(poses)
    if given.shape[-2:] != (4, 4) or given.dtype.kind not in "fiu":
        return given
    m = given.astype(np.float64)
    if not np.isfinite(m).all() or (np.abs(m[..., 3, :] - [0, 0, 0, 1]) > 1e-4).any():
        raise ValueError(f"{name}: not finite, or a last row that is not 0 0 0 1: are points rows here? transpose it")
    r = m[..., :3, :3]
    metric = np.swapaxes(r, -1, -2) @ r
    square = np.trace(metric, axis1=-2, axis2=-1) / 3  # of the scale
    even = np.abs(metric - square[..., None, None] * np.eye(3)).max((-2, -1)) <= 2e-4 * square
    if not even.all() or (np.linalg.det(r) <= 0).any():
        raise ValueError(f"{name}: a matrix that shears, mirrors or stretches: it must be rigid")
    if (np.abs(square - 1) > 2e-4).any():  # of lengths, to 1e-4
        worst = math.sqrt(square.flat[np.abs(square - 1).argmax()])
        raise ValueError(f"{name}: a matrix that scales, by {worst:.6g}: give the scale as scale_a, scale_b or to the body")
    # The products of a quaternion's numbers, times 4: its row with the largest square is that quaternion, scaled.
    products = np.empty((*m.shape[:-2], 4, 4))
    products[..., :3, :3] = r + np.swapaxes(r, -1, -2)
    trace = np.trace(r, axis1=-2, axis2=-1)
    for i, (j, k) in enumerate(((1, 2), (2, 0), (0, 1))):
        products[..., i, i] = 1 + 2 * r[..., i, i] - trace
        products[..., i, 3] = products[..., 3, i] = r[..., k, j] - r[..., j, k]
    products[..., 3, 3] = 1 + trace
    largest = np.diagonal(products, axis1=-2, axis2=-1).argmax(-1)
    rotation = np.take_along_axis(products, largest[..., None, None], -2)[..., 0, :]
    return np.concatenate([m[..., :3, 3], rotation / np.linalg.norm(rotation, axis=-1, keepdims=True)], -1)


class _Motion(NamedTuple):
    """(k, 7), and (k) or None; of a batch there may be (n, k, 7) and (n, k). poses None: at rest at the origin."""
    poses: Optional[Floats]
    times: Optional[Floats]


def _motion(poses: Optional[ArrayLike], times: Optional[ArrayLike], side: str, batch: bool = False) -> _Motion:
    if poses is None:
        if times is not None:
            raise ValueError(f"times_{side}: there are no poses")
        return _Motion(None, None)
    given = np.asarray(poses)
    if given.shape[-2:] == (4, 4):
        given = _posed(given if given.ndim > 2 else given[None], f"poses_{side}")
    each = (None,) if batch and given.ndim != 2 else ()
    kept = _floats(given, (*each, None, 7), f"poses_{side}")
    if not kept.shape[-2]:
        raise ValueError(f"poses_{side}: no pose; None is at rest at the origin")
    if times is None:
        return _Motion(kept, None)
    each = (None,) if batch and np.ndim(times) != 1 else ()
    return _Motion(kept, _floats(times, (*each, kept.shape[-2]), f"times_{side}"))


def _mover(body: Union[Body, Tree], motion: _Motion, scale: float, side: str, kind: Any) -> Any:
    if not isinstance(body, kind):
        raise TypeError(f"{side}: a {kind.__name__} is needed, not {type(body).__name__}")
    factor = c_float(scale)
    if not factor.value:
        raise ValueError(f"scale_{side}: {scale}")  # in C that is 1
    address = body._address if isinstance(body, Body) else None
    if motion.poses is None:
        return address, None, 0, None, factor
    times = None if motion.times is None else _address(motion.times)
    return address, _address(motion.poses), len(motion.poses), times, factor


def _question(a: Union[Body, Tree], b: Union[Body, Tree], poses_a: Optional[ArrayLike], poses_b: Optional[ArrayLike],
              times_a: Optional[ArrayLike], times_b: Optional[ArrayLike], scale_a: float, scale_b: float,
              options: Options, kind: Any = Body) -> Any:
    motion_a = _motion(poses_a, times_a, "a")
    # The same arrays twice are the same motion, which the library refuses of one body.
    same = poses_b is poses_a and times_b is times_a
    motion_b = motion_a if same else _motion(poses_b, times_b, "b")
    question = _Question.from_buffer_copy(options._c)
    question.a, question.b = _mover(a, motion_a, scale_a, "a", kind), _mover(b, motion_b, scale_b, "b", kind)
    question.kept = motion_a, motion_b
    return question


def sweep(a: Body, b: Body, poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
          times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None, scale_a: float = 1, scale_b: float = 1, options: Options = _DEFAULTS) -> Answer:
    """Do two bodies hit each other? And when first: options=Options(ask="first").

    poses_a, poses_b  (k, 7) x y z in metres, unit quaternion x y z w; k may differ; one pose: it rests there; None: it
                      rests at the origin
    times_a, times_b  (k) when a body is at each pose, from 0 to 1, rising; None: uniform
    scale_a, scale_b  of the bodies, about their origins, 1e-6 to 1e6
    """
    question = _question(a, b, poses_a, poses_b, times_a, times_b, scale_a, scale_b, options)
    answer = _Answer()
    code = _library.nsvcd_sweep(byref(question), _workspace.address, _workspace.size, byref(answer))
    _check_question(code, question)
    return _answer_of(answer)


_MOST_CONTACTS = 6 * _MAX_CONTACTS  # NSVCD_MAX_SIDES


def contacts(a: Body, b: Body, pose_a: Optional[ArrayLike] = None, pose_b: Optional[ArrayLike] = None, *, clearance: float,
             scale_a: float = 1, scale_b: float = 1) -> tuple[list[Contact], bool]:
    """Where are two bodies at rest near each other, on all sides? Up to four contacts on each of six, those of the nearest side
    first; and whether some may be missing.

    pose_a, pose_b  (7) x y z in metres, unit quaternion x y z w, or (4, 4); None: it is at the origin
    clearance       metres: how near counts
    """
    poses = [None if pose is None else np.asarray(pose)[None] for pose in (pose_a, pose_b)]
    question = _question(a, b, poses[0], poses[1], None, None, scale_a, scale_b, Options(clearance=clearance))
    rows, count, is_partial = (_Contact * _MOST_CONTACTS)(), c_size_t(), c_int()
    code = _library.nsvcd_contacts(byref(question), _workspace.address, _workspace.size, rows, _MOST_CONTACTS, byref(count),
                                   byref(is_partial))
    _check_question(code, question)
    return [_contact_of(_CONTACT.unpack_from(rows, k * _CONTACT.size)) for k in range(count.value)], bool(is_partial.value)


class Gradient(NamedTuple):
    """The network's answer, and the derivatives of opinion.distance, or of the logit, by the poses.

    by_a, by_b  (k, 6) float32, one row for a body without poses: by a displacement of the body's origin (metres,
                world), then by a small rotation about it (rotation vector, radians, world, applied on the left)
    """
    answer: Answer
    by_a: Floats
    by_b: Floats


def sweep_gradient(a: Body, b: Body, poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
                   times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None,
                   scale_a: float = 1, scale_b: float = 1, options: Options = _DEFAULTS) -> Gradient:
    """As sweep, by the network, with derivatives of the logit, or, where options.ask is distance, of the distance; zero where
    no network answered."""
    question = _question(a, b, poses_a, poses_b, times_a, times_b, scale_a, scale_b, options)
    answer = _Answer()
    by_a, by_b = (np.zeros((1 if poses is None else len(poses), 6), np.float32) for poses, _ in question.kept)
    code = _library.nsvcd_sweep_gradient(byref(question), _workspace.address, _workspace.size, byref(answer),
                                         _address(by_a), _address(by_b))
    _check_question(code, question)
    return Gradient(_answer_of(answer), by_a, by_b)


# -------------------------------------------------------------------------------------------------------- certificates


class Tree:
    """A mesh as certify takes it: nsvcd_tree. It does not change; threads may share it; it can be pickled and copied.

    vertices   (n, 3) metres
    triangles  (m, 3) integers
    """

    __slots__ = ("_mesh", "_memory", "_address")

    def __init__(self, vertices: ArrayLike, triangles: ArrayLike) -> None:
        self._mesh = _c_mesh(vertices, triangles)
        size = _library.nsvcd_tree_size(byref(self._mesh))
        self._memory = _memory(size)
        tree = c_void_p()
        _check(_library.nsvcd_tree_build(byref(self._mesh), _address(self._memory), size, byref(tree)))
        self._address = tree.value

    def __reduce__(self) -> tuple[Any, ...]:
        return Tree, self._mesh.kept


class Certificate(NamedTuple):
    """What was proven: nsvcd_certificate.

    verdict  free or hit: the bytes prove it; undecided: there are none
    why      ... since the visits were spent, or they come too near to tell
    inside   a hit, for a corner of one is inside of the other
    time     in [0, 1], of a hit: a contact, which need not be the first
    bytes    the proof, for nsvcd_verify and examples/verify
    visits   steps that were taken
    """
    verdict: Verdict
    why: Why
    inside: bool
    time: float
    bytes: bytes
    visits: int


def certify(a: Tree, b: Tree, poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
            times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None, scale_a: float = 1,
            scale_b: float = 1, clearance: float = 0, answer: Optional[Answer] = None, visits: int = 0) -> Certificate:
    """Do two meshes hit each other? Poses, times and scales as sweep has them; what is answered is proven to others.

    clearance  metres: to come as near as this is a hit
    answer     of sweep, where a hit is looked for first; it is not believed
    visits     steps that may be taken; 1000000
    """
    question = _question(a, b, poses_a, poses_b, times_a, times_b, scale_a, scale_b, Options(clearance=clearance), Tree)
    options = _filled(_CertifyOptions, visits=visits)
    if answer is not None:
        named = answer.nearest
        triangles = (NO_TRIANGLE if k is None else k for k in (named.triangle_a, named.triangle_b))
        told = _Answer(verdict=_number_of(answer.verdict), inside=answer.inside)
        told.nearest.time, (told.nearest.triangle_a, told.nearest.triangle_b) = named.time, triangles
        options.answer = ctypes.addressof(told)
    size = _library.nsvcd_certify_workspace_size(byref(question), a._address, b._address)
    workspace = _memory(size)
    made = _Certificate(size=1 << 20)  # more than most take
    room = 0
    while room < made.size:
        room = made.size
        data = _memory(room)
        _check(_library.nsvcd_certify(byref(question), a._address, b._address, byref(options), _address(workspace),
                                      size, _address(data), room, byref(made)))
    return Certificate(_VERDICTS[made.verdict], _WHYS[made.why], bool(made.inside), made.time,
                       data[:made.size].tobytes(), made.visits)


# -------------------------------------------------------------------------------------------------------- many motions


_WORDS = {"verdict": np.array(_VERDICTS, str), "by": np.array(_BYS, str), "why": np.array(_WHYS, str)}
_FLAGS = ("inside", "asked", "limited")


def _with_flags(plain: np.dtype[Any]) -> np.dtype[Any]:
    """With a bool for ints that are 0 or 1: their first byte on a little-endian machine, as bodies demand one. So they
    can choose rows."""
    if plain.subdtype:
        return np.dtype((_with_flags(plain.subdtype[0]), plain.shape))
    if not plain.names or not plain.fields:
        return plain
    formats = ["?" if name in _FLAGS else _with_flags(plain.fields[name][0]) for name in plain.names]
    return np.dtype({"names": plain.names, "formats": formats, "itemsize": plain.itemsize,
                     "offsets": [plain.fields[name][1] for name in plain.names]})


def _answers_type() -> np.dtype[Any]:
    """nsvcd_answer for numpy, and behind it the words for its first numbers."""
    plain = _with_flags(np.dtype(_Answer))
    assert plain.names and plain.fields
    formats, offsets, size = [], [], plain.itemsize
    for name in plain.names:
        if name in _WORDS:
            formats.append(_WORDS[name].dtype)
            offsets.append(size)
            size += formats[-1].itemsize
        else:
            formats.append(plain.fields[name][0])
            offsets.append(plain.fields[name][1])
    return np.dtype({"names": plain.names, "formats": formats, "offsets": offsets, "itemsize": -(-size // 8) * 8})


_QUESTIONS = np.dtype(_Question)
_C_ANSWERS = np.dtype(_Answer)
_ANSWERS = _answers_type()


def _worded(c: NDArray[Any]) -> NDArray[Any]:
    """The library's answers, with words."""
    answers = np.zeros(len(c), _ANSWERS)
    if len(c):
        size = _C_ANSWERS.itemsize
        answers.view(np.uint8).reshape(len(c), -1)[:, :size] = c.view(np.uint8).reshape(len(c), size)
    for name, words in _WORDS.items():
        answers[name] = words[c[name]]
    return answers


Bodies = Union[Body, Sequence[Body]]


class _Side(NamedTuple):
    """Body a or body b of all questions of a batch; each one, or one for each question."""
    name: str
    bodies: Bodies
    motion: _Motion
    scales: Floats

    def lengths(self) -> set[int]:
        lengths = set() if isinstance(self.bodies, Body) else {len(self.bodies)}
        lengths.update(len(each) for each, one in zip(self.motion, (2, 1)) if each is not None and each.ndim > one)
        if self.scales.ndim == 1:
            lengths.add(len(self.scales))
        return lengths

    def write(self, movers: NDArray[Any]) -> None:
        bodies = [self.bodies] if isinstance(self.bodies, Body) else self.bodies
        if not all(isinstance(body, Body) for body in bodies):
            raise TypeError(f"{self.name}: bodies are needed")
        movers["body"] = [body._address for body in bodies]
        movers["scale"] = self.scales
        for field, given, one in zip(("poses", "times"), self.motion, (2, 1)):
            if given is not None:
                step = given.strides[0] if given.ndim > one else 0
                movers[field] = _address(given) + step * np.arange(len(movers), dtype=np.uintp)
        if self.motion.poses is not None:
            movers["count"] = self.motion.poses.shape[-2]


def _side(name: str, bodies: Bodies, poses: Optional[ArrayLike], times: Optional[ArrayLike],
          scale: ArrayLike) -> _Side:
    given = np.asarray(scale)
    scales = _floats(given, (None,) * min(given.ndim, 1), f"scale_{name}")
    if not scales.all():
        raise ValueError(f"scale_{name}: 0")
    kept: Bodies = bodies if isinstance(bodies, Body) else tuple(bodies)
    return _Side(name, kept, _motion(poses, times, name, batch=True), scales)


def _first_fault(questions: NDArray[Any]) -> int:
    start, step = _address(questions), questions.itemsize
    return next(k for k in range(len(questions)) if not _library.nsvcd_sweep_workspace_size(start + k * step))


def sweep_batch(a: Bodies, b: Bodies, poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
                times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None,
                scale_a: ArrayLike = 1, scale_b: ArrayLike = 1, options: Options = _DEFAULTS) -> NDArray[Any]:
    """Answers n questions in one call of the library, one after the other.

    a, b              a body for all, or a sequence of n
    poses_a, poses_b  (n, k, 7), or (k, 7) for all, or None
    times_a, times_b  (n, k), or (k) for all, or None
    scale_a, scale_b  (n), or a number for all

    Returns a structured array (n) with the fields of nsvcd_answer: answers["verdict"] == "hit" is an array of bool,
    answers["time"]["high"] one of floats, of the first contacts if options.ask is "first". Of answers["contacts"],
    (n, 4), each has contact_count; triangles may be NO_TRIANGLE; answers["opinion"]["asked"] says whether there is one.
    One after another on the same two bodies: the network is first asked where the motion before collided; see
    nsvcd_sweep_batch.
    """
    side_a, side_b = _side("a", a, poses_a, times_a, scale_a), _side("b", b, poses_b, times_b, scale_b)
    if poses_b is poses_a and times_b is times_a:
        side_b = side_b._replace(motion=side_a.motion)  # as in _question
    lengths = side_a.lengths() | side_b.lengths()
    if len(lengths) != 1:
        raise ValueError(f"lengths differ: {sorted(lengths)}" if lengths else "nothing says how many motions there are")
    questions = np.empty(lengths.pop(), _QUESTIONS)
    answers = np.zeros(len(questions), _C_ANSWERS)
    if not len(questions):
        return _worded(answers)
    questions[:] = np.frombuffer(options._c, _QUESTIONS)[0]
    side_a.write(questions["a"])
    side_b.write(questions["b"])
    code = _library.nsvcd_sweep_batch(_address(questions), len(questions), _workspace.address, _workspace.size,
                                      _address(answers))
    if code:
        index = _first_fault(questions)
        _check_question(code, questions[index:index + 1], index)
    return _worded(answers)


# -------------------------------------------------------------------------------------------------------- trajectories


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


@dataclass(frozen=True)
class Stage(_Options):
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
    _struct = _PlanStage


@dataclass(frozen=True)
class PlanOptions(_Options):
    """How a motion is planned: nsvcd_plan_options. What is 0 is the default.

    seed, seeds       of all random numbers; starts, tried until one ends free: 6
    explore, refine   the stages, MPPI and L-BFGS
    velocity, acceleration, jerk  weights of the means of squares over the motion: 10, 2, 10
    collision         weight of the logits' sum: 20
    duration          seconds, which only weights the terms above: 20
    margin            logits above minus this cost: 2
    discrete          poses instead of sweeps
    check             segments of the last check: 16 times the finest stage's
    sweep             of all queries; its ask, to and to_time are not read
    """
    seed: int = 0
    seeds: int = 0
    explore: Stage = Stage()
    refine: Stage = Stage()
    velocity: float = 0
    acceleration: float = 0
    jerk: float = 0
    collision: float = 0
    duration: float = 0
    margin: float = 0
    discrete: bool = False
    check: int = 0
    sweep: Options = _DEFAULTS
    _struct = _PlanOptions


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
    status        CONVERGED: within the limits, and proven free where bodies have triangles, but for `deviation`
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


def plan(bodies: Sequence[Optional[Body]], pairs: ArrayLike, kinematics: Callable[[Floats], ArrayLike], start: ArrayLike,
         goal: ArrayLike, low: ArrayLike, high: ArrayLike, *,
         jacobian: Optional[Callable[[Floats], ArrayLike]] = None,
         progress: Optional[Callable[[Progress], Any]] = None, options: PlanOptions = PlanOptions()) -> Plan:
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
    What a callback raises ends the planning, and is raised here. A cost of collision of one's own is not bound.
    """
    first = _floats(start, (None,), "start")
    joints = len(first)
    rows = [first, *(_floats(row, (joints,), name) for row, name in ((goal, "goal"), (low, "low"), (high, "high")))]
    kept = tuple(bodies)
    if not all(body is None or isinstance(body, Body) for body in kept):
        raise TypeError("bodies: each a Body, or None")
    addresses = (c_void_p * len(kept))(*(c_void_p(body._address if body else None) for body in kept))
    met = _indices(pairs, 2, "pairs")
    caught: list[BaseException] = []

    def call(function: Callable[[Floats], ArrayLike], name: str, given: int, out: int, *shape: int) -> None:
        target = _view(out, *shape)
        try:
            target[:] = np.nan if caught else _numeric(_posed(function(_view(given, joints).copy()), name), shape, name)
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
        kinematics=_PLACE(lambda _, given, out: call(kinematics, "kinematics", given, out, len(kept), 7)),
        progress=_PLAN_PROGRESS(lambda user, address: _cancels(tell, caught, address, user)))
    if jacobian:
        derive = jacobian
        problem.jacobian = _PLACE(lambda _, given, out: call(derive, "jacobian", given, out, len(kept), 6, joints))
    size = _library.nsvcd_plan_workspace_size(byref(problem), byref(options._c))
    workspace = _memory(size)
    control = np.empty((_MAX_VIA_POINTS + 2, joints), np.float32)
    answer = _PlanAnswer()
    code = _library.nsvcd_plan(byref(problem), byref(options._c), _address(workspace), size, _address(control),
                               byref(answer))
    if caught:
        raise caught[0]
    _check(code)
    joint, pair = (None if index == LEAVE_OUT else index for index in (answer.joint, answer.pair))
    return Plan(control[:answer.via_points + 2].copy(), PlanStatus(answer.status), bool(answer.collides), joint, pair,
                answer.logit, answer.time, answer.deviation, answer.cost, answer.smoothness, answer.seeds, answer.iterations,
                answer.trajectories, answer.sweeps)

# -------------------------------------------------------------------------------------------------------------- robots

_IDENTITY = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


class Joint(NamedTuple):
    """nsvcd_joint. Joint i carries link i + 1; link 0 is the world.

    parent         the link that it is on
    origin, axis   where it is in that link, a pose (7); any length but 0
    low, high      limits, radians or metres; not read of CONTINUOUS
    speed, acceleration  what a route keeps to; 0: 1
    mimic          the index of the joint that this one mimics; its value is always multiplier * that of the other + offset
    """
    parent: int
    origin: ArrayLike = _IDENTITY
    axis: ArrayLike = (0.0, 0.0, 1.0)
    kind: JointKind = JointKind.REVOLUTE
    low: float = -math.pi
    high: float = math.pi
    speed: float = 0
    acceleration: float = 0
    mimic: Optional[int] = None
    multiplier: float = 1
    offset: float = 0


class Part(NamedTuple):
    """A body on a link: nsvcd_part."""
    body: Body
    link: int = 0
    pose: ArrayLike = _IDENTITY
    scale: float = 0


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

    verdict       FREE: at all times of the joints' own motion
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
    """nsvcd_route_answer.

    points, times  (2 pieces + 1, F) and (pieces + 1): pieces of degree 2; None unless FOUND
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


def _doubles(value: ArrayLike, shape: tuple[Optional[int], ...], name: str) -> Doubles:
    return np.array(_numeric(value, shape, name), np.float64, order="C")


def _pose_of(pose: ArrayLike, name: str) -> Any:
    row = _floats(_posed(pose, name), (7,), name).tolist()
    return _Pose((c_float * 3)(*row[:3]), (c_float * 4)(*row[3:]))


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
        self._joints = (_Joint * max(len(joints), 1))(*(
            _Joint(_number_of(JointKind(j.kind)), _number(c_uint32, j.parent, "parent"), _pose_of(j.origin, "origin"),
                   (c_float * 3)(*_floats(j.axis, (3,), "axis").tolist()), j.low, j.high, j.speed, j.acceleration,
                   0 if j.mimic is None else _number(c_uint32, j.mimic + 1, "mimic"), j.multiplier, j.offset)
            for j in joints))
        self._bodies = [part.body for part in parts]
        self._parts = (_Part * max(len(parts), 1))(*(
            _Part(part.body._address, _number(c_uint32, part.link, "link"), _pose_of(part.pose, "pose"), part.scale)
            for part in parts))
        if clearances is not None:
            self._clearances = _floats(clearances, (len(_indices(pairs, 2, "pairs")),), "clearances")
        self._near = [_doubles(joints, (self.joint_count,), "allowances") for _, joints, _ in allowances]
        self._allowances = (_Allowance * max(len(allowances), 1))(*(
            _Allowance(_number(c_size_t, pair, "allowances"), _address(near), metres)
            for (pair, _, metres), near in zip(allowances, self._near)))
        self._cones = (_Cone * max(len(cones), 1))(*(
            _Cone(_number(c_uint32, part, "cones"), *((c_float * 3)(*_floats(x, (3,), "cones").tolist()) for x in (axis, direction)), angle)
            for part, axis, direction, angle in cones))
        self._cone_count = len(cones)
        self._open(np.empty((0, 2), np.uint32) if pairs is None else pairs)
        if pairs is None:
            asked, _, touching = self.find_pairs()
            self._open(np.concatenate([asked, touching]))

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
        stays = np.array(held, dtype=np.bool_)
        if stays.shape != (self.joint_count,):
            raise ValueError(f"held: expected {self.joint_count} values")
        return stays

    @property
    def pairs(self) -> NDArray[np.uint32]:
        """Those that are asked: (P, 2)."""
        return self._pairs.copy()

    def find_pairs(self, draws: int = 0, seed: int = 0) -> tuple[NDArray[np.uint32], ...]:
        """Pairs (n, 2) that can meet, that one joint separates, and that touch in all draws: nsvcd_find_pairs."""
        most = self.part_count * self.part_count
        found = np.empty((max(most, 1), 2), np.uint32)
        counts = _PairCounts()
        _check(_library.nsvcd_find_pairs(self._checker, _number(c_size_t, draws, "draws"),
                                         _number(c_uint64, seed, "seed"), _address(found), most, byref(counts)))
        ends = np.cumsum([counts.asked, counts.adjacent, counts.touching]).tolist()
        return tuple(found[first:last].copy() for first, last in zip([0, *ends], ends))

    def proximities(self, joints: ArrayLike, *, max_distance: float = 0, to: float = 0, max_depth: float = 0, work: int = 0) -> list[Proximity]:
        """All pairs that are near in a configuration: nsvcd_proximities."""
        row = _doubles(joints, (self.joint_count,), "joints")
        rows = (_Proximity * max(len(self._pairs), 1))()
        count = c_size_t()
        options = _filled(_ProximityOptions, max_distance=max_distance, to=to, max_depth=max_depth, work=work)
        _check(_library.nsvcd_proximities(self._checker, _address(row), byref(options), rows, len(self._pairs), byref(count)))
        return [Proximity(g.pair, _VERDICTS[g.verdict], _WHYS[g.why], Range(g.distance.low, g.distance.high), g.depth, _vector(g.contact.point),
                    _vector(g.contact.normal), np.array(g.slope[:self.joint_count])) for g in rows[:count.value]]

    def nearest_free(self, joints: ArrayLike, *, clearance: float = 0, farthest: float = 0, seed: int = 0) -> Optional[Doubles]:
        """A configuration near by that is proven free, or None: nsvcd_nearest_free."""
        row = _doubles(joints, (self.joint_count,), "joints")
        out = np.empty(self.joint_count)
        is_found = c_int()
        options = _filled(_NearestFreeOptions, clearance=clearance, seed=seed)
        options.farthest = farthest
        _check(_library.nsvcd_nearest_free(self._checker, _address(row), byref(options), _address(out), byref(is_found)))
        return out if is_found.value else None

    def reach(self, start: ArrayLike, target: ArrayLike, link: int, tool: ArrayLike = _IDENTITY, *, target_link: int = 0,
              half: ArrayLike = (0, 0, 0), free_axis: ArrayLike = (0, 0, 0), most: int = 16, position_tolerance: float = 0,
              angle_tolerance: float = 0, apart: float = 0, starts: int = 0, seed: int = 0, clearance: float = 0,
              may_touch: bool = False, held: Optional[ArrayLike] = None) -> Reached:
        """Configurations, at most `most`, that have a tool, a pose on a link, at a target: nsvcd_reach.

        held    (F) true: the joint stays where the start has it
        """
        row = _doubles(start, (self.joint_count,), "start")
        out = np.empty((most, self.joint_count))
        problem, answer = _ReachProblem(start=_address(row)), _ReachAnswer()
        problem.link, problem.target_link = _number(c_uint32, link, "link"), _number(c_uint32, target_link, "target_link")
        problem.tool, problem.target = _pose_of(tool, "tool"), _pose_of(target, "target")
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

    def handed_over(self, joints: ArrayLike, part: int, link: int) -> Part:
        """A part as another link would carry it from where it is, for a Robot to come: nsvcd_reparent."""
        row = _doubles(joints, (self.joint_count,), "joints")
        out = _Part()
        _check(_library.nsvcd_reparent(self._checker, _address(row), _number(c_size_t, part, "part"),
                                        _number(c_uint32, link, "link"), byref(out)))
        return Part(self._bodies[part], out.link, [*out.pose.position, *out.pose.rotation], out.scale)

    def forward_kinematics(self, joints: ArrayLike) -> Floats:
        """Where the parts are: poses (B, 7)."""
        row = _doubles(joints, (self.joint_count,), "joints")
        poses = np.empty((self.part_count, 7), np.float32)
        _library.nsvcd_forward_kinematics(self._checker, _address(row), _address(poses))
        return poses

    def merge(self, motions: Sequence[Motion], rest: Optional[ArrayLike] = None) -> Motion:
        """Motions of different joints, each on a clock of its own, as one of all joints: nsvcd_merge_motions.

        rest  (F) where joints are that none of them moves
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
        resting = None if rest is None else _doubles(rest, (self.joint_count,), "rest")
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

    def check(self, points: ArrayLike, *, degree: int = 1, times: Optional[ArrayLike] = None, clearance: float = 0,
              finest: float = 0, work: int = 0, to_time: float = 0) -> Checked:
        """Is a motion free, as the joints make it? nsvcd_check.

        points  (F): a configuration; (pieces degree + 1, F): Bezier pieces, a polyline if the degree is 1
        times   (pieces + 1), seconds; None: each piece takes one
        to_time seconds: of what is not free, also seek until when it is, to this precision; 0: not sought
        """
        kept: list[Any] = []
        motion = _motion_of(points, self.joint_count, degree, times, kept)
        options = _filled(_CheckOptions, clearance=clearance, finest=finest, work=work)
        options.to_time = to_time
        answer = _CheckAnswer()
        _check(_library.nsvcd_check(self._checker, byref(motion), byref(options), byref(answer)))
        return _checked(answer)

    def route(self, start: ArrayLike, goals: ArrayLike, *, guess: Optional[ArrayLike] = None, clearance: float = 0,
              seed: int = 0, nodes: int = 0, tries: int = 0, edge: float = 0, looks: int = 0, shortcuts: int = 0, smoothings: int = 0,
              stop: Optional[Callable[[], Any]] = None, held: Optional[ArrayLike] = None) -> Route:
        """A motion from the start (F) to a goal (F), or one of several (G, F), proven free: nsvcd_route.

        guess  (n, F) a way that may be free, its ends left out
        tries  motions asked about in search of a way, at most; 0: 4 times the nodes
        looks  motions looked at before that, at most, if all that moves has balls; LEAVE_OUT: none
        stop   asked before each proof and look; something true ends the search
        held   (F) true: the joint stays where the start has it, as the goals do
        """
        rows = [_doubles(start, (self.joint_count,), "start"),
                _doubles(np.atleast_2d(np.asarray(goals)), (None, self.joint_count), "goals")]
        problem = _RouteProblem(_address(rows[0]), _address(rows[1]), len(rows[1]))
        if guess is not None:
            rows.append(_doubles(guess, (None, self.joint_count), "guess"))
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
        is_found = answer.status == RouteStatus.FOUND
        if is_found:
            count = answer.motion.pieces
            shape = (2 * count + 1, self.joint_count)
            numbers = (c_double * math.prod(shape)).from_address(answer.motion.points)
            points = np.frombuffer(numbers).reshape(shape).copy()
            times = np.frombuffer((c_double * (count + 1)).from_address(answer.motion.times)).copy()
        return Route(RouteStatus(answer.status), answer.goal if is_found else None, points, times, answer.stops,
                     answer.duration, answer.unhindered, _checked(answer.check), answer.nodes, answer.checks,
                     answer.proven, answer.looks)


# -------------------------------------------------------------------------------------------------------------- worlds


@dataclass(frozen=True)
class SlideOptions(_Options):
    """How a body of a World slides: nsvcd_slide_options. What is 0 is the default.

    clearance    metres: what it never comes nearer to anything than; a two-hundredth of its radius
    margin       metres: how much farther than that it comes to rest, or a part of that; the same
    mass, inertia  kilograms, and (3) kg m^2 about its axes through its pivot. Without an inertia it does not turn by what it
                 meets; without a mass it is a character, whose impulses are speeds
    friction     of what it rubs against
    restitution  of what it hits faster than half a metre a second, up to 1
    up           (3) a character: the direction up, unit. It rides on what it stands on
    step         metres: as high a step it climbs
    slope        the least cosine between up and the normal of a ground that it stands on; 0.7
    rounds       how often in a frame it goes on after a contact; 4
    work         units of each question; 10000
    """
    clearance: float = 0
    margin: float = 0
    mass: float = 0
    inertia: ArrayLike = (0, 0, 0)
    friction: float = 0
    restitution: float = 0
    up: ArrayLike = (0, 0, 0)
    step: float = 0
    slope: float = 0
    rounds: int = 0
    work: int = 0
    _struct = _SlideOptions

    def __post_init__(self) -> None:
        vectors = {name: _floats(getattr(self, name), (3,), name).tolist() for name in ("inertia", "up")}
        values = {**vars(self), **{name: None for name in vectors}}
        object.__setattr__(self, "_c", _filled(self._struct, **values))
        for name, vector in vectors.items():
            object.__setattr__(self, name, tuple(vector))
            getattr(self._c, name)[:] = vector


_USUAL_SLIDE = SlideOptions()


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


class WorldContact(NamedTuple):
    """nsvcd_world_contact: a contact of a mover, which is `a` of it, with a body of the world, by its id.

    impulse  newton seconds, along the normal: what a slide took from the mover's momentum; without a mass, metres a second
    """
    body: int
    contact: Contact
    impulse: float


class WorldAnswer(NamedTuple):
    """nsvcd_world_answer. As a condition it is answer.verdict != "free", as of Answer.

    verdict    hit: it hits some body; undecided: it hits none, and of some that is not known; free: of all
    why        ... it is not
    body       that is hit first, or else is undecided first; None: it is free
    time       free of all bodies before low, in contact with one at high
    safe_time, safe  "first": where the mover may go: this pose, and the way there, are proven to be free of all bodies
    depth, push_out  with a slop: how the mover was pushed out, of all that it touched at once
    contacts   "first": with all bodies that touch at the safe pose, one each, or with options.manifold all, up to 32
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


class Step(NamedTuple):
    """What became of all movers in a frame: nsvcd_step_answer. Of all: how many

    awake      moved, or could have
    asleep     sleep at the end
    caught     could not get out of the way of a driven body
    contacts, questions, work  of their slides
    """
    awake: int
    asleep: int
    caught: int
    contacts: int
    questions: int
    work: int


def _columns(struct: Any, start: int = 0) -> dict[str, tuple[Any, int]]:
    """The numbers of a struct that starts there in a row of Movers: of which kind, and where."""
    columns = {}
    for name, kind in struct._fields_:
        whole, place = np.dtype(kind), start + getattr(struct, name).offset
        if whole == np.intc:  # a truth: its lowest byte
            whole, place = np.dtype(bool), place + (whole.itemsize - 1 if sys.byteorder == "big" else 0)
        columns[name] = whole, place
    return columns


_TOLD_OF_MOVERS = ("caught", "ground", "ground_normal", "contact_count")
_GIVEN_OF_MOVERS = ("velocity", "mass", "inertia", "friction", "restitution", "push_mass", "damping", "spin_damping", "asleep",
                    "sleepless", "clearance", "margin", "up", "step", "slope", "rounds", "work")


def _mover_rows() -> Any:
    """A type of numpy's: an nsvcd_world_mover by the names that Movers have."""
    columns = {**_columns(_SlideAnswer, _WorldMover.answer.offset), **_columns(_WorldMover),
               **_columns(_SlideOptions, _WorldMover.how.offset),
               "velocity": (np.dtype((np.float32, 6)), _WorldMover.velocity.offset)}
    names = ["id", *_GIVEN_OF_MOVERS, *_TOLD_OF_MOVERS]
    formats, offsets = zip(*(columns[name] for name in names))
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": ctypes.sizeof(_WorldMover)})


_MOVER_ROWS = _mover_rows()


class Movers:
    """n bodies of a World that World.step moves: nsvcd_world_mover, as arrays, one row for each body.

        movers = Movers(ids, mass=2, inertia=2 * box.mass().inertia, friction=0.5)
        movers.velocity[0] = 3, 0, 0, 0, 0, 0
        while not movers.asleep.all():
            world.step(movers, 1 / 60)

    Each argument is for all bodies, or has a row for each, and so it becomes an array of that name, which holds what the library
    has: what is written there counts at the next step. Zero is the default of everything.

    ids          (n) uint64, of bodies that are not fixed, each once. Not to be written
    velocity     (n, 6) float32, metres a second of the pivot, then radians a second, in the world; or (3), which does not turn
    push_mass    (n) float32, kilograms: what a character pushes with; 0: it pushes nothing
    damping, spin_damping  (n) float32, a second: the share of its speed, and of its spin, that it loses everywhere
    asleep       (n) bool: it stays where it is until something wakes it, and costs nothing
    sleepless    (n) bool: it never falls asleep, as characters do not
    mass, inertia, friction, restitution, clearance, margin, up, step, slope, rounds, work  as SlideOptions says; inertia and up
                 (n, 3), rounds and work uint64, else (n) float32. What has no mass is a character

    What became of each in its last frame, to be read:
    caught         (n) uint64: the driven body that it could not get out of the way of; 0: none
    ground, ground_normal  (n) uint64 and (n, 3): the body that a character stands on, 0: none, and the ground's normal
    contact_count  (n) uint64; `contacts(k)` tells them

    movers[mask], [slice] or [numbers] is a copy of some, and `a + b` of both, with all that they are: for bodies that come and go.
    """
    ids: NDArray[np.uint64]
    velocity: Floats
    mass: Floats
    inertia: Floats
    friction: Floats
    restitution: Floats
    push_mass: Floats
    damping: Floats
    spin_damping: Floats
    asleep: NDArray[np.bool_]
    sleepless: NDArray[np.bool_]
    clearance: Floats
    margin: Floats
    up: Floats
    step: Floats
    slope: Floats
    rounds: NDArray[np.uint64]
    work: NDArray[np.uint64]
    caught: NDArray[np.uint64]
    ground: NDArray[np.uint64]
    ground_normal: Floats
    contact_count: NDArray[np.uint64]

    def __init__(self, ids: ArrayLike, *, velocity: ArrayLike = 0, mass: ArrayLike = 0, inertia: ArrayLike = 0,
                 friction: ArrayLike = 0, restitution: ArrayLike = 0, push_mass: ArrayLike = 0, damping: ArrayLike = 0,
                 spin_damping: ArrayLike = 0, asleep: ArrayLike = False, sleepless: ArrayLike = False, clearance: ArrayLike = 0,
                 margin: ArrayLike = 0, up: ArrayLike = 0, step: ArrayLike = 0, slope: ArrayLike = 0, rounds: ArrayLike = 0,
                 work: ArrayLike = 0) -> None:
        given = locals()
        wanted = _numeric(ids, (None,), "ids")
        if wanted.size and wanted.dtype.kind == "f":
            raise TypeError(f"ids: an array of integers is needed, not of {wanted.dtype}")
        if wanted.size and wanted.min() < 1:
            raise Error(Code.INDEX, "ids")
        memory = np.zeros((len(wanted), _MOVER_ROWS.itemsize), np.uint8)
        memory.view(_MOVER_ROWS)[:, 0]["id"] = wanted
        self._keep(memory, None)
        for name in _GIVEN_OF_MOVERS:
            setattr(self, name, given[name])

    def _keep(self, memory: NDArray[np.uint8], world: Optional[World]) -> None:
        rows = memory.view(_MOVER_ROWS)[:, 0]
        views = {"ids": rows["id"], **{name: rows[name] for name in (*_GIVEN_OF_MOVERS, *_TOLD_OF_MOVERS)}}
        for name in ("ids", *_TOLD_OF_MOVERS):
            views[name].flags.writeable = False
        self.__dict__.update(views, _memory=memory, _world=world)

    @classmethod
    def _of(cls, memory: NDArray[np.uint8], world: Optional[World]) -> Movers:
        self = cls.__new__(cls)
        self._keep(memory, world)
        return self

    def __setattr__(self, name: str, value: Any) -> None:
        """Writes into the array of that name."""
        array = self.__dict__.get(name)
        if name[:1] == "_" or array is None:
            raise AttributeError(f"Movers have no {name}")
        numbers = np.asarray(value)
        if numbers.dtype.kind not in {"b": "biu", "u": "iu", "f": "fiu"}[array.dtype.kind]:
            raise TypeError(f"{name}: numbers as {array.dtype} are needed, not {numbers.dtype}")
        if array.dtype.kind == "u" and numbers.size and numbers.min() < 0:
            raise ValueError(f"{name}: {value} is less than 0")
        if name == "velocity" and numbers.ndim and numbers.shape[-1] == 3:
            numbers = np.concatenate([numbers, np.zeros_like(numbers)], axis=-1)
        try:
            numbers = np.broadcast_to(numbers, array.shape)
        except ValueError:
            raise ValueError(f"{name}: an array {array.shape} is needed, not {numbers.shape}") from None
        array[...] = numbers

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("Movers cannot be pickled; movers[:] is a copy")

    def __len__(self) -> int:
        return len(self._memory)

    def __getitem__(self, which: Any) -> Movers:
        return Movers._of(np.atleast_2d(self._memory[which]).copy(), self._world)

    def __add__(self, others: Movers) -> Movers:
        worlds = {self._world, others._world} - {None}
        if len(worlds) > 1:
            raise ValueError("movers of two Worlds")
        return Movers._of(np.concatenate([self._memory, others._memory]), next(iter(worlds), None))

    def contacts(self, k: int) -> list[WorldContact]:
        """Where the k-th touched at the end of its last frame, or within the margin; with which impulses."""
        answer = _SlideAnswer.from_buffer_copy(self._memory[operator.index(k)], _WorldMover.answer.offset)
        return _world_contacts(answer, answer.contact_count)


_WORLD_FIELDS, _SLIDE_FIELDS, _WORLD_CONTACT = _packed(_WorldAnswer), _packed(_SlideAnswer), _packed(_WorldContact)


def _world_contacts(c: Any, count: int) -> list[WorldContact]:
    first = type(c).contacts.offset
    rows: Any = [_WORLD_CONTACT.unpack_from(c, first + k * _WORLD_CONTACT.size) for k in range(count)]
    return [WorldContact(v[0], _contact_of(v[1:14]), v[14]) for v in rows]


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


_OF_BODY = {Code.COUNT: "most", Code.POSE: "pose", Code.QUATERNION: "pose", Code.SCALE: "scale", Code.PIVOT: "pivot",
            Code.TRIANGLES: "body"}
_OF_ID = {Code.INDEX: "id", Code.POSE: "pose", Code.QUATERNION: "pose"}
_OF_MOVER = {Code.INDEX: "mover", Code.POSES: "poses", Code.POSE: "poses", Code.QUATERNION: "poses", Code.TIMES: "times",
             Code.SCALE: "scale", Code.PIVOT: "pivot", Code.TRIANGLES: "mover"}
_OF_SLIDE = {Code.INDEX: "id", Code.SPEED: "velocity", Code.TIMES: "seconds", Code.CLEARANCE: "clearance, margin",
             Code.AXIS: "up", Code.DISTANCE: "step", Code.VALUE: "mass, inertia, friction, restitution, slope"}
_OF_STEP = {Code.INDEX: "ids", Code.TIMES: "seconds, calm", Code.SPEED: "quiet", Code.VALUE: "gravity"}
_OF_STEPPED = {**_OF_SLIDE, Code.INDEX: "ids", Code.POSE: "movers",
               Code.VALUE: "mass, inertia, friction, restitution, slope, push_mass, damping, spin_damping"}


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

    def add(self, body: Body, pose: ArrayLike = _IDENTITY, *, scale: float = 1, pivot: ArrayLike = (0, 0, 0), groups: int = 0,
            passes: int = 0, fixed: bool = False, sensor: bool = False) -> int:
        """Adds a body and returns its id; ids of removed bodies are used again. Nothing is asked: it may overlap others.

        pose    (7) or (4, 4): where it is
        scale   about its origin
        pivot   (3) of its frame: what it turns about. Of what moves freely, the centre of mass
        groups, passes  bits: the groups that it belongs to, by default the first, and those that it passes through
        fixed   it never moves by itself, like a level: pairs of two such bodies are not listed
        sensor  it stops nothing; `list` tells what is in it
        """
        if not isinstance(body, Body):
            raise TypeError(f"body: a Body is needed, not {type(body).__name__}")
        given = _filled(_WorldBody, groups=groups, passes=passes, fixed=bool(fixed), sensor=bool(sensor))
        given.body, given.pose, given.scale = body._address, _pose_of(pose, "pose"), _scale_of(scale)
        given.pivot[:] = _floats(pivot, (3,), "pivot").tolist()
        id = c_size_t()
        with self._door.changes():
            _check_of(_library.nsvcd_world_add(self._world, byref(given), byref(id)), _OF_BODY)
            self._bodies[id.value] = body
        return id.value

    def move(self, id: int, pose: ArrayLike) -> None:
        """Moves a body elsewhere. Nothing is asked."""
        with self._door.changes():
            _check_of(_library.nsvcd_world_move(self._world, _id_of(id), byref(_pose_of(pose, "pose"))), _OF_ID)

    def remove(self, id: int) -> None:
        """Takes a body out."""
        with self._door.changes():
            _check_of(_library.nsvcd_world_remove(self._world, _id_of(id)), _OF_ID)
            self._slid.pop(id, None)
            del self._bodies[id]

    def get(self, id: int) -> Resident:
        """What a body is, and where."""
        got = _WorldBody()
        with self._door.asks():
            _check_of(_library.nsvcd_world_get(self._world, _id_of(id), byref(got)), _OF_ID)
            body = self._bodies[id]
        return Resident(body, (*_vector(got.pose.position), *got.pose.rotation), got.scale, _vector(got.pivot), got.groups, got.passes,
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
        """Drives a body in this frame to a pose, by a line and a slerp about its pivot: a lift, a door, a robot's link. It stops for
        nobody: others that slide get out of its way, or are caught."""
        with self._door.changes():
            code = _library.nsvcd_world_drive(self._world, _id_of(id), byref(_pose_of(to, "to")))
            _check_of(code, {Code.INDEX: "id", Code.POSE: "to", Code.QUATERNION: "to"})

    def arrive(self) -> None:
        """Ends the frame: all driven bodies are at their ends, and rest."""
        with self._door.changes():
            _check(_library.nsvcd_world_arrive(self._world))

    def sweep(self, mover: Union[int, Body], poses: Optional[ArrayLike] = None, *, times: Optional[ArrayLike] = None,
              scale: float = 1, pivot: ArrayLike = (0, 0, 0), groups: int = 0, passes: int = 0, ignore: int = 0,
              options: Options = _DEFAULTS) -> WorldAnswer:
        """Does a mover hit any body? And which first: options=Options(ask="first"). Driven bodies are asked about as they move.

        mover   a body of the world by its id, or any Body, which has a scale, a pivot, groups and passes, as of `add`
        poses   (k, 7), as of `sweep` of two bodies; None: where it is in the world, or at the origin
        ignore  the id that a Body stands for: it does not meet that body, whose groups count
        """
        question = _world_question(mover, poses, times, scale, pivot, groups, passes, ignore, options)
        answer = _WorldAnswer()
        with self._door.asks():
            _check_of(_library.nsvcd_world_sweep(self._world, byref(question), _workspace.address, _workspace.size,
                                                 byref(answer)), _OF_MOVER)
        v: Any = _WORLD_FIELDS.unpack(answer)
        return WorldAnswer(_VERDICTS[v[0]], _WHYS[v[1]], v[2] or None, Range(v[3], v[4]), v[5], v[6:13], v[13], v[14:17],
                           _world_contacts(answer, v[17]), v[18], v[19])

    def list(self, mover: Union[int, Body], poses: Optional[ArrayLike] = None, *, times: Optional[ArrayLike] = None,
             scale: float = 1, pivot: ArrayLike = (0, 0, 0), groups: int = 0, passes: int = 0, ignore: int = 0,
             options: Options = _DEFAULTS) -> tuple[int, ...]:
        """The ids of all bodies that a mover meets on its way, sensors too; what is undecided counts. Arguments are those of `sweep`."""
        question = _world_question(mover, poses, times, scale, pivot, groups, passes, ignore, options)
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

    def slide(self, id: int, velocity: ArrayLike, seconds: float, options: SlideOptions = _USUAL_SLIDE) -> Slide:
        """Moves a body for a frame at its speed: as far as is proven free, then on without the speed that points into what it met.
        At the end, and on its way there, it is farther than the clearance from every other body.

        velocity  (6) metres a second of its pivot, then radians a second, in the world; or (3), and it does not turn. Gravity and
                  other forces are the caller's to add before
        seconds   of the frame
        """
        given = _floats(velocity, (3,) if np.shape(velocity) == (3,) else (6,), "velocity")
        speed = np.zeros(6, np.float32)
        speed[:len(given)] = given
        with self._door.changes():
            answer = self._slid.get(id) or _SlideAnswer()
            code = _library.nsvcd_world_slide(self._world, _id_of(id), byref(options._c), _number(c_float, seconds, "seconds"),
                                              _workspace.address, _workspace.size, _address(speed), byref(answer))
            _check_of(code, _OF_SLIDE)
            self._slid[id] = answer
            v: Any = _SLIDE_FIELDS.unpack(answer)
            contacts = _world_contacts(answer, v[14])
        return Slide(v[0:7], speed, v[7], bool(v[8]), v[9] or None, v[10:13], v[13] or None, contacts, v[15], v[16])

    def step(self, movers: Movers, seconds: float, *, gravity: ArrayLike = (0, 0, -9.81), quiet: float = 0, calm: float = 0) -> Step:
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
            raise Error(code, _OF_STEPPED.get(code, ""), index=int(np.argmax(movers.ids == answer.refused)))
        _check_of(code, _OF_STEP)
        return Step(answer.awake, answer.asleep, answer.caught, answer.contacts, answer.questions, answer.work)


def _scale_of(scale: float) -> Any:
    factor = _number(c_float, scale, "scale")
    if not factor.value:
        raise ValueError(f"scale: {scale}")  # in C that is 1
    return factor


def _id_of(id: Any) -> Any:
    return _number(c_size_t, id, "id")


def _world_question(mover: Union[int, Body], poses: Optional[ArrayLike], times: Optional[ArrayLike], scale: float, pivot: ArrayLike,
                    groups: int, passes: int, ignore: int, options: Options) -> Any:
    asked = _filled(_WorldQuestion, groups=groups, passes=passes, self=ignore)
    given = np.asarray(poses) if poses is not None else None
    motion = _motion(given[None] if given is not None and given.shape == (7,) else given, times, "mover")
    asked.question = options._c
    a = asked.question.a
    if isinstance(mover, Body):
        a.body, a.scale = mover._address, _scale_of(scale)
        a.pivot[:] = _floats(pivot, (3,), "pivot").tolist()
    elif isinstance(mover, bool) or not isinstance(mover, (int, np.integer)):
        raise TypeError(f"mover: an id or a Body is needed, not {type(mover).__name__}")
    elif scale != 1 or np.any(pivot) or groups or passes or ignore:
        raise TypeError("scale, pivot, groups, passes, ignore: only of a Body; that of an id has its own")
    elif not mover:
        raise Error(Code.INDEX, "mover")  # 0 is nobody
    else:
        asked.self = _id_of(mover)
    if motion.poses is not None:
        a.poses, a.count = _address(motion.poses), len(motion.poses)
        a.times = None if motion.times is None else _address(motion.times)
    asked.kept = motion
    return asked
